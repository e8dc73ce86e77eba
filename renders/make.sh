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
  --hide all --show map,truth,estimate,landmarks,errors
"$hallway" render "$work/office" --view top --size 1120x760 --out "$here/office.png" \
  --hide all --show map,truth,estimate,landmarks,errors,frustum
"$hallway" render "$here/../maps/office.map" --size 1120x640 --hide all --show portals --out "$here/portals.png"
"$hallway" render "$here/../maps/office.map" --size 1120x640 --hide all --show pvs-from=4,1.6,1 --out "$here/visible.png"

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
# Walls as slam_plane maps them with noise, over the true ones, with the stars of its submaps (thesis 4.3).
noise=(--set sensor.eyes.noise_m=0.02 --set sensor.eyes.noise_angle_deg=0.3 --set sensor.eyes.noise_end_m=0.005)
for scenario in four_planes hallway hallway_return key_points loop_corridor motion_model bad_pairs roll_back pseudo_merge many_planes; do
  "$hallway" run "$here/../maps/$scenario.toml" "${noise[@]}" --out "$work/$scenario" --quiet
  "$hallway" render "$work/$scenario" --view top --cut 1.5 --size 760x520 --hide all --show map,truth,estimate,walls,submaps --out "$here/walls_$scenario.png"
done
# Faces as slam_plane maps them in six degrees of freedom, with their certain edges.
"$hallway" run "$here/../maps/spatial_rooms.toml" "${noise[@]}" --out "$work/spatial_rooms" --quiet
"$hallway" render "$work/spatial_rooms" --view perspective --size 1120x640 --hide all --show map,truth,estimate,walls --out "$here/walls_spatial_rooms.png"
# Points, the planes that em finds in them, and the map of these planes (thesis chapter 5).
for scenario in em_corridor em_floor; do
  "$hallway" run "$here/../maps/$scenario.toml" --out "$work/$scenario" --quiet
  "$hallway" render "$work/$scenario" --view panels --size 1280x900 --out "$here/$scenario.png"
done
# The scan of a lidar in a corner, deskewed by the true motion: rings by height on walls, floor and ceiling.
"$hallway" run "$here/../maps/office_rig.toml" --steps 160 --out "$work/office_rig" --quiet
"$hallway" render "$work/office_rig" --iteration 151 --view perspective --eye -8,-17,19 --target 13,5,0 --size 1120x640 \
  --hide all --show map,body,seen,deskewed --out "$here/scan.png"
# A sweep of the first robot's sonar in a room (thesis 2.2.3, figures 12 and 14), deskewed by the true motion: arcs touch walls, a table and a locker.
"$hallway" run "$here/../maps/senses.toml" --out "$work/senses" --quiet
"$hallway" render "$work/senses" --iteration 400 --view top --area 3.4,-0.3,10.6,8.3 --size 760x860 \
  --hide all --show map,body,trail,truth,deskewed --out "$here/sonar.png"
# The chart of the first robot in an office, with faults, over the plan (thesis 2.2.4, figure 25), and how it grows.
"$hallway" run "$here/../maps/cubicles_faults.toml" --seed 106 --out "$work/cubicles" --quiet
"$hallway" render "$work/cubicles" --view top --cut 1.2 --size 1120x720 --hide all --show map,truth,topology --out "$here/topology.png"
for iteration in 900 2400 3300 4800 6600 8450; do
  "$hallway" render "$work/cubicles" --view top --cut 1.2 --size 640x440 --iteration $iteration \
    --hide all --show map,body,trail,topology,drawing --out "$here/first_robot_$iteration.png"
done
# Figures 26 to 28: the simulated office, the one with a doubled cubicle, and what is mapped of it with faults (2.2.5).
"$hallway" run "$here/../maps/cubicles.toml" --out "$work/figure_26" --quiet
"$hallway" render "$work/figure_26" --view top --cut 1.2 --size 760x520 --hide all --show map,truth,topology --out "$here/figure_26.png"
"$hallway" render "$here/../maps/cubicles_changed.map" --view top --cut 1.2 --size 760x520 --hide all --out "$here/figure_27.png"
"$hallway" run "$here/../maps/cubicles_changed_faults.toml" --out "$work/figure_28" --quiet
"$hallway" render "$work/figure_28" --view top --cut 1.2 --size 760x520 --hide all --show map,truth,topology --out "$here/figure_28.png"
ls -l "$here"/*.png
