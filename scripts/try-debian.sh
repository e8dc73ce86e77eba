#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds and tests the last commit on another release of Debian, in a chroot that mmdebstrap makes once and later calls use again.
#
#   try-debian.sh RELEASE [demo] [test] [same] [cross-arm64]      all but the last if none is named; e.g. try-debian.sh trixie demo
#
#   demo         `make demo` there
#   test         `make test` there
#   same         short runs there and here give the same bytes (reference-runs.sh); here by build/release/bin/hallway, which `make demo` builds
#   cross-arm64  everything is compiled for arm64 there, and what a robot needs runs under qemu-user (cross-arm64.sh)
#
# The archive is that which apt is configured with here. The chroot stands in $HALLWAY_CHROOTS (build/chroots), a gigabyte or two each; removing the folder
# is all it takes to be rid of it. Each call begins with a fresh clone, but with the build of the last one if --keep is given. What `make` prints goes to
# RELEASE.log beside the chroot. Needs root or sudo, for the chroot.
#
# Status: 0 all that was asked for passed; 1 something failed; 2 usage; 77 not tried, since mmdebstrap, root or that release's archive is not to be had.
set -euo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)

usage() {
  echo "try-debian: $1; usage: try-debian.sh RELEASE [--keep] [demo] [test] [same] [cross-arm64]" >&2
  exit 2
}
not_tried() {
  echo "try-debian: not tried: $1"
  exit 77
}

keep=no
release=''
steps=()
for argument in "$@"; do
  case $argument in
    --keep) keep=yes ;;
    demo | test | same | cross-arm64) [[ -n $release ]] || usage "the release comes first"; steps+=("$argument") ;;
    *)
      [[ -z $release && $argument =~ ^[a-z][a-z0-9.-]*$ ]] || usage "what is $argument"
      release=$argument
      ;;
  esac
