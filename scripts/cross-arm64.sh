#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Compiles Hallway for 64-bit ARM with Debian's cross compiler and runs what came of it under qemu-user.
#
#   cross-arm64.sh [robot | all] [FOLDER]    robot: hallway-robot, its drivers, the plugins and the SDK's examples (the default)
#                                            all: everything, tests too, and the tests of libraries and algorithms run as well
#
# Needs the packages of `install-deps.sh cross-arm64`; try-debian.sh RELEASE cross-arm64 has them in a chroot. FOLDER is the build folder, build/arm64.
# Where the kernel hands arm64 programs to qemu (binfmt_misc), plugins run in processes of their own; elsewhere in the program's own.
# Status: 0 passed; 1 failed; 2 usage; 77 not tried: the cross compiler, its libraries or qemu are not there.
set -euo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)
what=${1:-robot}
build=${2:-$here/build/arm64}
case $what in robot | all) ;; *) echo "cross-arm64: there are robot and all, not $what" >&2; exit 2 ;; esac

not_tried() {
  echo "cross-arm64: not tried: $1"
  exit 77
}
command -v aarch64-linux-gnu-g++ >/dev/null || not_tried "aarch64-linux-gnu-g++ is not there"
qemu=$(command -v qemu-aarch64 || command -v qemu-aarch64-static) || not_tried "qemu-user is not there"
[[ -e /usr/lib/aarch64-linux-gnu/libfmt.so ]] || not_tried "the libraries of arm64 are not there"

targets=(hallway-robot hallway-plugin slam_point em slam_plane icp robot/all sdk/all)
tests=OFF
if [[ $what == all ]]; then targets=(all) tests=ON; fi
cmake -S "$here" -B "$build" -G Ninja --toolchain "$here/cmake/aarch64-linux-gnu.cmake" -DCMAKE_BUILD_TYPE=Release -DHALLWAY_WERROR=ON \
  -DHALLWAY_TESTS=$tests -DHALLWAY_BENCH=OFF
cmake --build "$build" -j "${JOBS:-$(nproc)}" --target "${targets[@]}"

run=("$qemu")
options=(--in-process)
if "$build/bin/hallway-robot" --version >/dev/null 2>&1; then
  run=()
  options=()
  echo "cross-arm64: arm64 programs start of themselves; plugins run in processes of their own"
fi
robot=("${run[@]}" "$build/bin/hallway-robot")

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for library in "$build"/lib/hallway/plugins/*.so "$build"/lib/hallway/drivers/*.so; do
  readelf -h "$library" | grep -q 'Machine:.*AArch64' || { echo "cross-arm64: $library is not for arm64" >&2; exit 1; }
done
"${robot[@]}" --version
"${robot[@]}" drivers
"${robot[@]}" profile >"$work/profile.toml"
grep -i 'machine' "$work/profile.toml"

cat >"$work/drive.toml" <<TOML
[driver]
name = "replay"
log = "$here/tests/release/short_drive.mcap"
pace = "fast"

[[plugin]]
name = "slam_point"
TOML
for plugin in em icp; do
  "${robot[@]}" run "$work/drive.toml" --plugin "$plugin" --out "$work/$plugin" "${options[@]}"
done
# slam_plane is loaded, and wants planes, which this robot does not have: a bad configuration and no failure to load.
status=0
"${robot[@]}" run "$work/drive.toml" --plugin slam_plane --out "$work/slam_plane" "${options[@]}" || status=$?
[[ $status -eq 3 ]] || { echo "cross-arm64: slam_plane: status $status instead of 3" >&2; exit 1; }

"${robot[@]}" run "$work/drive.toml" --out "$work/drive" "${options[@]}"
# The C library's sin and cos may differ in the last bit between CPU families, so no bytes are compared: a micrometre, and a millionth of an angle.
paste -d ' ' "$here/tests/release/short_drive.tum" "$work/drive/trajectory.tum" | awk '
  NF != 16 { bad = 1 }
  { for (i = 1; i <= 8; ++i) if ($i - $(i + 8) > 1e-6 || $(i + 8) - $i > 1e-6) bad = 1 }
  END { exit bad || NR < 40 }' || { echo "cross-arm64: the trajectory is not that of short_drive.tum" >&2; exit 1; }

if [[ $what == all ]]; then
  "${run[@]}" "$build/bin/hallway" run "$here/maps/figure_eight.toml" --steps 30 --out "$work/run" "${options[@]}"
  # Tests of what computes. Those of processes of their own are left out: qemu-user knows neither seccomp nor Landlock.
  "${run[@]}" "$build/tests/test_base" --gtest_filter='-Child.*'
  ctest --test-dir "$build" --no-tests=error --output-on-failure --timeout 3600 -j "${JOBS:-$(nproc)}" -LE long \
    -R '^(geometry|geom|map|csg|bsp|pvs|trace.*|log|link|import|eval|em|em_threads|slam_point|slam_plane|slam_plane_thesis|slam_plane_spatial)$'
fi
echo "cross-arm64: passed"
