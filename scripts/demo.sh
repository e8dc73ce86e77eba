#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# demo.sh HALLWAY: the two demonstration runs, with their tables and pictures, into out/.
set -euo pipefail
cd "$(dirname "$0")/.."
hallway=$1
for scenario in figure_eight office; do
  "$hallway" run "maps/$scenario.toml" --out "out/$scenario" --force
  echo
done
