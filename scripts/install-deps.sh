#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs the Debian packages that building, running and testing Hallway needs. The one list of them.
# Does nothing, and needs neither network nor root, when all are there.
#
#   install-deps.sh               what is needed
#   install-deps.sh --with-ros    and what `hallway log convert` reads ROS 1 bags with, and the driver ros1; everything else works without
#   install-deps.sh --with-peers  and the libraries that `make bench-peers` measures em and slam_point beside: PCL, CGAL, Open3D; MRPT, Ceres
set -euo pipefail

optional=()
case "${1-}" in
  "") ;;
  --with-ros) optional=(librosbag-storage-dev libsensor-msgs-dev libnav-msgs-dev libgeometry-msgs-dev libroscpp-dev
                         libdiagnostic-msgs-dev libtf2-msgs-dev python3-rosmaster) ;;
  --with-peers) optional=(libpcl-dev libcgal-dev libopen3d-dev libmrpt-slam-dev libceres-dev) ;;
  *)
    echo "install-deps: unknown option $1; there are --with-ros and --with-peers" >&2
    exit 2
    ;;
esac

packages=(
  # build
  cmake g++ clang libclang-rt-14-dev make ninja-build pkg-config
  # libraries
  libassimp-dev libedit-dev libeigen3-dev libembree-dev libgmp-dev libmuparser-dev libegl-dev libosmesa6 libgl1-mesa-dri libprotobuf-dev libtbb-dev libtinygltf-dev libcli11-dev libfmt-dev libtomlplusplus-dev
  nlohmann-json3-dev libpng-dev libstb-dev libxxhash-dev libzstd-dev protobuf-compiler zlib1g-dev fonts-dejavu-core
  # tests and benchmarks
  libgtest-dev libbenchmark-dev python3 python3-numpy binutils
  # make format, make lint
  clang-format clang-tidy
)

missing=()
for package in "${packages[@]}" ${optional[@]+"${optional[@]}"}; do
  status=$(dpkg-query -W -f='${db:Status-Abbrev}' "$package" 2>/dev/null || true)
  [[ $status == ii* || $status == hi* ]] || missing+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
  exit 0
fi

echo "installing: ${missing[*]}" >&2
root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "install-deps: these packages are missing and neither root nor sudo is there to install them: ${missing[*]}" >&2
    exit 3
  fi
  root=(sudo)
fi
"${root[@]}" apt-get update -qq
"${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
