#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""apply_patch.py PATCH TREE: applies a unified diff to the files of a tree, and prints which they are.

Lines are found by their content, not by their numbers: what a hunk takes away, with the lines about it, has to be there exactly once. Status 1 and a message if not.
"""
import pathlib
import sys


def hunks(patch):
    """(file, lines before, lines after) of each hunk."""
    file, before, after = None, None, None
    for line in patch.read_text().splitlines(keepends=True):
        if line.startswith(("--- ", "+++ ", "@@ ")) and before:
            yield file, "".join(before), "".join(after)
            before = None
        if line.startswith("+++ "):
            file = line[4:].split("\t")[0].strip().removeprefix("b/")
        elif line.startswith("@@ "):
            before, after = [], []
        elif before is not None and not line.startswith("\\"):
            if line[0] in " -":
                before.append(line[1:])
            if line[0] in " +":
                after.append(line[1:])
    if before:
        yield file, "".join(before), "".join(after)


def main():
    patch, tree = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    changed = []
    for file, before, after in hunks(patch):
        path = tree / file
        text = path.read_text() if path.exists() else ""
        if text.count(before) != 1:
            print(f"{patch.name}: {file} has the lines that are to be changed {text.count(before)} times:\n{before}", file=sys.stderr)
            return 1
        path.write_text(text.replace(before, after))
        if file not in changed:
            changed.append(file)
    print("\n".join(changed))
    return 0 if changed else 1


if __name__ == "__main__":
    sys.exit(main())
