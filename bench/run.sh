#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# run.sh BUILD: every benchmark of the build folder; files go to BUILD/bench-out. Speeds are ratios to references that are
# measured in the same run. Their programs are the target `benches`: cmake --build --preset release --target benches
set -euo pipefail
build=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
out=$build/bench-out
/usr/bin/python3 "$here/flat.py" "$build/bin/hallway" "$out"
echo
/usr/bin/python3 "$here/victoria_park.py" "$build/bin/hallway" "$out/victoria_park"
echo
/usr/bin/python3 "$here/accuracy.py" "$build/bin/hallway" "$out/accuracy"
echo
/usr/bin/python3 "$here/planes_cost.py" "$build/bin/hallway" "$out"
echo
/usr/bin/python3 "$here/real_data.py" "$build/bin/hallway" "$out/real_data"
echo
"$build/bin/bench_trace" --benchmark_min_time=0.2
echo
"$build/bin/bench_visibility"
echo
lidar_maps=("$here/../maps/office.toml")
building=${HALLWAY_DATA:-$here/../../shared/data}/models/buildings/willowgarage/meshes/willowgarage_visual.dae
if [[ -f $building ]]; then
  mkdir -p "$out/lidar"
  "$build/bin/hallway" import "$building" --copy --out "$out/lidar/willowgarage.map" > "$out/lidar/import.log" 2>&1
  printf 'map = "willowgarage.map"\nsteps = 10\n[robot]\n[sensor.eyes]\nkind = "points"\n' > "$out/lidar/willowgarage.toml"
  lidar_maps+=("$out/lidar/willowgarage.toml")
fi
"$build/bin/bench_lidar" "${lidar_maps[@]}"
echo
/usr/bin/python3 "$here/rig_rate.py" "$build/bin/hallway" "$out/rig_rate"
echo
"$build/bin/bench_slam_point_speed"
echo
"$build/bin/bench_slam_plane_pairs"
"$build/bin/bench_slam_plane_roll_back"
echo
"$build/bin/bench_bsp"
echo
"$build/bin/bench_edit"
echo
"$build/bin/bench_isolation" "$build/tests/abi/fixtures/minimal.so" "$build/lib/hallway/plugins/slam_point.so" \
  $(ls "${HALLWAY_DATA:-$here/../../shared/data}/landmark_logs/figure8_d100/obs.csv" 2>/dev/null)
echo
maps=${HALLWAY_DATA:-$here/../../shared/data}/maps
if [[ -d $maps/id1 ]]; then
  "$build/bin/bench_compile" $(for map in e1m1 e1m7 dm2 dm5 end; do echo "$maps/id1/$map.map=$maps/id1_bsp/$map.bsp"; done)
  echo
  "$build/bin/bench_visibility" "$maps/id1/e1m1.map"
else
  echo "no maps at $maps: nothing to compile"
fi
