#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""lidar_odometry.py HALLWAY OUT [--seeds 1-5] [--steps 2020] [--cases NAME;...]: plugin icp on scans along paths of the project's maps, as a table in Markdown.

drift: error of the motion over each stretch of 50 m (of a shorter way, half of it) in % of it, mean; end: of the whole way. wrong: frames whose motion errs by more than 5 of its own standard
deviations (Mahalanobis, six dimensions), of those with a pose. The motion's covariance is what the covariances of two poses that follow each other differ by."""
import argparse
import csv
import json
import pathlib
import shutil
import subprocess

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENARIO = """schema = "hallway.scenario/1"
map = "{map}"
seed = 1
steps = {steps}
period_s = {period}
[robot]
path = "{path}"
loop_steps = {loop}
radius_m = 0.3
bottom_m = -0.7
top_m = 0.2
[sensor.lidar]
kind = "lidar"
preset = "{preset}"
position_m = [0.1, 0, 0.25]
{more}
{rig}[[plugin]]
name = "icp"
"""
ODOMETRY = """[sensor.odometry]
kind = "odometry"
rate_hz = 50
radius_error_sigma = 0.005
slip = 0.002
"""
IMU = """[sensor.imu]
kind = "imu"
preset = "imu_mems"
"""

def case(deskew="auto", speed=1.0, preset="lidar16", more="", rig=IMU + ODOMETRY, map="office", path="round", loop_m=100.0):
    return {"deskew": deskew, "speed": speed, "preset": preset, "more": more, "rig": rig, "map": map, "path": path, "loop_m": loop_m}


CASES = {
    "auto": case(),
    "none": case("none"),
    "odometry": case("odometry", rig=ODOMETRY),
    "imu": case("imu", rig=IMU),
    "motion": case("motion", rig=""),
    "0.5 m/s": case(speed=0.5),
    "2 m/s": case(speed=2.0),
    "3 m/s": case(speed=3.0),
    "motion, 0.5 m/s": case("motion", speed=0.5, rig=""),
    "unskewed": case(more="skew = false"),
    "unskewed, motion": case("motion", rig="", more="skew = false"),
    "noise x 0": case(more="noise_m = 0"),
    "noise x 2": case(more="noise_m = 0.04"),
    "noise x 5": case(more="noise_m = 0.1"),
    "drop-outs 30 %": case(more="dropout = 0.3"),
    "range 8 m": case(more="max_range_m = 8"),
    "64 rings": case(preset="lidar64"),
    "8 rings": case(more="rings = 8"),
    "3 rings": case(more="rings = 3"),
    "one ring": case(more="rings = 1\nlowest_deg = 0\nhighest_deg = 0"),
    "loop_corridor": case(map="loop_corridor", loop_m=40.0),
    "loop_corridor, motion": case("motion", rig="", map="loop_corridor", loop_m=40.0),
    "spatial_rooms": case(map="spatial_rooms", path="there_and_back", loop_m=40.0),
    "hallway": case(map="hallway", path="there_and_back", loop_m=40.0),
}


def rotation(q):
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def logarithm(r):
    v = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]) / 2
    sine = np.linalg.norm(v)
    return v if sine < 1e-12 else v * np.arctan2(sine, (np.trace(r) - 1) / 2) / sine


