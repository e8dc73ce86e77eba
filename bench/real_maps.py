#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compiles every map of the data folder and prints the tables of docs/real-maps.md.

    real_maps.py HALLWAY [DATA]      DATA: the environment variable HALLWAY_DATA, else ../shared/data beside the source tree
"""
import json
import os
import pathlib
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parent.parent


def compile_map(hallway, file):
    done = subprocess.run([hallway, "compile", str(file), "--level", "full", "--threads", "1", "--no-cache", "--json"],
                          capture_output=True, text=True, timeout=600)
    return done.returncode, json.loads(done.stdout)


def seconds(result, *names):
    return sum(stage["seconds"] for stage in result["stages"] if stage["name"] in names)


def row(name, result):
    visible = result["visible"]
    leak = result["leak"]
    verdict = "sealed" if result["sealed"] else "leaks" if leak else "encloses nothing"
    cells = [name, str(result["brushes"]["used"]), str(result["polygons"]), f"{result['leaves']} ({result['leaves_empty']})",
             str(result["clusters"]), str(result["portals"]), verdict,
             f"{100 * visible['mean_share']:.1f} %" if visible else "",
             f"{seconds(result, 'brushes', 'partition'):.2f}", f"{seconds(result, 'visibility'):.2f}" if visible else "",
             f"{result['memory_peak_bytes'] / 2**20:.0f}"]
    return "| " + " | ".join(cells) + " |"


HEAD = """| map | brushes | polygons | leaves (empty) | clusters | portals | | visible | compile, s | visibility, s | MiB |
|---|---|---|---|---|---|---|---|---|---|---|"""


def main():
    hallway = os.path.realpath(sys.argv[1])
    data = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else os.environ.get("HALLWAY_DATA", SOURCE / "../shared/data"))
    maps = data / "maps"
    if not maps.is_dir():
        print(f"there are no maps in {maps}", file=sys.stderr)
        return 3
    print(HEAD)
    refused, counts = [], {}
    for file in sorted(maps.rglob("*.map")):
        status, result = compile_map(hallway, file)
        name = str(file.relative_to(maps))
        if status == 3:
            error = result.get("error", result)
            refused.append(f"| {name} | {error.get('message', error)} |")
        elif file.parent.name in ("id1", "librequake") and file.parent.parent == maps or result["brushes"]["used"] >= 500:
            print(row(name, result))
        else:
            verdict = "sealed" if result["sealed"] else "leaks" if result["leak"] else "encloses nothing"
            counts[verdict] = counts.get(verdict, 0) + 1
        if status not in (0, 1, 3):
            print(f"{file}: status {status}", file=sys.stderr)
            return 1
    print("\nOf the small maps " + ", ".join(f"{counts[k]} {k}" for k in sorted(counts)) + ".\n")
    print("| refused | why |\n|---|---|\n" + "\n".join(refused))
    return 0


if __name__ == "__main__":
    sys.exit(main())
