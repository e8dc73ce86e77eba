#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs the Debian packages that building, running and testing Hallway needs. The one list of them.
# Does nothing, and needs neither network nor root, when all are there.
#
#   install-deps.sh [WORD] [--with-ros] [--with-peers] [--list]
#
# WORD says for which command of the Makefile, test if none is said:
#   demo   build and run: no clang, no test libraries       check   test, and clang with its sanitizers; also fuzz
#   test   demo, and what the tests need                    bench   test, and the library of the benchmarks
#   package  demo, and what makes Debian packages
#   format clang-format alone                               lint    test, clang and clang-tidy
#   docs   Graphviz alone, which draws docs/figures/architecture.svg
#   cross-arm64   demo, and the cross compiler, the emulator, the libraries of arm64 and GoogleTest (dpkg --add-architecture arm64 comes first)
#
#   --with-ros    what `hallway log convert` reads ROS 1 bags with, and the driver ros1; everything else works without
#   --with-peers  the libraries that `make bench-peers` measures em and slam_point beside: PCL, CGAL, Open3D; MRPT, Ceres
#   --list        prints what it would ask for, one package a line, and installs nothing
#
# Tried on Debian 12 (bookworm) and 13 (trixie); Ubuntu 24.04 and forky are not tried. The status is 0 when all that is needed is there, 2 for a word that
# it does not know, 3 when something is missing that it cannot install, which it names in one line.
#
# An entry is a package. `a|b`: the first that the release has, where it is called otherwise or one of the two will do. `a?`: what is left out, with a word
# about it, where the release has none.
set -euo pipefail

build=(cmake g++ make ninja-build pkg-config protobuf-compiler fonts-dejavu-core
  # of these libraries only headers, the same on all machines
  libcli11-dev libegl-dev libeigen3-dev libstb-dev nlohmann-json3-dev)
libraries=(libassimp-dev libedit-dev libembree-dev libfmt-dev libgmp-dev libmuparser-dev libncurses-dev libpng-dev libprotobuf-dev
  libtbb-dev libtinygltf-dev libtomlplusplus-dev libxxhash-dev libzstd-dev zlib1g-dev)
# what pictures are drawn with, opened at run time: OSMesa where the release has it, and EGL with Mesa's software renderer
renderers=('libosmesa6?' libegl1 libgl1-mesa-dri)
tests=(libgtest-dev python3 python3-jsonschema python3-numpy binutils)
clang=(clang 'libclang-rt-dev|libclang-rt-19-dev|libclang-rt-18-dev|libclang-rt-14-dev')
ros=(librosbag-storage-dev libsensor-msgs-dev libnav-msgs-dev libgeometry-msgs-dev libroscpp-dev libdiagnostic-msgs-dev
  libtf2-msgs-dev python3-rosmaster)
peers=(libpcl-dev libcgal-dev 'libopen3d-dev?' 'libmrpt-slam-dev|libmrpt-dev' libceres-dev)

word=''
list=no
wanted=()
extra=()
for argument in "$@"; do
  case $argument in
    --with-ros) extra+=("${ros[@]}") ;;
    --with-peers) extra+=("${peers[@]}") ;;
    --list) list=yes ;;
    -*)
      echo "install-deps: unknown option $argument; there are --with-ros, --with-peers and --list" >&2
      exit 2
      ;;
    *)
      [[ -z $word ]] || { echo "install-deps: one word at most: $word, $argument" >&2; exit 2; }
      word=$argument
      ;;
  esac
done
case ${word:-test} in
  demo) wanted=("${build[@]}" "${libraries[@]}" "${renderers[@]}") ;;
  test) wanted=("${build[@]}" "${libraries[@]}" "${renderers[@]}" "${tests[@]}") ;;
  package) wanted=("${build[@]}" "${libraries[@]}" dpkg-dev file) ;;
  check | fuzz) wanted=("${build[@]}" "${libraries[@]}" "${renderers[@]}" "${tests[@]}" "${clang[@]}" libbenchmark-dev) ;;
  bench) wanted=("${build[@]}" "${libraries[@]}" "${renderers[@]}" "${tests[@]}" libbenchmark-dev) ;;
  format) wanted=(clang-format) ;;
  docs) wanted=(graphviz) ;;
  lint) wanted=("${build[@]}" "${libraries[@]}" "${renderers[@]}" "${tests[@]}" "${clang[@]}" clang-tidy) ;;
  cross-arm64) wanted=("${build[@]}" "${libraries[@]/%/:arm64}" libc6-dev:arm64 g++-aarch64-linux-gnu 'qemu-user|qemu-user-static'
    libgtest-dev:arm64 python3 binutils) ;;
  *)
    echo "install-deps: unknown word $word; there are demo, test, package, check, fuzz, bench, format, docs, lint and cross-arm64" >&2
    exit 2
    ;;
