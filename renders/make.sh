#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make.sh HALLWAY: makes every picture of this folder again.
set -euo pipefail
hallway=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for scenario in figure_eight office; do
  "$hallway" run "$here/../maps/$scenario.toml" --out "$work/$scenario" --quiet
done
"$hallway" render "$work/figure_eight" --view perspective --size 1120x480 --out "$here/figure_eight.png" \
  --show map,truth,estimate,landmarks,errors
"$hallway" render "$work/office" --view top --size 1120x760 --out "$here/office.png" \
  --show map,truth,estimate,landmarks,errors,frustum
ls -l "$here"/*.png
