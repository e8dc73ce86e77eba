#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# same_bytes_test.sh BUILD: same_bytes.sh finds a build equal to itself, and finds one changed byte, a lost file and another exit status.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
compare() { "$here/same_bytes.sh" "$1" "$build" --only '^edit_plan$' >"$work/said" 2>&1; }
build=$1
"$here/same_bytes.sh" "$build" "$build" --only '^edit_plan$' --keep "$work/kept" || { echo "a build differs from itself"; exit 1; }
compare "$work/kept" || { cat "$work/said"; echo "a build differs from its kept outputs"; exit 1; }

expect_difference() {
  if compare "$work/kept"; then echo "not found: $1"; exit 1; fi
  grep -q "$2" "$work/said" || { cat "$work/said"; echo "not named: $2"; exit 1; }
}
sed -i '0,/1/s//2/' "$work/kept/edit_plan/plan.svg"
expect_difference "a changed byte" "edit_plan/plan.svg differs: line"
rm "$work/kept/edit_plan/plan.svg"
expect_difference "a new file" "edit_plan/plan.svg: only in AFTER"
cp -r "$work/kept/edit_plan/plan.pdf" "$work/kept/edit_plan/other.pdf"
expect_difference "a lost file" "edit_plan/other.pdf: only in BEFORE"
echo 3 >"$work/kept/edit_plan/.status"
expect_difference "another exit status" "edit_plan/.status differs"
