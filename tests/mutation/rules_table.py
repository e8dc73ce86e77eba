#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""rules_table.py [--write] SOURCE: whether rules.txt, the patches, the tests and the table in docs/algorithms/relative-plane.md agree.

All 37 rules have a line in rules.txt, with a patch whose lines are in the source and a test that is there; the table has a row for each, which names the files that the patch changes,
the test and the patch. With --write the last two columns of the table are written from rules.txt. Status 1 and a message for each thing that is not so.
"""
import pathlib
import re
import sys

from apply_patch import hunks

RULES = range(1, 38)
CODE = "plugins/slam_plane/thesis/"


def listed(source):
    """Rule -> (patch, test) of rules.txt."""
    rows = {}
    for line in (source / "tests/mutation/rules.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            rule, patch, test = line.split()
            rows[int(rule)] = (patch, test)
    return rows


def tests_there(source):
    text = "".join(path.read_text() for path in sorted((source / "tests/unit/slam_plane_thesis").glob("*.cpp")))
    return {f"{suite}.{name}" for suite, name in re.findall(r"^TEST\((Rule\d\d),\s*(\w+)\)", text, re.M)}


def check_patch(source, patch):
    """What is wrong with a patch, and the names of the files that it changes."""
    wrong, files = [], set()
    if not patch.exists():
        return [f"{patch.name} is not there"], files
    for file, before, after in hunks(patch):
        path = source / file
        count = path.read_text().count(before) if path.exists() else 0
        if count != 1 or before == after:
            wrong.append(f"{patch.name}: its lines are in {file} {count} times, not once")
        files.add(pathlib.Path(file.removeprefix(CODE)).stem)
    return (wrong if files else wrong + [f"{patch.name} changes nothing"]), files


def main():
    write = "--write" in sys.argv
    source = pathlib.Path([argument for argument in sys.argv[1:] if argument != "--write"][0])
    rows, there, wrong = listed(source), tests_there(source), []
    if sorted(rows) != list(RULES):
        wrong.append(f"rules.txt has the rules {sorted(rows)}")
    if there != {test for _, test in rows.values()}:
        wrong.append(f"rules.txt and the tests differ: {sorted(there ^ {test for _, test in rows.values()})}")
    document = source / "docs/algorithms/relative-plane.md"
    lines, rules_in_table = document.read_text().splitlines(), []
    for i, line in enumerate(lines):
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if not line.startswith("|") or not cells[0].isdigit() or int(cells[0]) not in rows:
            continue
        rule = int(cells[0])
        rules_in_table.append(rule)
        patch, test = rows[rule]
        faults, changed = check_patch(source, source / "tests/mutation" / patch)
        wrong += faults
        if write:
            cells = cells[:3] + [f"`{test}`", f"`{patch}`"]
            lines[i] = "| " + " | ".join(cells) + " |"
        if cells[3:] != [f"`{test}`", f"`{patch}`"]:
            wrong.append(f"the table's row of rule {rule} does not name {test} and {patch}")
        named = set(re.findall(r"`(\w+)`", cells[2]))
        wrong += [f"the table's row of rule {rule} does not name {file}" for file in sorted(changed - named)]
        wrong += [f"the table's row of rule {rule} names {file}, which is not there"
                  for file in sorted(named) if not list((source / CODE).glob(f"{file}.?pp"))]
    if rules_in_table != list(RULES):
        wrong.append(f"the table has the rules {rules_in_table}")
    if write:
        document.write_text("\n".join(lines) + "\n")
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