done
[[ -n $release ]] || usage "which release"
[[ ${#steps[@]} -gt 0 ]] || steps=(demo test same)

command -v mmdebstrap >/dev/null || not_tried "mmdebstrap is not installed"
if [[ $(id -u) -ne 0 ]]; then
  command -v sudo >/dev/null || not_tried "neither root nor sudo is there, and a chroot needs one"
  exec sudo --preserve-env=HALLWAY_CHROOTS,HALLWAY_DATA,JOBS,http_proxy,https_proxy "$0" "$@"
fi

chroots=${HALLWAY_CHROOTS:-$here/build/chroots}
mkdir -p "$chroots"
chroots=$(cd "$chroots" && pwd)
root=$chroots/$release
log=$chroots/$release.log
: >"$log"

## where apt gets Debian from on this machine
archive() {
  # shellcheck disable=SC2016 # apt's own names
  apt-get indextargets --format '$(REPO_URI)' 'Origin: Debian' 'Label: Debian' 'Component: main' 'Created-By: Packages' | sort -u | head -n 1
}

make_chroot() {
  local uri probe
  uri=$(archive)
  [[ -n $uri ]] || not_tried "apt knows no archive of Debian here (apt-get update may help)"
  probe=$(mktemp -d)
  if ! /usr/lib/apt/apt-helper -qq download-file "${uri%/}/dists/$release/Release" "$probe/Release" >>"$log" 2>&1; then
    rm -rf "$probe"
    not_tried "the archive that apt is configured with does not give $release"
  fi
  rm -rf "$probe"
  echo "try-debian: making $root"
  if ! mmdebstrap --variant=minbase --include=ca-certificates,git,make --aptopt='Acquire::Languages "none"' \
    "$release" "$root.new" "$uri" >>"$log" 2>&1; then
    rm -rf "$root.new"
    tail -n 3 "$log"
    echo "try-debian: mmdebstrap could not make the chroot; see $log" >&2
    exit 1
  fi
  # As this machine reaches the archive, so does the chroot.
  apt-config dump | grep -E '^Acquire::[a-z]+::Proxy' >"$root.new/etc/apt/apt.conf.d/90host" || true
  mv "$root.new" "$root"
}

## inside COMMAND…: in the chroot, with mounts and processes of its own that end with it
inside() { enter --mount "$@"; }

## inside_emulating COMMAND…: the same, where the kernel starts arm64 programs with the chroot's qemu: in a user namespace, so that the rest of the machine
## does not (Linux 6.7)
inside_emulating() { enter '--mount --user --map-root-user' "$@"; }

enter() {
  local namespaces=$1
  shift
  # shellcheck disable=SC2016,SC2086
  unshare $namespaces --propagation private --pid --fork --kill-child bash -c '
    set -e
    namespaces=$0 root=$1
    shift
    cp -L /etc/resolv.conf "$root/etc/resolv.conf" 2>/dev/null || true
    mount -t proc proc "$root/proc"
    mount --rbind /sys "$root/sys"
    mount --rbind /dev "$root/dev"
    data=()
    if [[ -d ${HALLWAY_DATA-} ]]; then
      mkdir -p "$root/data"
      mount --bind "$HALLWAY_DATA" "$root/data"
      data=(HALLWAY_DATA=/data)
    fi
    if [[ $namespaces == *--user* ]]; then
      qemu=$(ls "$root"/usr/bin/qemu-aarch64 "$root"/usr/bin/qemu-aarch64-static 2>/dev/null | head -n 1)
      mount -t binfmt_misc none "$root/proc/sys/fs/binfmt_misc"
      printf "%s" ":arm64:M::\\x7fELF\\x02\\x01\\x01\\x00\\x00\\x00\\x00\\x00\\x00\\x00\\x00\\x00\\x02\\x00\\xb7\\x00:\\xff\\xff\\xff\\xff\\xff\\xff\\xff\\x00\\xff\\xff\\xff\\xff\\xff\\xff\\xff\\xff\\xfe\\xff\\xff\\xff:$qemu:FPOC" \
        >"$root/proc/sys/fs/binfmt_misc/register"
    fi
    exec chroot "$root" env -u HALLWAY_DATA "${data[@]}" HOME=/root LC_ALL=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"' \
    "$namespaces" "$root" "$@"
}

clone() {
  local from=$root/root/hallway.git
  rm -rf "$from"
  git clone -q --bare --no-hardlinks "$here" "$from"
  local commit
  commit=$(git -C "$here" rev-parse HEAD)
  [[ $keep == yes ]] || rm -rf "$root/root/hallway"
  if [[ ! -d $root/root/hallway ]]; then git clone -q "$from" "$root/root/hallway"; fi
  git -C "$root/root/hallway" fetch -q "$from" HEAD
  git -C "$root/root/hallway" reset -q --hard "$commit"
  [[ -z $(git -C "$here" status --porcelain) ]] || echo "try-debian: what is not committed is not tried"
}

failed=()
## step NAME COMMAND…
step() {
  local name=$1 begin=$SECONDS
  shift
  echo "== $name: $*" >>"$log"
  if "$@" >>"$log" 2>&1; then
    echo "try-debian: $release $name: passed ($((SECONDS - begin)) s)"
  else
    failed+=("$name")
    echo "try-debian: $release $name: FAILED ($((SECONDS - begin)) s); the end of $log:"
    tail -n 15 "$log"
  fi
}
make_there() { inside make -C /root/hallway ${JOBS:+JOBS="$JOBS"} "$@"; }

same() {
  local work
  work=$(mktemp -d)
  [[ -x $here/build/release/bin/hallway ]] || { echo "build/release/bin/hallway is not built here: make demo"; return 1; }
  "$here/scripts/reference-runs.sh" "$work/here" "$here/build/release/bin/hallway" | tee "$work/here.sha256" || return 1
  inside bash -c 'rm -rf /root/there && cd /root/hallway && scripts/reference-runs.sh /root/there build/release/bin/hallway' |
    tee "$work/there.sha256" || return 1
  [[ $(wc -l <"$work/here.sha256") -eq 8 ]] || return 1
  diff "$work/here.sha256" "$work/there.sha256"
  local status=$?
  rm -rf "$work"
  return $status
}

cross_arm64() {
  inside dpkg --add-architecture arm64 || return 1
  inside bash -c 'cd /root/hallway && scripts/install-deps.sh cross-arm64 && scripts/cross-arm64.sh all' || return 1
  if inside_emulating true; then
    inside_emulating bash -c 'cd /root/hallway && scripts/cross-arm64.sh robot'
  else
    echo "try-debian: this kernel does not start programs of another machine in a user namespace; plugins ran in-process alone"
  fi
}

[[ -d $root ]] || make_chroot
clone
for name in "${steps[@]}"; do
  case $name in
    demo | test) step "make $name" make_there "$name" ;;
    same) step same same ;;
    cross-arm64) step cross-arm64 cross_arm64 ;;
  esac
done
if [[ ${#failed[@]} -gt 0 ]]; then
  echo "try-debian: $release: failed: ${failed[*]}"
  exit 1
fi
echo "try-debian: $release: all passed"