def cross(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def table(path):
    with open(path) as file:
        return list(csv.DictReader(file))


def relative(a, b):
    return a[0].T @ b[0], a[0].T @ (b[1] - a[1])


def figures(out, period):
    truth = {int(row["iteration"]): (rotation([float(row[k]) for k in ("qw", "qx", "qy", "qz")]), np.array([float(row[k]) for k in "xyz"]))
             for row in table(out / "truth_poses.csv")}
    estimate, covariance = {}, {}
    with open(out / "trajectory.tum") as file:
        for line in file:
            if line.startswith("#"):
                continue
            v = [float(word) for word in line.split()]
            estimate[round(v[0] / period)] = (rotation([v[7], *v[4:7]]), np.array(v[1:4]))
    for row in table(out / "pose_covariances.csv") if estimate else ():
        upper = np.zeros((6, 6))
        upper[np.triu_indices(6)] = [float(v) for k, v in row.items() if k != "iteration"]
        covariance[int(row["iteration"])] = upper + np.triu(upper, 1).T
    frames = sorted(estimate)
    times = [float(row["cpu_ms"]) for row in table(out / "timing.csv")]
    if len(frames) < 10:
        return dict.fromkeys(("way", "drift", "end", "median", "wrong"), np.nan) | {"lost": len(truth) - 1 - len(frames), "ms": np.mean(times)}
    way = np.concatenate([[0], np.cumsum([np.linalg.norm(truth[b][1] - truth[a][1]) for a, b in zip(frames, frames[1:])])])
    sigmas = []
    for a, b in zip(frames, frames[1:]):
        if b != a + 1:
            continue
        (true_r, true_t), (r, t) = relative(truth[a], truth[b]), relative(estimate[a], estimate[b])
        carry, turn = np.eye(6), np.zeros((6, 6))
        carry[:3, 3:] = -cross(estimate[b][1] - estimate[a][1])
        turn[:3, :3] = turn[3:, 3:] = estimate[a][0].T
        own = turn @ (covariance[b] - carry @ covariance[a] @ carry.T) @ turn.T
        error = np.concatenate([true_t - t, logarithm(true_r @ r.T)])
        sigmas.append(np.sqrt(max(0.0, error @ np.linalg.pinv(own, hermitian=True) @ error)))
    stretch, drifts = min(50.0, way[-1] / 2), []
    for i in range(0, len(frames), 5):
        j = np.searchsorted(way, way[i] + stretch)
        if j >= len(frames):
            break
        (true_r, true_t), (r, t) = (relative(poses[frames[i]], poses[frames[j]]) for poses in (truth, estimate))
        drifts.append(100 * np.linalg.norm(r.T @ t - true_r.T @ true_t) / stretch)
    true_t, t = (relative(poses[frames[0]], poses[frames[-1]])[1] for poses in (truth, estimate))
    return {"way": way[-1], "drift": np.mean(drifts), "end": 100 * np.linalg.norm(true_t - t) / way[-1], "lost": len(truth) - 1 - len(frames),
            "median": np.median(sigmas), "wrong": 100 * np.mean(np.array(sigmas) > 5), "ms": np.mean(times)}


def run(hallway, folder, name, seed, steps):
    what = CASES[name]
    loop = round(what["loop_m"] / (0.1 * what["speed"]))
    folder.mkdir(parents=True, exist_ok=True)
    scenario = folder / "scenario.toml"
    scenario.write_text(SCENARIO.format(map=ROOT / f"maps/{what['map']}.map", path=what["path"], steps=max(2, round(steps / what["speed"])), loop=loop, period=0.1, **{k: what[k] for k in ("preset", "more", "rig")}))
    out = folder / "run"
    ended = subprocess.run([hallway, "run", scenario, "--seed", str(seed), "--set", f"icp.deskew={what['deskew']}", "--in-process", "--threads", "1", "--out", out, "--force", "--quiet"], capture_output=True, text=True)
    if ended.returncode != 0:
        raise SystemExit(f"{name}: {ended.stderr}")
    result = figures(out, 0.1)
    shutil.rmtree(folder)
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("hallway")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--seeds", default="1-5", help="FROM-TO")
    parser.add_argument("--steps", type=int, default=2020, help="frames of 0.1 s at 1 m/s; other speeds go as far")
    parser.add_argument("--cases", default=";".join(CASES), help="names, between semicolons")
    given = parser.parse_args()
    first, last = (int(word) for word in given.seeds.split("-"))
    print("| case | seed | way m | drift % | end % | without a pose | median sigmas | wrong % | ms a scan |\n|---|---|---|---|---|---|---|---|---|", flush=True)
    found = []
    for name in given.cases.split(";"):
        for seed in range(first, last + 1):
            f = run(given.hallway, given.out / "work", name, seed, given.steps)
            found.append({"case": name, "seed": seed, **f})
            print(f"| {name} | {seed} | {f['way']:.0f} | {f['drift']:.3f} | {f['end']:.3f} | {f['lost']} | {f['median']:.2f} | {f['wrong']:.2f} | {f['ms']:.0f} |", flush=True)
    (given.out / "lidar_odometry.json").write_text(json.dumps(found, indent=1, default=float))


if __name__ == "__main__":
    main()
