#!/bin/sh
# SPDX-License-Identifier: MIT
# Lists public names that no production code uses: scripts/unused.py with the objects of the build that has one for each
# source, where there is one (cmake --preset dev, or clang).
root=$(cd "$(dirname "$0")/.." && pwd)
for build in "$root/build/dev" "$root/build/clang"; do
  [ -d "$build/engine" ] && exec python3 "$root/scripts/unused.py" --build "$build" "$root"
done
exec python3 "$root/scripts/unused.py" "$root"
