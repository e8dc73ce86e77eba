#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# out_of_tree_test.sh SOURCE BUILD PLUGIN: a plugin of the repository, built with the installed SDK alone, gives the answers of the one that was built with
# the program.
set -euo pipefail
source=$1
build=$2
plugin=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

DESTDIR="$work" cmake --install "$build" --prefix /opt/hallway > install.log
export PATH="$work/opt/hallway/bin:$PATH"
unset HALLWAY_PLUGIN_PATH
cmake -S "$source/tests/package/out_of_tree" -B built "-DPLUGINS=$source/plugins" "-DPLUGIN=$plugin" > built.log
cmake --build built >> built.log || { tail -n 30 built.log >&2; exit 1; }
office=$work/opt/hallway/share/hallway/maps/office.toml
hallway run "$office" --plugin "$plugin" --steps 60 --out inside --quiet
hallway run "$office" --plugin "built/$plugin.so" --steps 60 --out outside --quiet
[[ $(grep -vc '^#' inside/trajectory.tum) -eq 60 ]]
for file in trajectory.tum landmarks.csv; do
  cmp "inside/$file" "outside/$file"
done
echo "out_of_tree: $plugin gives the same answers"
