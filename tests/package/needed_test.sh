#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# needed_test.sh BUILD: what goes to a robot needs no libraries but those listed here.
set -euo pipefail
cd "$1"
status=0

# needs FILE LIBRARY…: the shared libraries that FILE names are the C and C++ libraries and those listed.
needs() {
  local file=$1 library needed
  shift
  needed=$(readelf --dynamic --wide "$file" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
  [[ -n $needed ]] || { echo "needed: $file names no library" >&2; status=1; }
  for library in $needed; do
    case " libc libm libstdc++ libgcc_s ld-linux-x86-64 ld-linux-aarch64 $* " in
      *" ${library%%.so*} "*) ;;
      *)
        echo "needed: $file needs $library" >&2
        status=1
        ;;
    esac
  done
}

needs bin/hallway-robot libfmt libzstd libz
needs libexec/hallway/hallway-plugin libfmt
needs lib/hallway/drivers/replay.so libfmt libzstd libz
needs lib/hallway/drivers/udp.so libfmt libz
for plugin in dead_reckoning em icp slam_plane slam_point wall_follower wanderer; do
  needs lib/hallway/plugins/$plugin.so
done
exit $status
