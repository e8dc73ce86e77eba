#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""accuracy.py HALLWAY OUT: the tables of docs/accuracy.md.

Runs figure_eight and office with several seeds and replays the recorded logs of HALLWAY_DATA (docs/data.md) with slam_point's
defaults, and prints tables in Markdown. ML is what the batch maximum likelihood reaches on the same log: least squares
over all poses and landmarks, given the true association, as the README of the logs states it."""
import json
import os
import pathlib
import subprocess
import sys

SEEDS = (1, 2, 3)
LOGS = (  # folder, steps (0: all), ML landmark RMSE [m], ML path error (ATE) [m]
    ("figure8_d25", 3800, 0.01175, 0.0380),
    ("figure8_d25", 0, 0.00618, 0.0364),
    ("figure8_d100", 0, 0.00603, 0.0179),
    ("figure8_d100_r40", 0, 0.04418, 0.0557),
    ("figure8_3d_d25", 0, 0.00856, 0.0377),
    ("line_d25", 0, 0.01033, 0.0364),
    ("line_d100", 0, 0.01132, 0.0174),
    ("stationary_d25", 0, 0.00262, 0.0395),
    ("stationary_d100", 0, 0.00293, 0.0172),
)


def metrics_of(hallway, out, arguments):
    command = [hallway, *arguments, "--out", out / "run", "--force", "--json", "--quiet"]
    return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)["metrics"]


def common(m):
    return (f"{m['lost_iterations']} | {m['landmarks_mapped']} of {m['landmarks_true']} | {m['landmarks_duplicated']} | "
            f"{m['association_errors']} of {m['observations']}")


def path(m):
    return f"{m['position_rmse_m']['aligned']:.4f} | {m['position_rmse_m']['refitted_aligned']:.4f}"


def nees(m):
    return ", ".join("" if m["nees"][of] is None else f"{m['nees'][of]:.2f}" for of in ("landmarks", "poses"))


def times(m):
    cpu = m["iteration_cpu_ms"]
    return f"{1000 * cpu['mean']:.0f} | {1000 * cpu['p50']:.0f} | {1000 * cpu['p99']:.0f} | {cpu['max']:.1f}"


def simulated(hallway, root, out):
    print("| run | seed | lost | landmarks | duplicated | misassociated | landmarks online m | at the end m "
          "| path (ATE) online m | re-fitted m | NEES landmarks, poses "
          "| mean µs | median µs | p99 µs | worst ms |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|")
    for scenario in ("figure_eight", "office"):
        for seed in SEEDS:
            m = metrics_of(hallway, out, ["run", root / "maps" / f"{scenario}.toml", "--seed", str(seed)])
            rmse = m["landmark_rmse_m"]
            print(f"| {scenario} | {seed} | {common(m)} | {rmse['aligned']:.4f} | {rmse['final_aligned']:.4f} | "
                  f"{path(m)} | {nees(m)} | {times(m)} |", flush=True)


def recorded(hallway, data, out):
    print("| log | iterations | lost | landmarks | duplicated | misassociated | ML m | online m | at the end m | at the end / ML "
          "| path (ATE): ML m | online m | re-fitted m | re-fitted / ML | NEES landmarks, poses | mean µs | median µs | p99 µs | worst ms |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|")
    for folder, steps, ml, ml_path in LOGS:
        log = data / folder
        arguments = ["replay", log / "obs.csv", "--plugin", "slam_point", "--truth-poses", log / "gt_poses.csv",
                     "--truth-landmarks", log / "gt_landmarks.csv"]
        m = metrics_of(hallway, out, arguments + (["--steps", str(steps)] if steps else []))
        rmse = m["landmark_rmse_m"]
        print(f"| {folder} | {m['iterations']} | {common(m)} | {ml:.5f} | {rmse['aligned']:.4f} | {rmse['final_aligned']:.4f} | "
              f"{rmse['final_aligned'] / ml:.2f} | {ml_path:.4f} | {path(m)} | "
              f"{m['position_rmse_m']['refitted_aligned'] / ml_path:.2f} | {nees(m)} | {times(m)} |", flush=True)


def main():
    hallway, out = sys.argv[1], pathlib.Path(sys.argv[2])
    root = pathlib.Path(__file__).resolve().parent.parent
    out.mkdir(parents=True, exist_ok=True)
    simulated(hallway, root, out)
    print()
    data = pathlib.Path(os.environ.get("HALLWAY_DATA") or root / "../shared/data") / "landmark_logs"
    if not data.exists():
        print(f"recorded logs: skipped, no data at {data} (docs/data.md)")
        return
    recorded(hallway, data, out)


if __name__ == "__main__":
    main()
