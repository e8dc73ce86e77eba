#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""real_data.py HALLWAY OUT: slam_point on the recordings of HALLWAY_DATA/landmarks (docs/data.md), as tables in Markdown (docs/real-data.md).

KITTI stereo points: the path against the reference as it stands, and against the reference without its motion in the frames whose points are copies of
those of the frame before. How much a faultless path would differ from the reference is estimated by simulation: the steps of the estimated path are
taken for true, and given as much noise as the steps of the reference have beyond those of the estimate.
MRPT's demo: landmarks and path against the truth."""
import csv
import json
import os
import pathlib
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
BY_RANGE = {"noise_m": 0.02, "noise_per_m2": 0.001}
STEREO = {**BY_RANGE, "noise_across_per_m": 0.00055}
KITTI_WAYS = (
    ("tracks", {**STEREO, "association": "sensor"}),
    ("tracks, weights by range alone", {**BY_RANGE, "association": "sensor"}),
    ("tracks, equal weights", {"noise_m": 0.1, "association": "sensor"}),
    ("place", {**STEREO, "match_bound_m": 1, "map_bound_m": 1}),
)
DEMO_WAYS = (
    ("ids as tracks", ["--ids-as-tracks"], {"noise_m": 0.011, "association": "sensor"}),
    ("ids as tracks, bearings", ["--ids-as-tracks"], {"noise_m": 0.011, "noise_across_per_m": 0.0025, "association": "sensor"}),
    ("place", [], {"noise_m": 0.011, "match_bound_m": 0.5, "map_bound_m": 0.5}),
)
TRIALS = 200


def replay(hallway, log, out, options, arguments=()):
    settings = [word for name, value in options.items() for word in ("--set", f"{name}={value}")]
    command = [hallway, "replay", log, "--plugin", "slam_point", *settings, *arguments, "--in-process", "--out", out, "--force", "--json", "--quiet"]
    return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)["metrics"]


def rotation(q):
    x, y, z, w = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def exponential(v):
    angle = np.linalg.norm(v)
    k = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    if angle < 1e-12:
        return np.eye(3) + k
    return np.eye(3) + np.sin(angle) / angle * k + (1 - np.cos(angle)) / angle**2 * k @ k


def logarithm(r):
    v = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]) / 2
    sine = np.linalg.norm(v)
    return v if sine < 1e-12 else v * np.arctan2(sine, (np.trace(r) - 1) / 2) / sine


def read_poses(path):
    """By time: (rotation, position)."""
    with open(path) as file:
        rows = [line.split() for line in file if not line.startswith("#")]
    return {row[0]: (rotation([float(v) for v in row[4:8]]), np.array([float(v) for v in row[1:4]])) for row in rows}


def step(a, b):
    return a[0].T @ b[0], a[0].T @ (b[1] - a[1])


def chain(steps):
    poses = [(np.eye(3), np.zeros(3))]
    for r, t in steps:
        poses.append((poses[-1][0] @ r, poses[-1][1] + poses[-1][0] @ t))
    return poses


def ate(truth, estimate):
    truth, estimate = (np.array([pose[1] for pose in poses]) for poses in (truth, estimate))
    a, b = truth - truth.mean(0), estimate - estimate.mean(0)
    u, _, v = np.linalg.svd(a.T @ b)
    r = u @ np.diag([1, 1, np.linalg.det(u @ v)]) @ v
    return np.sqrt(((a - b @ r.T) ** 2).sum(1).mean())


def length(poses):
    return sum(np.linalg.norm(b[1] - a[1]) for a, b in zip(poses, poses[1:]))


def copied_frames(table):
    """Frames whose points all stand where the same tracks stood in the frame before."""
    frames = {}
    with open(table) as file:
        for row in csv.DictReader(file):
            frames.setdefault(int(row["frame"]), {})[row["id"]] = (row["x_right_m"], row["y_down_m"], row["z_fwd_m"])
    copies = set()
    for i, points in frames.items():
        shared = points.keys() & frames.get(i - 1, {}).keys()
        if shared and all(points[k] == frames[i - 1][k] for k in shared):
            copies.add(i)
    return copies


