#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# package.sh BUILD OUT: Debian packages of what is built in the folder BUILD, into OUT. Times in them are those of the last commit, so that the same
# sources, built by the same compiler, give the same bytes.
set -euo pipefail
build=$1
out=$2
for program in cpack dpkg-shlibdeps file gzip; do
  command -v "$program" > /dev/null || { echo "package: $program is missing (packages cmake, dpkg-dev, file, gzip)" >&2; exit 3; }
done
: "${SOURCE_DATE_EPOCH:=$(git -C "$(dirname "$0")" log -1 --format=%ct 2> /dev/null || date +%s)}"
export SOURCE_DATE_EPOCH
rm -rf "$out"
umask 022
mkdir -p "$out"
cpack --config "$build/CPackConfig.cmake" -B "$out" > "$out/cpack.log" 2>&1 || { cat "$out/cpack.log" >&2; exit 3; }
rm -rf "$out/_CPack_Packages"
ls -l "$out"/*.deb
