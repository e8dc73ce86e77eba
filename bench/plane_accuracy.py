#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""plane_accuracy.py HALLWAY PLANE_ML OUT [--seeds N] [--modes relative,thesis] [--drift N] [SCENARIO...]: the tables of docs/accuracy.md for maps of planes.

Runs each scenario of planes with N seeds (20), with noise and without, with occlusion and without, in each mode that slam_plane has, and
prints a table in Markdown: errors pooled over the seeds, beside those of plane_ml (least squares over all poses and walls of the same run, given
which wall each piece is of and which ends are corners; noise-free runs have none). Corners are certain corners of the map at the end, after the rigid
motion that fits them best. Positions re-fitted are those of all frames where the map at the end puts them; positions online are those that were answered
while the run went on, in the frames that plane_ml scores (of runs without noise, in all), beside what plane_ml makes of nothing but what had been seen until then,
of every twelfth part of the first runs (--so-far). A run is whole where every wall that
is asked for is mapped and none twice. OUT keeps the figures of each run, by which a run that was made is not made again."""
import argparse
import csv
import json
import math
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENARIOS = ("four_planes", "hallway", "hallway_return", "key_points", "loop_corridor", "motion_model", "bad_pairs", "roll_back",
             "pseudo_merge", "many_planes")
NOISE = {"noise_m": 0.02, "noise_angle_deg": 0.3, "noise_end_m": 0.005}


def output_of(command):
    return json.loads(subprocess.run([str(part) for part in command], check=True, capture_output=True).stdout)


def modes_of(hallway):
    """The modes that the plugin has; None for one that it does not let choose."""
    for parameter in output_of([hallway, "plugin", "info", "slam_plane", "--json"])["parameters"]:
        if parameter["name"] == "mode":
            return ["relative", "thesis"]
    return [None]


def figures_of(arguments, scenario, mode, noise, occlusion, seed):
    """What is kept of one run."""
    name = f"{scenario}-{mode or 'relative'}-{'noise' if noise else 'clean'}-{'occluded' if occlusion else 'open'}-{seed}"
    kept = arguments.out / f"{name}.json"
    if kept.exists():
        return json.loads(kept.read_text())
    settings = {f"sensor.eyes.{key}": value if noise else 0 for key, value in NOISE.items()}
    settings["sensor.eyes.occlusion"] = str(occlusion).lower()
    if mode:
        settings["slam_plane.mode"] = mode
    folder = arguments.out / "run"
    command = [arguments.hallway, "run", ROOT / "maps" / f"{scenario}.toml", "--seed", seed, "--out", folder, "--force", "--json", "--quiet"]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    figures = output_of(command)["metrics"]
    figures = {key: figures[key] for key in ("iterations", "lost_iterations", "planes", "iteration_cpu_ms")}
    if noise:
        so_far = [max(1, figures["iterations"] // 12)] if seed <= arguments.so_far else []
        figures["ml"] = output_of([arguments.plane_ml, folder, *so_far])
    kept.write_text(json.dumps(figures))
    return figures


def pooled(pairs):
    """Root mean square of (count, rms) pairs."""
    total = sum(count for count, _ in pairs)
    return math.sqrt(sum(count * rms * rms for count, rms in pairs) / total) if total else None


def pair_of(errors):
    return (errors["count"], errors["rms"]) if errors else (0, 0.0)


def is_whole(planes):
    final = planes["final"] or planes["online"]
    return final["walls_missing"] == 0 and final["duplicated"] == 0


def metres(value):
    return "–" if value is None else f"{value:.4f}"


def ratio(value, best):
    return "–" if value is None or not best else f"{value / best:.2f}"


def pooled_ml(runs, part, count, rmse):
    """Of the runs that have it."""
    found = [run["ml"] if part is None else run["ml"][part] for run in runs if part is None or part in run["ml"]]
    return pooled([(one[count], one[rmse]) for one in found])


def row(scenario, mode, noise, occlusion, runs):
    corners = pooled([pair_of((run["planes"]["final"] or run["planes"]["online"])["corner_m"]) for run in runs])
    refitted = pooled([pair_of(run["planes"]["position_refitted_m"]) for run in runs])
    online = pooled([pair_of(run["planes"]["position_m"]) for run in runs])
    ml_corners = ml_positions = so_far = None
    if noise:
        ml_corners = pooled_ml(runs, None, "corners", "corner_rmse_m")
        ml_positions = pooled_ml(runs, None, "positions", "position_rmse_m")
        online = pooled_ml(runs, "answered", "positions", "position_rmse_m")
        so_far = pooled_ml(runs, "so_far", "positions", "position_rmse_m")
    cells = [scenario, mode or "relative", "yes" if noise else "no", "yes" if occlusion else "no", f"{sum(is_whole(run['planes']) for run in runs)} of {len(runs)}",
             f"{sum(run['lost_iterations'] for run in runs)}", f"{sum(run['planes']['association_errors'] for run in runs)}",
             metres(corners), metres(ml_corners), ratio(corners, ml_corners), metres(refitted), metres(ml_positions), ratio(refitted, ml_positions),
             metres(online), ratio(online, ml_positions), metres(so_far),
             f"{1000 * sum(run['iteration_cpu_ms']['mean'] for run in runs) / len(runs):.0f}",
             f"{max(run['iteration_cpu_ms']['max'] for run in runs):.2f}"]
    return "| " + " | ".join(cells) + " |"


def change_of(errors, blocks=20):
    """By how much errors change from the first iteration to the last, and half of the 95 % interval about that: the least-squares line through the means of
    blocks, which are long enough to be independent."""
    size = len(errors) // blocks
    means = [sum(errors[k * size:(k + 1) * size]) / size for k in range(blocks)]
    middle, mean = (blocks - 1) / 2, sum(means) / blocks
    spread = sum((k - middle) ** 2 for k in range(blocks))
    slope = sum((k - middle) * (value - mean) for k, value in enumerate(means)) / spread
    rest = sum((value - mean - slope * (k - middle)) ** 2 for k, value in enumerate(means)) / (blocks - 2)
    return blocks * slope, blocks * 2.101 * math.sqrt(rest / spread)  # Student's t for 18 degrees of freedom


def drift(arguments, mode):
    """A row on how the position's error changes over a long run of four_planes with noise."""
    folder = arguments.out / "run"
    command = [arguments.hallway, "run", ROOT / "maps" / "four_planes.toml", "--steps", arguments.drift, "--out", folder, "--force", "--json", "--quiet", "--in-process"]
    for key, value in NOISE.items():
        command += ["--set", f"sensor.eyes.{key}={value}"]
    if mode:
        command += ["--set", f"slam_plane.mode={mode}"]
    output_of(command)
    with open(folder / "pose_errors.csv", encoding="utf-8") as file:
        errors = [float(row["position_m"]) for row in csv.DictReader(file)]
    change, half = change_of(errors)
    within = abs(change) + half <= 0.002
    return (f"| {mode or 'relative'} | {arguments.drift} | {1000 * sum(errors) / len(errors):.2f} | {1000 * change:.2f} "
            f"| {1000 * (change - half):.2f} to {1000 * (change + half):.2f} | {'yes' if within else 'no'} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("hallway", type=pathlib.Path)
    parser.add_argument("plane_ml", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("scenarios", nargs="*", default=SCENARIOS)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--drift", type=int, metavar="N", help="instead: how the error changes over N iterations of four_planes, in each mode")
    parser.add_argument("--so-far", type=int, default=5, help="seeds of which plane_ml solves for what was known at the time [5]")
    parser.add_argument("--modes", help="of those that the plugin has [all]")
    arguments = parser.parse_intermixed_args()
    arguments.hallway, arguments.plane_ml = arguments.hallway.resolve(), arguments.plane_ml.resolve()
    arguments.out.mkdir(parents=True, exist_ok=True)
    modes = [mode for mode in modes_of(arguments.hallway) if not arguments.modes or mode in arguments.modes.split(",")]
    if arguments.drift:
        print("| mode | iterations | mean position error mm | change mm | 95 % interval | within 2 mm |\n" + "|" + "---|" * 6)
        for mode in modes:
            print(drift(arguments, mode), flush=True)
        return
    print("| scenario | mode | noise | occlusion | whole | lost | misassociated | corners m | ML m | corners / ML | positions re-fitted m | ML m "
          "| re-fitted / ML | online m | online / ML | ML so far m | mean µs | worst ms |")
    print("|" + "---|" * 18)
    for scenario in arguments.scenarios:
        for noise in (False, True):
            for occlusion in (False, True):
                for mode in modes:
                    seeds = range(1, (arguments.seeds if noise else 1) + 1)
                    runs = [figures_of(arguments, scenario, mode, noise, occlusion, seed) for seed in seeds]
                    print(row(scenario, mode, noise, occlusion, runs), flush=True)


if __name__ == "__main__":
    main()
