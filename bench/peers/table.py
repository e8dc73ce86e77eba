#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""table.py RESULTS: the first plugin of a results.json of `hallway bench-em` beside the others, as a table in Markdown.

Times are medians over the scenes: wall clock, and CPU of the calling thread, which another program that is busy disturbs less. The
last column is how many times as long as the first plugin one takes, by CPU."""
import json
import sys


def row(plugin, reference_ms):
    score = plugin["score"]
    pairs = [f"{at['precision'] or 0:.3f} / {at['recall'] or 0:.3f}" for at in score["iou"]]
    normal = score["normal_error_deg"]
    cpu = plugin["cpu_ms"]["median"]
    cells = [f"`{plugin['plugin']}`", *pairs, f"{normal['mean']:.3f}°" if normal else "-", f"{plugin['ms']['median']:.1f}", f"{cpu:.1f}", f"{cpu / reference_ms:.1f}"]
    return "| " + " | ".join(cells) + " |"


def main():
    with open(sys.argv[1]) as file:
        plugins = json.load(file)["plugins"]
    first, *others = plugins
    reference = first["cpu_ms"]["median"]
    print("| | IoU 0.8, precision / recall | 0.9 | 0.95 | normal error, mean | ms, median | CPU ms, median | times |")
    print("|---|---|---|---|---|---|---|---|")
    for plugin in plugins:
        print(row(plugin, reference))
    if others:
        fastest = min(others, key=lambda plugin: plugin["cpu_ms"]["median"])
        print(f"\n{first['plugin']} is {fastest['cpu_ms']['median'] / reference:.1f} times as fast as the fastest other, {fastest['plugin']}")


if __name__ == "__main__":
    main()
