#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Counts the tokens of production code, comments apart.

usage: count-tokens.py [--folders] [ROOT]

A token is a name, a number, a literal or an operator of C and C++; '#include' lines count too. Production code is
what is shipped: sdk, geometry, engine, editor, cli, robot, loaders, plugins. The last line is the sum; with
--folders, a line for each folder stands before it.
"""
import os
import re
import sys

PRODUCTION = ("sdk", "geometry", "engine", "editor", "app", "cli", "robot", "loaders", "plugins")
ENDINGS = (".h", ".hpp", ".c", ".cpp")
TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)
      | (?P<raw>(?:u8|[uUL])?R"(?P<mark>[^()\\\s]{0,16})\(.*?\)(?P=mark)")
      | (?P<text>(?:u8|[uUL])?"(?:\\.|[^"\\\n])*")
      | (?P<char>(?:u8|[uUL])?'(?:\\.|[^'\\\n])+')
      | (?P<number>\.?\d(?:'?[\w.]|(?<=[eEpP])[+-])*)
      | (?P<name>[A-Za-z_]\w*)
      | (?P<operator><<=|>>=|<=>|\.\.\.|->\*|::|->|\+\+|--|&&|\|\||[-+*/%&|^=!<>]=|<<|>>|\#\#|\S)""",
    re.DOTALL | re.VERBOSE)


def tokens(text):
    return sum(1 for match in TOKEN.finditer(text.replace("\\\n", " ")) if match.lastgroup != "comment")


def files(root):
    for folder in PRODUCTION:
        for path, folders, names in os.walk(os.path.join(root, folder)):
            folders.sort()
            for name in sorted(names):
                if name.endswith(ENDINGS):
                    yield os.path.join(path, name)


def main():
    arguments = sys.argv[1:]
    by_folder = "--folders" in arguments
    arguments = [a for a in arguments if a != "--folders"]
    if len(arguments) > 1 or any(a.startswith("-") for a in arguments):
        sys.exit(__doc__)
    root = arguments[0] if arguments else os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
    if not os.path.isdir(os.path.join(root, "sdk")):
        sys.exit(f"{root}: no folder sdk in it: not a tree of Hallway")
    sums, count = {}, 0
    for path in files(root):
        with open(path, encoding="utf-8") as source:
            number = tokens(source.read())
        folder = "/".join(os.path.relpath(path, root).split(os.sep)[:2])
        sums[folder] = sums.get(folder, 0) + number
        count += 1
    if by_folder:
        for folder, number in sums.items():
            print(f"{number:9d} {folder}")
    print(f"{sum(sums.values()):9d} tokens in {count} files")


main()
