#!/bin/sh
# SPDX-License-Identifier: MIT
# figures.sh [HALLWAY [OUT [NAME...]]]: makes the tables and charts of docs/performance.md (figures.py).
set -eu
root=$(dirname "$(dirname "$(realpath "$0")")")
hallway=${1:-$root/build/release/bin/hallway}
out=${2:-$root/out/figures}
[ $# -lt 2 ] || shift
[ $# -lt 1 ] || shift
exec python3 -B "$root/docs/figures.py" "$hallway" "$out" "$@"
