#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# package_test.sh BUILD: installs what was built into a folder, and goes the way of a plugin's author with that alone.
set -euo pipefail
build=$1
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() { echo "package: $*" >&2; exit 1; }

DESTDIR="$work" cmake --install "$build" --prefix /opt/hallway > install.log
export PATH="$work/opt/hallway/bin:$PATH"
unset HALLWAY_PLUGIN_PATH
hallway plugin list | grep -q '^slam_point ' || fail "the installed program does not find the installed plugin"

# A new plugin: written, built in one command, checked, validated, described, run, and run again on the same input.
hallway plugin new my_slam
(cd my_slam && cmake --workflow --preset release > build.log) || fail "a new project does not build"
hallway plugin check my_slam/build/my_slam.so | grep -q 'it will load on' || fail "check"
hallway plugin validate my_slam/build/my_slam.so > validate.log || { cat validate.log; fail "validate"; }
hallway plugin info my_slam/build/my_slam.so | grep -q 'match_m = 0.1 m' || fail "info"
cat > standing.map <<'END'
{
"classname" "worldspawn"
"_hallway" "1"
"_scale" "0.01"
}
{
"classname" "hw_path"
"name" "round"
"shape" "lemniscate"
"origin" "0 0 0"
"length_m" "20"
}
{
"classname" "hw_landmark_cloud"
"name" "around"
"path" "round"
"per_100m" "200"
"sideways_m" "5"
"height_m" "3"
"seed" "1"
}
END
cat > standing.toml <<'END'
schema = "hallway.scenario/1"
map = "standing.map"
steps = 20
period_s = 0.1
[robot]
path = "round"
speed_m_s = 0.001
[sensor.eyes]
kind = "points"
noise_m = 0.01
[[plugin]]
name = "my_slam"
END
hallway run standing.toml --plugin my_slam/build/my_slam.so --out out --quiet
[[ $(grep -vc '^#' out/trajectory.tum) -eq 20 ]] || fail "a step has no pose"
[[ $(wc -l < out/landmarks.csv) -gt 1 ]] || fail "nothing was mapped"
hallway replay out/observations.csv --plugin my_slam/build/my_slam.so --out again --quiet
cmp out/landmarks.csv again/landmarks.csv

# And on a robot, with the installed drivers.
cat > robot.toml <<'END'
[driver]
name = "replay"
log = "out/run.mcap"
pace = "fast"
[[plugin]]
name = "my_slam/build/my_slam.so"
END
hallway-robot run robot.toml --out robot --quiet
cmp out/landmarks.csv robot/landmarks.csv
cmp out/trajectory.tum robot/trajectory.tum

# The same source by pkg-config, without CMake.
export PKG_CONFIG_PATH="$work/opt/hallway/share/pkgconfig"
# shellcheck disable=SC2046
${CXX:-c++} -std=c++17 -O2 -shared -fPIC -fvisibility=hidden $(pkg-config --cflags hallway) \
  "-Wl,--version-script=$(pkg-config --variable=version_script hallway)" my_slam/my_slam.cpp -o by_hand.so
hallway plugin check by_hand.so | grep -q 'exports *hw_entry$' || fail "a plugin that was built by hand"

# The documents' links lead to what is installed.
doc=$work/opt/hallway/share/doc/hallway
while IFS= read -r page; do
  while IFS= read -r link; do
    [[ -e $(dirname "$page")/$link ]] || fail "$page leads to $link, which is not installed"
  done < <(grep -oP '\]\(\K(?!https?:)[^)#]+' "$page" | grep -v 'maps/regress/' || true)
done < <(find "$doc" -name '*.md')

# Taken away, and nothing else.
touch opt/hallway/bin/mine
"$here/../../scripts/uninstall.sh" opt/hallway
[[ $(find opt/hallway ! -type d) == opt/hallway/bin/mine ]] || fail "uninstalling leaves $(find opt/hallway ! -type d)"
echo "package: all as it should be"
