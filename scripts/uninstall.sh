#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# uninstall.sh PREFIX: takes away what `make install` left under PREFIX, as the list beside it tells. Files that it does not name stay.
set -euo pipefail
prefix=$1
list=$prefix/share/hallway/installed.txt
if [[ ! -f $list ]]; then
  echo "uninstall: there is no $list: nothing was installed under $prefix" >&2
  exit 3
fi
mapfile -t files < "$list"
cd "$prefix"
rm -f -- "${files[@]}"
# What was derived from the maps that are gone.
rm -rf -- share/hallway/maps/.hallway
for folder in share/hallway share/doc/hallway share/cmake/Hallway include/hallway lib/hallway libexec/hallway; do
  [[ ! -d $folder ]] || find "$folder" -depth -type d -empty -delete
done
echo "uninstall: ${#files[@]} files taken away from $prefix" >&2
