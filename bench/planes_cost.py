#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""planes_cost.py HALLWAY OUT [MOST]: how does the cost of em grow with the number of points?

Runs em on scenes of 12 planes and 2 cm of noise with 1 000 to MOST (1 000 000) points, three scenes of each size, and compares the time
of a call (CPU of one thread, median) with n log n. Writes OUT/em_cost.svg and OUT/em_cost.json."""
import json
import math
import pathlib
import statistics
import subprocess
import sys

SIZES = [1000, 3000, 10000, 30000, 100000, 300000, 1000000]
SCENES = 3
LEFT, RIGHT, TOP, BASE = 80, 720, 50, 290
LOW_MS, HIGH_MS = 1.0, 5000.0


def measure(hallway, points):
    command = [hallway, "bench-em", "--plugin", "em:threads=1", "--scenes", str(SCENES), "--seed", "3", "--planes", "12", "--points", str(points),
               "--sigma", "0.02", "--repeat", "3" if points < 300000 else "1", "--in-process", "--quiet", "--json"]
    document = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    result = document["plugins"][0]
    return {
        "points": statistics.median(scene["points"] for scene in result["scenes"]),
        "cpu_ms": result["cpu_ms"]["median"],
        "ms": result["ms"]["median"],
        "recall": result["score"]["iou"][0]["recall"],
    }


def growth_over_n_log_n(first, row):
    """How many times as long as the first it takes, by how many times as large n log n is: 1 where the cost grows like that."""
    return row["cpu_ms"] / first["cpu_ms"] * n_log_n(first["points"]) / n_log_n(row["points"])


def n_log_n(points):
    return points * math.log(points)


def x_of(points):
    return LEFT + (RIGHT - LEFT) * math.log10(points / SIZES[0]) / math.log10(SIZES[-1] / SIZES[0])


def y_of(ms):
    return BASE - (BASE - TOP) * math.log(ms / LOW_MS) / math.log(HIGH_MS / LOW_MS)


def polyline(pairs, style):
    points = " ".join(f"{x_of(n):.1f},{y_of(ms):.1f}" for n, ms in pairs)
    return f'<polyline points="{points}" fill="none" {style}/>'


def plot(rows):
    text = 'font-family="DejaVu Sans, sans-serif" font-size="13" fill="#262b33"'
    first = rows[0]
    share = first["cpu_ms"] / n_log_n(first["points"])
    line = [(row["points"], share * n_log_n(row["points"])) for row in rows]
    out = [
        '<svg xmlns="http://www.w3.org/2000/svg" width="760" height="360" viewBox="0 0 760 360">',
        '<rect width="760" height="360" fill="#faf8f3"/>',
        f'<text x="{LEFT}" y="26" {text} font-weight="bold">em: time for a cloud, one thread</text>',
        f'<clipPath id="frame"><rect x="{LEFT}" y="{TOP}" width="{RIGHT - LEFT}" height="{BASE - TOP}"/></clipPath>',
    ]
    for ms in (1, 10, 100, 1000):
        out.append(f'<line x1="{LEFT}" y1="{y_of(ms):.1f}" x2="{RIGHT}" y2="{y_of(ms):.1f}" stroke="#d9d5cb"/>')
        out.append(f'<text x="{LEFT - 8}" y="{y_of(ms) + 4:.1f}" {text} text-anchor="end">{ms} ms</text>')
    for points in (1000, 10000, 100000, 1000000):
        number = f"{points:,}".replace(",", " ")
        out.append(f'<text x="{x_of(points):.1f}" y="{BASE + 20}" {text} text-anchor="middle">{number}</text>')
    out.append(f'<text x="{(LEFT + RIGHT) // 2}" y="{BASE + 42}" {text} text-anchor="middle">points</text>')
    out.append(polyline(line, 'stroke="#0068a8" stroke-width="2" stroke-dasharray="6 5" clip-path="url(#frame)"'))
    out.append(polyline([(row["points"], row["cpu_ms"]) for row in rows], 'stroke="#d55e00" stroke-width="2"'))
    for row in rows:
        x, y = x_of(row["points"]), y_of(row["cpu_ms"])
        anchor = "start" if row is first else "middle"
        out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="#d55e00"/>')
        out.append(f'<text x="{x:.1f}" y="{y + 18:.1f}" {text} text-anchor="{anchor}">{row["cpu_ms"]:.3g}</text>')
    legend = [("#d55e00", f"CPU time, median of {SCENES} scenes"), ("#0068a8", "n log n from the smallest")]
    for place, (colour, words) in enumerate(legend):
        out.append(f'<text x="{LEFT + 260 * place}" y="{BASE + 62}" {text}><tspan fill="{colour}">■</tspan> {words}</text>')
    out.append("</svg>")
    return "\n".join(out) + "\n"


def main():
    hallway, out = sys.argv[1], pathlib.Path(sys.argv[2])
    most = int(sys.argv[3]) if len(sys.argv) > 3 else SIZES[-1]
    out.mkdir(parents=True, exist_ok=True)
    rows = [measure(hallway, points) for points in SIZES if points <= most]
    print("  points    CPU ms   growth over n log n, from the smallest   from the one before   recall at IoU 0.8")
    for before, row in zip([rows[0], *rows], rows):
        row["over_n_log_n"] = growth_over_n_log_n(rows[0], row)
        row["step_over_n_log_n"] = growth_over_n_log_n(before, row)
        print(f"{row['points']:>8.0f} {row['cpu_ms']:>9.1f} {row['over_n_log_n']:>40.3f} {row['step_over_n_log_n']:>21.3f} {row['recall']:>19.3f}")
    (out / "em_cost.svg").write_text(plot(rows))
    (out / "em_cost.json").write_text(json.dumps({"schema": "hallway.bench.em_cost/1", "sizes": rows}, indent=1) + "\n")


if __name__ == "__main__":
    main()
