#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# reference-runs.sh FOLDER HALLWAY…: short runs of the two demonstrations into FOLDER, and on standard output the SHA-256 of their observations, trajectory,
# landmarks and view from above. Another release of Debian must give the same on the same machine (try-debian.sh compares). HALLWAY is the program, with
# the words of an emulator before it if need be.
set -euo pipefail
folder=$1
shift
maps=$(cd "$(dirname "$0")/../maps" && pwd)
mkdir -p "$folder"
for scenario in figure_eight office; do
  "$@" run "$maps/$scenario.toml" --steps 150 --out "$folder/$scenario" --force --quiet >&2
  for file in observations.csv trajectory.tum landmarks.csv top.png; do
    if [[ ! -s $folder/$scenario/$file ]]; then
      echo "reference-runs: $scenario wrote no $file" >&2
      exit 1
    fi
    (cd "$folder" && sha256sum "$scenario/$file")
  done
done
