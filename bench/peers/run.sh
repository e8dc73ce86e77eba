#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# run.sh BUILD [REPEAT [DATA]]: em and the peers on the labelled scenes of DATA/em_scenes, each scene REPEAT times (3), all in one run and each on
# one thread. Prints a table; results.json and the pictures of the worst scenes go to BUILD/bench-out/peers. BUILD is configured with
# -DHALLWAY_PEERS=ON; `make bench-peers` does that.
set -euo pipefail
build=$(realpath "$1")
repeat=${2:-3}
here=$(cd "$(dirname "$0")" && pwd)
data=${3:-${HALLWAY_DATA:-$here/../../../shared/data}}
out=$build/bench-out/peers
plugins=()
for plugin in em:threads=1 peer_pcl_ransac peer_pcl_growing peer_cgal_ransac peer_cgal_growing peer_open3d_ransac; do
  plugins+=(--plugin "$plugin")
done
OMP_NUM_THREADS=1 "$build/bin/hallway" bench-em "${plugins[@]}" --scenes-dir "$data/em_scenes" --repeat "$repeat" --in-process --quiet --out "$out"
/usr/bin/python3 "$here/table.py" "$out/results.json"
