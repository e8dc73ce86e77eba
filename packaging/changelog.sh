#!/bin/sh
# SPDX-License-Identifier: MIT
# changelog.sh PACKAGE VERSION MAINTAINER DATE < CHANGELOG.md: what CHANGELOG.md says of VERSION, as Debian's changelog.
set -eu
printf '%s (%s) unstable; urgency=medium\n\n' "$1" "$2"
awk -v wanted="$2" '
  function put(text,  count, words, i, line) {
    if (text == "") return
    count = split(text, words, /[ \t]+/)
    line = "  *"
    for (i = 1; i <= count; ++i) {
      if (length(line) + 1 + length(words[i]) > 79) { print line; line = "   " }
      line = line " " words[i]
    }
    print line
    lines += 1
  }
  /^## / { put(item); item = ""; inside = ($2 == wanted); next }
  !inside { next }
  /^### / { put(item); item = ""; printf "\n  [ %s ]\n", substr($0, 5); next }
  /^- / { put(item); item = substr($0, 3); next }
  { sub(/^[ \t]+/, ""); if ($0 != "" && item != "") item = item " " $0 }
  END { put(item); if (!lines) { print "changelog: CHANGELOG.md does not tell of " wanted > "/dev/stderr"; exit 1 } }
'
printf '\n -- %s  %s\n' "$3" "$4"
