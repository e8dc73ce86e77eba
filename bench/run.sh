#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# run.sh BUILD: every benchmark of the build folder. Figures are ratios to references measured in the same run.
set -euo pipefail
build=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
python3 "$here/flat.py" "$build/bin/hallway" "$build/bench-out"
"$build/bin/bench_trace" --benchmark_min_time=0.2
