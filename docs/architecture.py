#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the house: which folder links which, from the link table of a build, as docs/figures/architecture.svg.

usage: architecture.py [--check] [BUILD]

BUILD is a configured build folder [build/release]; its links.tsv is written by cmake/HallwayLinks.cmake. An arrow leads
from a folder to one that it links; arrows that others imply are left out. Graphviz lays it out
(scripts/install-deps.sh docs). With --check nothing is drawn: status 1, and the differing links, where the picture shows others than the build.
"""
import html
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PICTURE = ROOT / "docs" / "figures" / "architecture.svg"
COLOURS = {"programs": "#f6d5b5", "plugins": "#d7e8c8", "engine": "#cfe0f3", "foundation": "#e6e2d3"}


def group(folder):
    if folder in ("sdk", "geometry"):
        return "foundation"
    return {"engine": "engine", "editor": "engine", "plugins": "plugins"}.get(folder.split("/")[0], "programs")


def read_links(build):
    """By folder: the folders that it links, itself apart."""
    targets, rows = {}, []
    for line in (build / "links.tsv").read_text().splitlines():
        target, folder, public, private = line.split("\t")
        if target == "never" or target.endswith("precompiled") or folder.startswith("sdk/"):
            continue
        folder = re.sub("^robot/drivers/.*", "robot/drivers", folder)  # one that needs ROS is not in every build
        targets[target] = folder
        rows.append((folder, public.split(",") + private.split(",")))
    links = {folder: set() for folder in targets.values()}
    for folder, linked in rows:
        links[folder] |= {targets[target] for target in linked if target in targets} - {folder}
    return links


def reach(links):
    """By folder: all that it links, directly or by way of others."""
    known = {}

    def of(folder, above=()):
        if folder in above:
            sys.exit(f"a cycle of links: {' -> '.join(above + (folder,))}")
        if folder not in known:
            known[folder] = set().union(links[folder], *(of(f, above + (folder,)) for f in links[folder]))
        return known[folder]

    for folder in links:
        of(folder)
    return known


def without_implied(links):
    below = reach(links)
    return {f: {g for g in linked if not any(g in below[h] for h in linked)} for f, linked in links.items()}


def table(links):
    """The arrows as text. Those that others imply are left out: optional parts of the build, as those of ROS, only add such."""
    return "\n".join(f"{folder}: {' '.join(sorted(linked))}".rstrip() for folder, linked in sorted(without_implied(links).items()))


def draw(links):
    lines = ["digraph house {", "rankdir=TB; nodesep=0.18; ranksep=0.42;",
             'node [shape=box, style="filled,rounded", fontname="DejaVu Sans", fontsize=12, height=0.34, margin="0.1,0.04", color="#777777"];',
             'edge [arrowsize=0.6, color="#666666"];']
    for folder in sorted(links):
        name = folder.removeprefix("engine/")
        lines.append(f'"{folder}" [label="{name}", fillcolor="{COLOURS[group(folder)]}"];')
    for folder, linked in sorted(without_implied(links).items()):
        lines += [f'"{folder}" -> "{other}";' for other in sorted(linked)]
    lines.append("}")
    try:
        drawn = subprocess.run(["dot", "-Tsvg"], input="\n".join(lines), capture_output=True, text=True, check=True)
    except FileNotFoundError:
        sys.exit("architecture.py: there is no `dot`: scripts/install-deps.sh docs")
    svg = re.sub(r"<!--.*?-->\n?", "", drawn.stdout, flags=re.DOTALL)
    metadata = f'<metadata id="links">\n{html.escape(table(links))}\n</metadata>\n</svg>'
    return svg.replace("</svg>", metadata)


def shown():
    found = re.search(r'<metadata id="links">\n(.*?)\n</metadata>', PICTURE.read_text(), re.DOTALL)
    return html.unescape(found.group(1)) if found else ""


def main():
    arguments = [a for a in sys.argv[1:] if a != "--check"]
    if len(arguments) > 1 or any(a.startswith("-") for a in arguments):
        sys.exit(__doc__)
    build = pathlib.Path(arguments[0]) if arguments else ROOT / "build" / "release"
    if not (build / "links.tsv").exists():
        sys.exit(f"architecture.py: {build} is not a configured build folder: it has no links.tsv")
    links = read_links(build)
    if "--check" in sys.argv[1:]:
        now, old = set(table(links).splitlines()), set(shown().splitlines())
        for line in sorted(old - now):
            print("the picture:", line)
        for line in sorted(now - old):
            print("the build:  ", line)
        sys.exit(1 if now != old else 0)
    PICTURE.write_text(draw(links))
    print(f"{PICTURE.relative_to(ROOT)}: {len(links)} folders")


if __name__ == "__main__":
    main()
