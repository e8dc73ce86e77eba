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
"$hallway" render "$here/../maps/office.map" --size 1120x640 --show portals --out "$here/portals.png"
"$hallway" render "$here/../maps/office.map" --size 1120x640 --show pvs-from=4,1.6,1 --out "$here/visible.png"

# A leak made on purpose: a hole of 40 cm in the north wall of the hall.
cp -r "$here/../maps/models" "$work/models"
cp "$here/../maps/office.map" "$work/leak.map"
"$hallway" edit "$work/leak.map" -f - > /dev/null <<'END'
box from 30,14.9,1 to 30.4,16.6,1.4 material=hole name=hole
subtract hole
END
status=0
"$hallway" map leak "$work/leak.map" --picture "$here/leak.png" || status=$?
[[ $status -eq 1 ]]
# The flat of docs/tutorial-map.md.
awk '/^```/ { inside = !inside; next } inside' "$here/../docs/tutorial-map.md" > "$work/flat.hwe"
(cd "$work" && "$hallway" edit flat.map -f flat.hwe > /dev/null)
cp "$work/flat.png" "$here/tutorial.png"
# Planes: truth beside result.
"$hallway" bench-em --plugin em --scenes 1 --seed 2 --planes 12..12 --points 12000..12000 --sigma 0.01..0.02 --pictures 1 --out "$work/planes" --quiet
cp "$work/planes"/*.png "$here/planes.png"
ls -l "$here"/*.png
