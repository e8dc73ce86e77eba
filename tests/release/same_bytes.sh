#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# same_bytes.sh HALLWAY: short runs of the demonstrations give the bytes that were recorded for machines of this class, whatever the release of Debian.
#
# Pictures are not among them: Mesa compiles its shaders for the very processor. try-debian.sh compares them on one machine.
#
# A class is the processor's family and whether it fuses multiplication and addition, since the C library picks its sin and cos by that. Where none is recorded
# the test is skipped (status 77) and prints what to append to demo.sha256. Bytes that a change of Hallway changes on purpose are recorded the same way:
# remove the lines of the class and run the test.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
class=$(uname -m)
if [[ $class == x86_64 ]] && grep -qw fma /proc/cpuinfo; then class=$class+fma; fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$here/../../scripts/reference-runs.sh" "$work" "$1" | grep -v "/top.png$" | sed "s|^|$class  |" >"$work/now"
grep -v '^#' "$here/demo.sha256" | grep -F "$class  " >"$work/recorded" || true
if [[ ! -s $work/recorded ]]; then
  echo "nothing is recorded for machines of the class $class; this one gives:"
  cat "$work/now"
  exit 77
fi
if ! diff "$work/recorded" "$work/now"; then
  echo "not the recorded bytes (<) but others (>); $(. /etc/os-release && echo "$PRETTY_NAME"), $(ldd --version | head -n 1)"
  exit 1
fi
wc -l <"$work/now" | sed 's/$/ files have the recorded bytes/'