def faultless(steps, reference_steps):
    """ATE that a faultless path would have against a reference of this noise: 5 %, 50 %, 95 %; and the noise, degrees and metres a step."""
    turn = np.array([logarithm(a[0].T @ b[0]) for a, b in zip(steps, reference_steps)])
    travel = np.array([b[1] - a[1] for a, b in zip(steps, reference_steps)])
    sigma_turn, sigma_travel = (1.4826 * np.median(np.abs(d - np.median(d, 0)), 0) for d in (turn, travel))
    random = np.random.default_rng(1)
    true = chain(steps)
    errors = []
    for _ in range(TRIALS):
        noisy = [(r @ exponential(sigma_turn * random.standard_normal(3)), t + sigma_travel * random.standard_normal(3)) for r, t in steps]
        errors.append(ate(chain(noisy), true))
    return np.percentile(errors, [5, 50, 95]), np.degrees(sigma_turn), sigma_travel


def kitti(hallway, data, out):
    table = data / "kitti_0022_obs3d.csv"
    copies = copied_frames(table)
    print(f"KITTI stereo points: {len(copies)} frames are copies of the one before\n")
    print("| association | lost | ATE m | of the path | ATE m, reference without motion in copies | of the path | mean µs |")
    print("|---|---|---|---|---|---|---|")
    told = None
    for name, options in KITTI_WAYS:
        metrics = replay(hallway, table, out / "kitti", options)
        truth, estimate = (read_poses(out / "kitti" / f"{kind}.tum") for kind in ("truth", "trajectory"))
        times = list(truth)
        reference = [truth[t] for t in times]
        steps = [step(a, b) for a, b in zip(reference, reference[1:])]
        still = chain([(np.eye(3), np.zeros(3)) if i in copies else s for i, s in enumerate(steps, 1)])
        placed = [i for i, t in enumerate(times) if t in estimate]
        found = [estimate[times[i]] for i in placed]
        as_is, without = ate([reference[i] for i in placed], found), ate([still[i] for i in placed], found)
        print(f"| {name} | {metrics['lost_iterations']} | {as_is:.1f} | {100 * as_is / length(reference):.2f} % | {without:.1f} | "
              f"{100 * without / length(still):.2f} % | {1000 * metrics['iteration_cpu_ms']['mean']:.0f} |", flush=True)
        if told is None and len(placed) == len(times):
            moving = [i for i in range(len(steps)) if i + 1 not in copies]
            own = [step(a, b) for a, b in zip(found, found[1:])]
            told = faultless([own[i] for i in moving], [steps[i] for i in moving])
    percentiles, turn, travel = told
    print(f"\nNoise of a step of the reference: {turn.round(2)}° about and {travel.round(3)} m along the axes of the body. A faultless path would have an ATE of "
          f"{percentiles[1]:.1f} m against a reference of such noise (5 to 95 %: {percentiles[0]:.1f} to {percentiles[2]:.1f} m).\n")


def demo(hallway, data, out):
    print("MRPT's kf-slam_6D_demo\n")
    print("| association | without a pose | landmarks mapped | misassociated | landmarks m | at the end m | path (ATE) m | mean µs |")
    print("|---|---|---|---|---|---|---|---|")
    for name, arguments, options in DEMO_WAYS:
        m = replay(hallway, data / "kf-slam_6D_demo_obs.csv", out / "demo", options, arguments)
        rmse = m["landmark_rmse_m"]
        print(f"| {name} | {m['lost_iterations']} of {m['iterations']} | {m['landmarks_mapped']} of {m['landmarks_true']} | {m['association_errors']} | "
              f"{rmse['aligned']:.4f} | {rmse['final_aligned']:.4f} | {m['position_rmse_m']['aligned']:.4f} | {1000 * m['iteration_cpu_ms']['mean']:.0f} |", flush=True)


def main():
    hallway, out = sys.argv[1], pathlib.Path(sys.argv[2])
    data = pathlib.Path(os.environ.get("HALLWAY_DATA") or ROOT / "../shared/data") / "landmarks"
    if not data.exists():
        print(f"real_data: skipped, no data at {data} (docs/data.md)")
        return
    out.mkdir(parents=True, exist_ok=True)
    kitti(hallway, data, out)
    demo(hallway, data, out)


if __name__ == "__main__":
    main()