esac
wanted+=(${extra[@]+"${extra[@]}"})

is_installed() {
  local status
  status=$(dpkg-query -W -f='${db:Status-Abbrev}' "$1" 2>/dev/null || true)
  [[ $status == ii* || $status == hi* ]]
}
## ask_apt ENTRY…: which of their packages apt has a candidate for, into `offered`; one question for all, since each takes apt a second
declare -A offered=()
ask_apt() {
  offered=()
  local entry line package='' names=()
  # shellcheck disable=SC2206 # the parts of an entry are words
  for entry in "$@"; do names+=(${entry//[|?]/ }); done
  while IFS= read -r line; do
    case $line in
      [a-z0-9]*:) package=${line%:} ;;
      *'Candidate: (none)') ;;
      *'Candidate: '*) offered[$package]=yes ;;
    esac
  done < <(LC_ALL=C apt-cache policy "${names[@]}" 2>/dev/null)
}
has_lists() { compgen -G '/var/lib/apt/lists/*Packages*' >/dev/null; }

## choose ENTRY: into `chosen` the package to ask for, of `a|b` the first that the release has; nothing if there is none
choose() {
  chosen=''
  local name
  local -a names
  IFS='|' read -ra names <<<"${1%\?}"
  for name in "${names[@]}"; do
    if [[ -n ${offered[$name]-} ]]; then
      chosen=$name
      return
    fi
  done
}

missing=()
for entry in "${wanted[@]}"; do
  IFS='|' read -ra names <<<"${entry%\?}"
  there=no
  for name in "${names[@]}"; do
    if is_installed "$name"; then there=yes; fi
  done
  if [[ $list == yes || $there == no ]]; then missing+=("$entry"); fi
done
[[ ${#missing[@]} -gt 0 ]] || exit 0

packages=()
absent=()
omitted=()
sort_out() {
  packages=()
  absent=()
  omitted=()
  local entry chosen
  ask_apt "${missing[@]}"
  for entry in "${missing[@]}"; do
    choose "$entry"
    if [[ -n $chosen ]]; then
      packages+=("$chosen")
    elif [[ $entry == *\? ]]; then
      omitted+=("${entry%\?}")
    else
      absent+=("$entry")
    fi
  done
}

sort_out
if [[ $list == yes ]]; then
  printf '%s\n' ${packages[@]+"${packages[@]}"}
  [[ ${#absent[@]} -eq 0 ]] || { echo "install-deps: apt knows none of: ${absent[*]}" >&2; exit 3; }
  exit 0
fi
# What the release does not have, and is not needed, is no reason to ask the network again.
if [[ ${#packages[@]} -eq 0 && ${#absent[@]} -eq 0 ]] && has_lists; then exit 0; fi

root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "install-deps: these packages are missing and neither root nor sudo is there to install them: ${missing[*]}" >&2
    exit 3
  fi
  root=(sudo)
fi
"${root[@]}" apt-get update -qq || echo "install-deps: apt-get update failed; going on with the lists that are there" >&2
sort_out
release=$(. /etc/os-release && echo "${PRETTY_NAME:-this system}")
[[ ${#omitted[@]} -eq 0 ]] || echo "install-deps: $release has no ${omitted[*]}; left out" >&2
if [[ ${#absent[@]} -gt 0 ]]; then
  echo "install-deps: the package lists of $release have none of: ${absent[*]}" >&2
  exit 3
fi
[[ ${#packages[@]} -gt 0 ]] || exit 0
echo "installing: ${packages[*]}" >&2
if ! "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${packages[@]}" >&2; then
  echo "install-deps: apt-get could not install: ${packages[*]}" >&2
  exit 3
fi
