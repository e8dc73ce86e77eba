#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""flat.py HALLWAY OUT: is an iteration's cost flat in the size of the map?

Drives bench/long_path.toml once, replays its log five times, and compares the mean iteration time (thread CPU) of the last
tenth with that of the second tenth, at equal numbers of visible points and as it is. Writes OUT/flat.svg and OUT/flat.json."""
import collections
import csv
import json
import pathlib
import statistics
import subprocess
import sys

RUNS = 5
BINS = 100  # of the plot
COUNT_STEP = 5  # visible points; so near to each other, numbers count as equal


def column(path, name):
    with open(path, newline="") as file:
        return [float(row[name]) for row in csv.DictReader(file)]


def visible_counts(path, iterations):
    counts = collections.Counter()
    with open(path) as file:
        next(file)
        for line in file:
            counts[int(line[: line.index(",")])] += 1
    return [counts[i] for i in range(iterations)]


def tenth(values, index):
    size = len(values) // 10
    return statistics.fmean(values[index * size : (index + 1) * size])


def ratio_at_equal_counts(times, visible):
    """Mean time of the last tenth over that of the second, iterations weighted so that both see the same numbers of points."""
    size = len(times) // 10
    groups = [collections.defaultdict(list), collections.defaultdict(list)]
    for group, index in zip(groups, (9, 1)):
        for i in range(index * size, (index + 1) * size):
            group[int(visible[i]) // COUNT_STEP].append(times[i])
    last = second = 0.0
    for count in groups[0].keys() & groups[1].keys():
        weight = min(len(groups[0][count]), len(groups[1][count]))
        last += weight * statistics.fmean(groups[0][count])
        second += weight * statistics.fmean(groups[1][count])
    return last / second


def binned(values):
    size = len(values) / BINS
    return [statistics.fmean(values[int(i * size) : int((i + 1) * size)]) for i in range(BINS)]


def polyline(values, top, colour, width=640, height=220, left=70, base=270):
    step = width / (len(values) - 1)
    points = " ".join(f"{left + i * step:.1f},{base - height * value / top:.1f}" for i, value in enumerate(values))
    return f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"/>'


def plot(times_us, visible, landmarks, ratio):
    top = 1.5 * max(times_us)
    scale = top / (2.5 * max(visible))
    text = 'font-family="DejaVu Sans, sans-serif" font-size="13" fill="#262b33"'
    rows = [
        '<svg xmlns="http://www.w3.org/2000/svg" width="760" height="340" viewBox="0 0 760 340">',
        '<rect width="760" height="340" fill="#faf8f3"/>',
        f'<text x="70" y="26" {text} font-weight="bold">slam_point: time per iteration over new ground</text>',
        '<line x1="70" y1="270" x2="710" y2="270" stroke="#707680"/>',
        '<line x1="70" y1="50" x2="70" y2="270" stroke="#707680"/>',
    ]
    for share in (0.0, 0.5, 1.0):
        y = 270 - 220 * share
        rows.append(f'<text x="62" y="{y + 4:.0f}" {text} text-anchor="end">{top * share:.0f}</text>')
        x = 70 + 640 * share
        rows.append(f'<text x="{x:.0f}" y="290" {text} text-anchor="middle">{landmarks * share:.0f}</text>')
    rows += [
        f'<text x="390" y="312" {text} text-anchor="middle">landmarks in the map</text>',
        f'<text x="18" y="160" {text} text-anchor="middle" transform="rotate(-90 18 160)">µs (thread CPU)</text>',
        polyline(times_us, top, "#d55e00"),
        polyline([v * scale for v in visible], top, "#0068a8"),
        f'<text x="700" y="70" {text} text-anchor="end">last tenth / second tenth, equal counts: {ratio:.3f}</text>',
        f'<text x="70" y="332" {text}><tspan fill="#d55e00">■</tspan> time per iteration, median of {RUNS} runs   '
        f'<tspan fill="#0068a8">■</tspan> visible points (mean {statistics.fmean(visible):.0f})</text>',
        "</svg>",
    ]
    return "\n".join(rows) + "\n"


def main():
    hallway, out = sys.argv[1], pathlib.Path(sys.argv[2])
    here = pathlib.Path(__file__).resolve().parent
    out.mkdir(parents=True, exist_ok=True)
    run = out / "long_path"
    subprocess.run([hallway, "run", here / "long_path.toml", "--out", run, "--force", "--quiet"], check=True)
    times = []
    for _ in range(RUNS):
        replay = out / "long_path_replay"
        subprocess.run([hallway, "replay", run, "--out", replay, "--force", "--quiet"], check=True)
        times.append(column(replay / "timing.csv", "cpu_ms"))
    visible = visible_counts(run / "observations.csv", len(times[0]))
    landmarks = json.loads((run / "metrics.json").read_text())["landmarks_mapped"]
    ratios = [tenth(t, 9) / tenth(t, 1) for t in times]
    equal = [ratio_at_equal_counts(t, visible) for t in times]
    seen = tenth(visible, 9) / tenth(visible, 1)
    result = {
        "schema": "hallway.bench.flat/1",
        "iterations": len(times[0]),
        "landmarks": landmarks,
        "ratio_median": statistics.median(ratios),
        "ratio_runs": ratios,
        "visible_ratio": seen,
        "ratio_at_equal_counts_median": statistics.median(equal),
        "ratio_at_equal_counts_runs": equal,
    }
    (out / "flat.json").write_text(json.dumps(result, indent=2) + "\n")
    median_us = [1000.0 * statistics.median(sample) for sample in zip(*times)]
    (out / "flat.svg").write_text(plot(binned(median_us), binned(visible), landmarks, result["ratio_at_equal_counts_median"]))
    print(f"flat in map size ({landmarks} landmarks at the end, {RUNS} runs):")
    for label, values in (("at equal numbers of visible points", equal), ("as it is", ratios)):
        print(f"  mean iteration, last tenth / second tenth, {label}: {statistics.median(values):.3f} (runs: "
              + ", ".join(f"{value:.3f}" for value in values) + ")")
    print(f"  visible points, last tenth / second tenth: {seen:.3f}")
    print(f"  plot: {out / 'flat.svg'}")


if __name__ == "__main__":
    main()
