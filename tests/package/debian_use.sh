#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs in a bare Debian, as root, with the packages beside it: installs them, uses them as a user would, purges them, and compares the files.
set -eu
packages=$(dirname "$0")
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8

fail() { echo "package_debian: $*" >&2; exit 1; }
# Everything but what apt, dpkg and their caches keep of themselves.
files() {
  find / -xdev \( -path /proc -o -path /sys -o -path /dev -o -path /run -o -path /tmp -o -path /hallway-test -o -path /var/lib/apt -o -path /var/cache \
    -o -path /var/log -o -path /var/lib/dpkg \) -prune -o -print | sort
}
installed() { dpkg-query -W -f='${Package}\n' | sort; }
# Most of what the packages are for is done by somebody who may write nothing of the system.
user() { (cd "$home" && setpriv --reuid=65534 --regid=65534 --clear-groups env HOME="$home" "$@"); }

apt-get update -qq
home=/tmp/home
mkdir "$home"
chown 65534:65534 "$home"
files > /tmp/before
installed > /tmp/installed

# A robot's computer: nothing of pictures, maps or models comes along.
apt-get install -y -qq --no-install-recommends "$packages"/hallway-robot_*.deb
user hallway-robot drivers | grep -q '^udp ' || fail "hallway-robot does not find its drivers"
user hallway-robot profile | grep -q '^' || fail "hallway-robot profile"
brought=$(installed | comm -13 /tmp/installed - | grep -vxE 'hallway-robot|libfmt[0-9]+|libstdc\+\+6|libzstd1|zlib1g' || true)
[ -z "$brought" ] || fail "hallway-robot has brought $brought"

# An author's: all three, with what they recommend.
apt-get install -y -qq --install-recommends "$packages"/*.deb
user hallway doctor --picture picture.png || fail "hallway doctor"
for scenario in figure_eight office; do
  user hallway run /usr/share/hallway/maps/$scenario.toml --steps 200 --out $scenario --quiet
  for file in run.json metrics.json trajectory.tum landmarks.csv top.png perspective.png; do
    [ -s "$home/$scenario/$file" ] || fail "$scenario has no $file"
  done
  [ "$(grep -vc '^#' "$home/$scenario/trajectory.tum")" -eq 200 ] || fail "$scenario: a step has no pose"
done
user hallway map export /usr/share/hallway/maps/office.map --out office.glb || fail "map export: the model in the map"

user hallway plugin new my_slam
user sh -c 'cd my_slam && cmake --workflow --preset release > build.log' || fail "a new plugin does not build"
user hallway plugin validate my_slam/build/my_slam.so > /tmp/validate.log || { cat /tmp/validate.log; fail "plugin validate"; }
user hallway run /usr/share/hallway/maps/stationary.toml --steps 20 --plugin my_slam/build/my_slam.so --out mine --quiet

# The robot's program gives the same answers as the simulator's to what that recorded.
user hallway run /usr/share/hallway/maps/stationary.toml --steps 50 --out standing --quiet
cat > "$home/robot.toml" <<'END'
[driver]
name = "replay"
log = "standing/run.mcap"
pace = "fast"
[[plugin]]
name = "slam_point"
params = { noise_m = 0.05 }
END
user hallway-robot run robot.toml --out robot --quiet
for file in trajectory.tum landmarks.csv; do
  cmp "$home/standing/$file" "$home/robot/$file" || fail "hallway-robot differs in $file"
done

# The documents' links to what is packaged hold.
for page in README.md docs/commands.md docs/install.md; do
  [ -f "/usr/share/doc/hallway/$page" ] || fail "the document $page is not installed"
  folder=$(dirname "/usr/share/doc/hallway/$page")
  grep -oE '\]\([^)#:]+' "/usr/share/doc/hallway/$page" | cut -c3- | grep -v '^http' | while read -r link; do
    [ -e "$folder/$link" ] || fail "$page leads to $link, which is not installed"
  done
done

# Root leaves a cache beside a packaged map.
hallway compile /usr/share/hallway/maps/office.map > /dev/null
[ -d /usr/share/hallway/maps/.hallway ] || fail "this test wants a cache to be left"

apt-get purge -y -qq hallway hallway-robot hallway-dev
files > /tmp/after
left=$(comm -13 /tmp/before /tmp/after | grep -i hallway || true)
[ -z "$left" ] || fail "purging has left $left"
# What ours have brought along, which autoremove would keep in part.
installed | comm -13 /tmp/installed - | xargs apt-get purge -y -qq
files > /tmp/after
left=$(comm -13 /tmp/before /tmp/after)
[ -z "$left" ] || fail "left behind: $left"
lost=$(comm -23 /tmp/before /tmp/after)
[ -z "$lost" ] || fail "lost: $lost"
