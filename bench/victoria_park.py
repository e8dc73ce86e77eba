#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""victoria_park.py HALLWAY OUT: slam_point on the two Victoria Park intervals, against the GPS fixes.

Trees seen by a laser from a car: planar, no identities, noise not known. Each interval is replayed with the options that the
plugin's README recommends for such data. The GPS fixes, interpolated to the scans, stand in for the true path: the antenna is
not where the laser is and the fixes jump, so the agreement says how good the fixes are as much as the path. Writes the runs and
a picture of each into OUT, and a table to standard output. The data is looked for in HALLWAY_DATA (docs/data.md)."""
import csv
import json
import os
import pathlib
import subprocess
import sys

import numpy as np

OPTIONS = ["noise_m=0.25", "overlap=0.3", "separation_m=2.5"]
LARGEST_GAP_S = 1.0  # between two fixes that are interpolated
FASTEST_M_S = 12.0  # a faster step between two fixes is a jump
THESIS_MS = "0.30-0.57"


def read_table(path):
    with open(path, newline="") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def fixes_at_scans(folder):
    """[(iteration, east, north)] for the scans between two near fixes that do not jump."""
    fixes = read_table(folder / "gps.csv")
    places = []
    after = 0
    for scan in read_table(folder / "times.csv"):
        while after < len(fixes) and fixes[after]["t_s"] < scan["t_s"]:
            after += 1
        if after == 0 or after == len(fixes):
            continue
        a, b = fixes[after - 1], fixes[after]
        gap = b["t_s"] - a["t_s"]
        step = np.hypot(b["east_m"] - a["east_m"], b["north_m"] - a["north_m"])
        if gap > LARGEST_GAP_S or step > FASTEST_M_S * gap:
            continue
        share = (scan["t_s"] - a["t_s"]) / gap
        places.append((int(scan["iteration"]), a["east_m"] + share * (b["east_m"] - a["east_m"]),
                       a["north_m"] + share * (b["north_m"] - a["north_m"])))
    return places


def rotation(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def residuals(path, headings, fixes, lever_arm):
    """Distances [m] after the best planar rigid fit; with `lever_arm` also of a constant antenna place on the car."""
    centre_a, centre_b = path.mean(axis=0), fixes.mean(axis=0)
    cross = (path - centre_a).T @ (fixes - centre_b)
    angle = np.arctan2(cross[0, 1] - cross[1, 0], cross[0, 0] + cross[1, 1])
    if not lever_arm:
        return np.linalg.norm((path - centre_a) @ rotation(angle).T + centre_b - fixes, axis=1), np.zeros(2)
    arm, shift = np.zeros(2), centre_b - rotation(angle) @ centre_a
    turn = np.stack([np.stack([np.cos(headings), -np.sin(headings)], -1), np.stack([np.sin(headings), np.cos(headings)], -1)], 1)
    for _ in range(30):  # Gauss-Newton over angle, shift and arm
        world = (path + turn @ arm) @ rotation(angle).T
        error = world + shift - fixes
        jacobian = np.zeros((len(path), 2, 5))
        jacobian[:, 0, 0], jacobian[:, 1, 0] = -world[:, 1], world[:, 0]
        jacobian[:, 0, 1] = jacobian[:, 1, 2] = 1.0
        jacobian[:, :, 3:] = rotation(angle) @ turn
        step = np.linalg.lstsq(jacobian.reshape(-1, 5), -error.reshape(-1), rcond=None)[0]
        angle, shift, arm = angle + step[0], shift + step[1:3], arm + step[3:]
    return np.linalg.norm((path + turn @ arm) @ rotation(angle).T + shift - fixes, axis=1), arm


def nearest_pair(landmarks):
    places = np.array([[row["x"], row["y"]] for row in landmarks])
    distances = np.linalg.norm(places[:, None] - places[None], axis=2) + 1e9 * np.eye(len(places))
    return distances.min()


def mapped_landmarks(run):
    with open(run / "landmarks.csv", newline="") as file:
        return [{k: float(row[k]) for k in "xy"} for row in csv.DictReader(file) if row["status"] == "mapped"]


def study(hallway, folder, out):
    places = fixes_at_scans(folder)
    truth = out / f"{folder.name}_gps.csv"
    truth.write_text("iteration,x,y,z\n" + "".join(f"{i},{x},{y},0\n" for i, x, y in places))
    run = out / folder.name
    command = [hallway, "replay", folder / "obs.csv", "--plugin", "slam_point", "--period", "0.214", "--truth-poses", truth,
               "--out", run, "--force", "--quiet"]
    for option in OPTIONS:
        command += ["--set", option]
    subprocess.run(command, check=True)
    subprocess.run([hallway, "render", run, "--view", "top", "--out", out / f"{folder.name}.png"], check=True)
    metrics = json.loads((run / "metrics.json").read_text())
    poses = {round(row[0] / 0.214): row for row in np.loadtxt(run / "trajectory.tum")}
    used = [place for place in places if place[0] in poses]
    path = np.array([poses[i][1:3] for i, _, _ in used])
    headings = np.array([2.0 * np.arctan2(poses[i][6], poses[i][7]) for i, _, _ in used])
    fixes = np.array([[x, y] for _, x, y in used])
    plain, _ = residuals(path, headings, fixes, lever_arm=False)
    fitted, arm = residuals(path, headings, fixes, lever_arm=True)
    rms = lambda values: float(np.sqrt((values**2).mean()))
    landmarks = mapped_landmarks(run)
    length = float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())
    print(f"{folder.name}: {metrics['iterations']} scans, {metrics['lost_iterations']} without a pose, about {length:.0f} m")
    print(f"  trees mapped                 {len(landmarks)}, nearest two {nearest_pair(landmarks):.2f} m apart")
    print(f"  observations of no tree      {metrics['associations_none']} of {metrics['observations']}")
    near = plain <= 3.0 * np.median(plain)
    print(f"  path against GPS             RMSE {rms(plain):.2f} m, median {np.median(plain):.2f} m ({len(used)} scans with a fix)")
    print(f"  without what jumps           RMSE {rms(residuals(path[near], headings[near], fixes[near], False)[0]):.2f} m "
          f"({near.sum()} fixes within 3 medians)")
    print(f"  with the antenna's place fitted  RMSE {rms(fitted):.2f} m, median {np.median(fitted):.2f} m "
          f"(antenna {arm[0]:+.2f} m ahead, {arm[1]:+.2f} m left of the laser)")
    print(f"  iteration                    {metrics['iteration_ms']['mean']:.4f} ms mean, {metrics['iteration_ms']['max']:.3f} worst "
          f"(thesis: {THESIS_MS} ms mean)")
    print(f"  picture                      {out / folder.name}.png")


def main():
    hallway, out = sys.argv[1], pathlib.Path(sys.argv[2])
    root = pathlib.Path(__file__).resolve().parent.parent
    data = pathlib.Path(os.environ.get("HALLWAY_DATA") or root / "../shared/data") / "landmark_logs_real"
    if not data.exists():
        print(f"victoria_park: skipped, no data at {data} (docs/data.md)")
        return
    out.mkdir(parents=True, exist_ok=True)
    for folder in sorted(path for path in data.iterdir() if path.is_dir()):
        study(hallway, folder, out)


if __name__ == "__main__":
    main()
