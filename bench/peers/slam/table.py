#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""table.py BUILD OUT [LOG[:STEPS]...]: slam_point beside its peers, on the same logs, as tables in Markdown.

Each log of HALLWAY_DATA/landmark_logs (docs/data.md), or run folder given by its path, is replayed by slam_point, by slam_point with mode=thesis (where it
has that), and by MRPT's EKF, which is told which landmark each point is; all in process, one after the other. batch_ml solves the whole log at once, given
which landmark each point is: the best that the log allows. Times are CPU times of the calling thread. "Full map" is the mean of the last tenth of the
iterations. BUILD is configured with -DHALLWAY_PEERS=ON or =slam. Raw figures go to OUT/results.json.

With --without-ekf the EKF is left out: its time grows with the square of the map."""
import argparse
import csv
import json
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[3]
DEFAULT_LOGS = ("figure8_d25:3800",)
TRUTHS = (("truth_poses.csv", "truth_landmarks.csv"), ("gt_poses.csv", "gt_landmarks.csv"))


def folder_of(name):
    data = pathlib.Path(os.environ.get("HALLWAY_DATA") or ROOT / "../shared/data") / "landmark_logs"
    return pathlib.Path(name) if (pathlib.Path(name) / "observations.csv").exists() else data / name


def observations_of(folder):
    return next(path for path in (folder / "observations.csv", folder / "obs.csv") if path.exists())


def truth_of(folder):
    for poses, landmarks in TRUTHS:
        if (folder / poses).exists():
            return ["--truth-poses", folder / poses, "--truth-landmarks", folder / landmarks]
    raise SystemExit(f"table.py: no truth beside {folder}")


def output_of(command):
    return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)


def full_map_ms(folder):
    with open(folder / "timing.csv") as file:
        cpu = [float(row["cpu_ms"]) for row in csv.DictReader(file) if row["cpu_ms"]]
    last = cpu[-max(1, len(cpu) // 10):]
    return sum(last) / len(last)


def replay(build, out, folder, steps, plugin, arguments):
    command = [build / "bin/hallway", "replay", observations_of(folder), "--plugin", plugin, *arguments, *truth_of(folder), "--in-process",
               "--out", out / "run", "--force", "--json", "--quiet", *(["--steps", str(steps)] if steps else [])]
    metrics = output_of(command)["metrics"]
    return {"metrics": metrics, "full_map_ms": full_map_ms(out / "run")}


def contenders(build, with_ekf):
    names = {parameter["name"] for parameter in output_of([build / "bin/hallway", "plugin", "info", "slam_point", "--json"])["parameters"]}
    yield "slam_point", "slam_point", []
    if "mode" in names:
        yield "slam_point, mode = thesis", "slam_point", ["--set", "mode=thesis"]
    if with_ekf:
        yield "MRPT EKF, told", "peer_mrpt_ekf", ["--ids-as-tracks"]


def metres(value):
    return "" if value is None else f"{value:.4f}"


def row(name, result, ml, reference_ms):
    m = result["metrics"]
    landmarks, cpu = m["landmark_rmse_m"], m["iteration_cpu_ms"]
    cells = [name, f"{m['lost_iterations']}", f"{m['association_errors']}", metres(landmarks["aligned"]), metres(landmarks["final_aligned"]),
             f"{landmarks['final_aligned'] / ml['landmark_rmse_m']['aligned']:.2f}", metres(m["position_rmse_m"]["aligned"]),
             f"{1000 * cpu['mean']:.0f}", f"{1000 * result['full_map_ms']:.0f}", f"{cpu['max']:.1f}", f"{result['full_map_ms'] / reference_ms:.2g}" if result['full_map_ms'] < 10 * reference_ms else f"{result['full_map_ms'] / reference_ms:.0f}"]
    return "| " + " | ".join(cells) + " |"


def compare(build, out, folder, steps, with_ekf):
    ml = output_of([build / "bin/batch_ml", folder, *(["--steps", str(steps)] if steps else [])])
    print(f"\n**{folder.name}**, {ml['iterations']} iterations, {ml['landmarks']} landmarks, {ml['observations']} observations\n")
    print("| | lost | misassociated | landmarks online m | at the end m | at the end / ML | path (ATE) m | mean µs | full map µs | worst ms | times slam_point |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    print(f"| batch ML, told | | | | {metres(ml['landmark_rmse_m']['aligned'])} | 1 | {metres(ml['position_rmse_m']['aligned'])} | | | "
          f"{1000 * ml['seconds']:.0f} in all | |", flush=True)
    results = {"batch_ml": ml}
    reference_ms = None
    for name, plugin, arguments in contenders(build, with_ekf):
        results[name] = replay(build, out, folder, steps, plugin, arguments)
        reference_ms = reference_ms or results[name]["full_map_ms"]
        print(row(name, results[name], ml, reference_ms), flush=True)
    return results


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("logs", nargs="*", default=DEFAULT_LOGS)
    parser.add_argument("--without-ekf", action="store_true")
    arguments = parser.parse_intermixed_args()
    build = arguments.build.resolve()
    arguments.out.mkdir(parents=True, exist_ok=True)
    results = {}
    for log in arguments.logs:
        name, _, steps = log.partition(":")
        results[log] = compare(build, arguments.out, folder_of(name), int(steps or 0), not arguments.without_ekf)
    (arguments.out / "results.json").write_text(json.dumps(results, indent=2) + "\n")


if __name__ == "__main__":
    main()
