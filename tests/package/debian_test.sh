#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# debian_test.sh BUILD: makes Debian packages of what is built in the folder BUILD, has lintian look at them, installs them in a bare Debian of this machine's
# release, goes through debian_use.sh there, purges them and compares the files before and after. The archive is that of this machine's apt. Exit status 77, and the reason, where that cannot be done.
set -euo pipefail
build=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)

skip() { echo "package_debian: skipped: $*"; exit 77; }
fail() { echo "package_debian: $*" >&2; exit 1; }

command -v mmdebstrap > /dev/null || skip "mmdebstrap is not installed"
command -v apt-get > /dev/null || skip "this is no Debian"
[[ $(id -u) -eq 0 ]] || skip "root is needed for a chroot"
# shellcheck source=/dev/null
release=$(. /etc/os-release && echo "${VERSION_CODENAME-}")
[[ -n $release ]] || skip "this release of Debian has no name"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
packages=$work/packages
"$here/../../scripts/package.sh" "$build" "$packages"
if command -v lintian > /dev/null; then
  lintian --allow-root --fail-on error "$packages"/*.deb || fail "lintian finds errors"
else
  echo "package_debian: lintian is not installed: the packages are not looked at"
fi
# shellcheck disable=SC2016
apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Identifier: Packages' 'Origin: Debian' | sort -u > "$work/sources.list"
[[ -s $work/sources.list ]] || skip "this machine's apt knows no archive of Debian"
apt-config dump | grep -E '^Acquire::(Check|http|https|ftp|Retries)' > "$work/apt.conf" || true

# The work is done in a hook, so that mmdebstrap undoes all that it has mounted; no system is kept.
cat > "$work/hook" <<END
#!/bin/sh
set -eu
touch "$work/begun"
mkdir "\$1/hallway-test"
cp "$packages"/*.deb "$here/debian_use.sh" "\$1/hallway-test"
chroot "\$1" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root sh /hallway-test/debian_use.sh
touch "$work/done"
END
chmod +x "$work/hook"
mmdebstrap --quiet --mode=root --variant=apt --aptopt="$work/apt.conf" --customize-hook="$work/hook" \
  "$release" /dev/null "$work/sources.list" 2> "$work/log" || true
if [[ ! -e $work/begun ]]; then
  tail -n 5 "$work/log" >&2
  skip "no bare Debian $release could be made: the archive is out of reach, or a chroot is not allowed"
fi
[[ -e $work/done ]] || { tail -n 40 "$work/log" >&2; fail "failed in Debian $release"; }
echo "package_debian: installed, used and purged in a bare Debian $release"
