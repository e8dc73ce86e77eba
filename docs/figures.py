#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""figures.py HALLWAY OUT [NAME...]: runs the studies of docs/performance.md, all or those that are named, and makes their tables and charts.

A study whose folder in OUT has a study.json is not run again. Each table stands in docs/performance.md between `<!-- NAME -->` and
`<!-- /NAME -->`, with the command that makes it; the charts that KEPT names are copied to docs/figures. What agrees with the thesis is not
judged here: the page says it."""
import json
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "performance.md"
SEEDS = 5
KEPT = {  # charts that the page shows
    "figure-eight": ["landmark_error"],
    "density": ["density_log"],
    "map-size": ["time"],
    "stationary": ["landmark_rmse"],
    "forty-loops": ["landmark_rmse_by_loop"],
}
STUDIES = ["figure-eight", "density", "map-size", "straight", "stationary", "victoria-park", "dynamic", "forty-loops"]
KINDS = {  # by study: which findings stand in the table; all where it is not here
    "forty-loops": ["landmark RMSE aligned, at the end", "misassociated observations, share", "landmark RMSE of one loop, falling as 1/sqrt(loops)",
                    "floor of landmark RMSE", "change of mean x error over the last 20 loops",
                    "change of mean y error over the last 20 loops", "change of mean z error over the last 20 loops"],
    "dynamic": ["moving landmarks that are marked", "marked landmarks that move", "landmark RMSE over that where nothing moves",
                "misassociated observations, share", "iteration, mean"],
    "density": ["landmark RMSE aligned, at the end", "misassociated observations, share", "iteration, mean", "iteration, 99th percentile",
                "iteration, worst"],
}


def command_of(name):
    return ["study", name, "--seeds", str(SEEDS), *(["--plugin", "slam_point"] if name == "dynamic" else [])]


def run(hallway, name, folder):
    if (folder / "study.json").exists():
        return
    data = ["--data", ROOT / "../shared/data"] if name == "victoria-park" else []
    command = [hallway, *command_of(name), *data, "--out", folder, "--force", "--quiet"]
    status = subprocess.run(command).returncode
    if status not in (0, 5):
        sys.exit(f"{name}: status {status}")


def number(value):
    if value is None:
        return "–"
    if value == round(value) and abs(value) < 1e6:
        return f"{value:.0f}"
    return f"{value:.2g}" if abs(value) < 1e-3 else f"{value:.3g}" if abs(value) < 100 else f"{value:.0f}"


def shown(row):
    text = number(row["value"])
    if row["low"] is not None:
        text += f" ({number(row['low'])} … {number(row['high'])})"
    return text


def table_of(name, study):
    """A row for each thing that was found, a column for each group; the other way round where there are more groups than things."""
    rows = study["tables"]["findings"] + study["times"].get("times_findings", [])
    groups = list(dict.fromkeys(row["of"] for row in rows))
    things = [(what, unit) for what, unit in dict.fromkeys((row["what"], row["unit"]) for row in rows)
              if name not in KINDS or what in KINDS[name]]
    cells = {(row["of"], row["what"]): shown(row) for row in rows}
    label = lambda thing: thing[0] + ("" if thing[1] == "1" else f", {thing[1]}")
    if len(groups) > len(things):
        things = [thing for thing in things if "exponent" not in thing[0]]
        lines = ["| | " + " | ".join(label(thing) for thing in things) + " |", "|---" * (len(things) + 1) + "|"]
        for group in groups:
            if any((group, what) in cells for what, _ in things):
                lines.append(f"| {group} | " + " | ".join(cells.get((group, what), "–") for what, _ in things) + " |")
        for row in rows:
            if "exponent" in row["what"]:
                lines += ["", f"{row['of']}: {row['what']} {shown(row)}."]
        return lines
    lines = ["| | " + " | ".join(groups) + " |", "|---" * (len(groups) + 1) + "|"]
    for thing in things:
        lines.append(f"| {label(thing)} | " + " | ".join(cells.get((group, thing[0]), "–") for group in groups) + " |")
    return lines


def block(name, folder):
    study = json.loads((folder / "study.json").read_text())
    lines = ["", "    hallway " + " ".join(command_of(name)), "", *table_of(name, study), ""]
    (ROOT / "docs" / "figures").mkdir(exist_ok=True)
    for chart in study["charts"]:
        if chart["file"] not in KEPT.get(name, []):
            continue
        file = f"{name}_{chart['file']}.svg"
        shutil.copyfile(folder / f"{chart['file']}.svg", ROOT / "docs" / "figures" / file)
        lines += [f"![{chart['title']}; figure {chart['figures']} of the thesis](figures/{file})", ""]
    return "\n".join(lines)


def put(page, name, text):
    begin, end = f"<!-- {name} -->", f"<!-- /{name} -->"
    if begin not in page or end not in page:
        sys.exit(f"{PAGE}: {begin} and {end} are not there")
    return page[: page.index(begin) + len(begin)] + "\n" + text + page[page.index(end):]


def main():
    hallway, out = sys.argv[1], pathlib.Path(sys.argv[2])
    names = sys.argv[3:] or STUDIES
    for name in names:
        if name not in STUDIES:
            sys.exit(f"there is no study {name}; there are: {', '.join(STUDIES)}")
        run(hallway, name, out / name)
        PAGE.write_text(put(PAGE.read_text(), name, block(name, out / name)))
        print(f"{name}: in {PAGE}", flush=True)


if __name__ == "__main__":
    main()
