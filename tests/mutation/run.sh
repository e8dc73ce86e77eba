#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Takes each rule of the thesis away, one at a time, and expects exactly its test to fail among those of all rules (suites Rule01, Rule02, …).
#
#   run.sh SOURCE BUILD [RULE …]
#
# SOURCE is the repository, BUILD a folder for a copy of what is needed and for its build. rules.txt names for each rule the patch that removes it and the test. Status 0: all as
# expected; 1: not. CXX names the compiler, CMAKE_BUILD_PARALLEL_LEVEL how many files are compiled at once (1 if it is not set).
set -euo pipefail

if [[ $# -lt 2 ]]; then
  echo "usage: run.sh SOURCE BUILD [RULE …]" >&2
  exit 2
fi
source=$(realpath "$1")
build=$2
shift 2
only=" $* "
here=$source/tests/mutation
tree=$build/tree
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-1}

# A file that is the same as before keeps its time, so that it is not compiled again.
copy() {
  for file in "$@"; do
    if ! cmp -s "$source/$file" "$tree/$file"; then
      mkdir -p "$(dirname "$tree/$file")"
      cp "$source/$file" "$tree/$file"
    fi
  done
}

files() {
  (cd "$source" && find geometry plugins/options plugins/slam_plane/core plugins/slam_plane/thesis tests/unit/slam_plane tests/unit/slam_plane_thesis \
    tests/support bench/plane_road.hpp engine/base/random.hpp engine/base/random.cpp -name '*.[ch]pp' | sort)
}

compile() {
  cmake --build "$build/project" >"$build/compile.log" 2>&1 || {
    grep -m 5 -i error "$build/compile.log" >&2 || tail -5 "$build/compile.log" >&2
    return 1
  }
}

# The tests of rules that fail, one a line.
failing() {
  local log=$build/tests.log status=0
  timeout 600 "$build/project/mutant" --gtest_filter='Rule*' --gtest_color=no --gtest_brief=0 >"$log" 2>&1 || status=$?
  if [[ $status -gt 1 ]]; then
    echo "crashed or hung with status $status"
  fi
  sed -n 's/^\[  FAILED  \] \(Rule[0-9]*\.[A-Za-z0-9_]*\) (.*/\1/p' "$log" | sort -u
}

mkdir -p "$tree"
list=$(files)  # by itself, so that a folder that is not there ends this
mapfile -t wanted <<<"$list"
copy "${wanted[@]}"
(cd "$tree" && find . -type f -printf '%P\n' | sort) | comm -13 <(printf '%s\n' "${wanted[@]}") - |
  while read -r stale; do rm -f "$tree/$stale"; done
cmake -S "$here/project" -B "$build/project" -G Ninja -DTREE="$(realpath "$tree")" >"$build/configure.log" 2>&1 || {
  cat "$build/configure.log" >&2
  exit 1
}

bad=0
compile
before=$(failing)
if [[ -n $before ]]; then
  echo "with all rules these tests fail already:" $before
  exit 1
fi

# Each test of a rule has to be in the table.
listed=$(grep -v '^#' "$here/rules.txt" | awk '{print $3}' | sort)
there=$("$build/project/mutant" --gtest_list_tests --gtest_filter='Rule*' |
  awk '/^[^ ]/ {suite = $1} /^ / && suite ~ /^Rule[0-9]+\.$/ {print suite $1}' | sort)
if ! diff <(echo "$listed") <(echo "$there") >"$build/table.log"; then
  echo "rules.txt (<) and the tests (>) differ:"
  cat "$build/table.log"
  bad=1
fi

while read -r rule patch test; do
  [[ -z $rule || $rule == \#* ]] && continue
  [[ $only == "  " || $only == *" $rule "* ]] || continue
  changed=$(python3 "$here/apply_patch.py" "$here/$patch" "$tree") || {
    echo "rule $rule: $patch does not apply"
    bad=1
    copy "${wanted[@]}"
    continue
  }
  if ! compile; then
    echo "rule $rule: does not compile with $patch"
    bad=1
  elif found=$(failing); [[ $found != "$test" ]]; then
    echo "rule $rule: without it these tests fail:" ${found:-none}
    echo "         expected: $test"
    bad=1
  else
    echo "rule $rule: without it $test fails"
  fi
  copy $changed
done <"$here/rules.txt"
exit $bad
