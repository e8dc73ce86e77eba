# SPDX-License-Identifier: MIT
"""read_layouts.py LAYOUT FOLDER TRUTH: reads a folder with numpy, from the definition of the layout alone, and compares it with what was written.

TRUTH has lines WORD TIME_NS NUMBERS: `mount` (rows of 3x4), `noise`, `pose` (rows of T_world_lidar or T_world_body), `motion`, `imu`, `point` (x, y, z, intensity, ring, time).
The status is 1 where they differ: points beyond float32, poses beyond 1e-9, other numbers at all.
"""
import collections
import pathlib
import re
import sys
from decimal import Decimal

import numpy as np


def differ(message):
    print(f"read_layouts: {message}", file=sys.stderr)
    sys.exit(1)


def same(what, found, wanted, tolerance=0.0):
    found, wanted = np.asarray(found), np.asarray(wanted)
    if found.shape != wanted.shape:
        differ(f"{what}: shape {found.shape}, wanted {wanted.shape}")
    if found.size and not np.all(np.abs(found.astype(np.longdouble) - wanted.astype(np.longdouble)) <= tolerance):
        differ(f"{what}: off by {np.max(np.abs(found - wanted))}")


def matrix(rows):
    return np.vstack([np.reshape(rows, (3, 4)), [0, 0, 0, 1]])


def rotation(w, x, y, z):
    """Of a quaternion, as q v q* of the axes."""
    v = np.array([x, y, z])
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return (w * w - v @ v) * np.eye(3) + 2 * np.outer(v, v) + 2 * w * cross


def pose(position, wxyz):
    return matrix(np.column_stack([rotation(*wxyz), position]))


def nanoseconds(seconds):
    return int(Decimal(seconds) * 10**9)


def read_truth(file):
    truth = collections.defaultdict(list)
    for line in pathlib.Path(file).read_text().splitlines():
        word, t_ns, *numbers = line.split()
        truth[word].append((int(t_ns), [float(n) for n in numbers]))
    return truth


def times_of(rows):
    return np.array([t for t, _ in rows], dtype=np.int64)


def numbers_of(rows):
    return np.array([n for _, n in rows])


def clouds_of(truth):
    clouds = collections.defaultdict(list)
    for t_ns, numbers in truth["point"]:
        clouds[t_ns].append(numbers)
    return {t: np.array(rows) for t, rows in sorted(clouds.items())}


def check_poses(found, truth):
    same("number of poses", len(found), len(truth["pose"]))
    for i, ((_, rows), one) in enumerate(zip(truth["pose"], found)):
        same(f"pose {i}", one, matrix(rows), 1e-9)


def kitti(folder, truth):
    sequence = folder / "sequences" / "00"
    calib = {line.split(":")[0]: [float(n) for n in line.split(":")[1].split()] for line in (sequence / "calib.txt").read_text().splitlines()}
    if sorted(calib) != ["P0", "P1", "P2", "P3", "Tr"]:
        differ(f"names in calib.txt: {sorted(calib)}")
    Tr = matrix(calib["Tr"])
    same("Tr", Tr, matrix(truth["mount"][0][1]), 1e-12)
    times = [nanoseconds(line) for line in (sequence / "times.txt").read_text().split()]
    same("times", times, times_of(truth["pose"]))
    poses = np.loadtxt(folder / "poses" / "00.txt", ndmin=2)
    check_poses([np.linalg.inv(Tr) @ matrix(rows) @ Tr for rows in poses], truth)
    files = sorted((sequence / "velodyne").iterdir())
    clouds = clouds_of(truth)
    same("number of clouds", len(files), len(clouds))
    for i, (file, cloud) in enumerate(zip(files, clouds.values())):
        if file.name != f"{i:06}.bin":
            differ(f"a cloud is called {file.name}")
        same(file.name, np.fromfile(file, dtype="<f4").reshape(-1, 4), cloud[:, :4].astype(np.float32))


def yaml_number(text, key):
    return float(re.search(rf"^{key}: *(\S+)", text, re.MULTILINE).group(1))


def yaml_mount(text):
    return np.array([float(n) for n in re.search(r"data: \[([^\]]*)\]", text).group(1).split(",")]).reshape(4, 4)


def csv(file):
    header, *rows = file.read_text().splitlines()
    cells = [row.split(",") for row in rows]
    return header.split(","), np.array([int(c[0]) for c in cells], dtype=np.int64), np.array([[float(n) for n in c[1:]] for c in cells])


def euroc(folder, truth):
    imu, states = folder / "mav0" / "imu0", folder / "mav0" / "state_groundtruth_estimate0"
    sensor = (imu / "sensor.yaml").read_text()
    same("T_BS", yaml_mount(sensor), matrix(truth["mount"][0][1]), 1e-12)
    keys = ["rate_hz", "gyroscope_noise_density", "gyroscope_random_walk", "accelerometer_noise_density", "accelerometer_random_walk"]
    same("noise", [yaml_number(sensor, key) for key in keys], truth["noise"][0][1])
    header, times, samples = csv(imu / "data.csv")
    if [name.split("_")[0] for name in header] != ["#timestamp [ns]", "w", "w", "w", "a", "a", "a"]:
        differ(f"header of the IMU: {header}")
    same("times of the IMU", times, times_of(truth["imu"]))
    same("samples", samples, numbers_of(truth["imu"]))
    same("T_BS of the truth", yaml_mount((states / "sensor.yaml").read_text()), np.eye(4))
    header, times, rows = csv(states / "data.csv")
    same("columns of the truth", len(header), 17)
    same("times of the truth", times, times_of(truth["pose"]))
    check_poses([pose(row[:3], row[3:7]) for row in rows], truth)
    same("velocity and biases", rows[:, 7:], numbers_of(truth["motion"]))


def read_pcd(file):
    head, data = file.read_bytes().split(b"DATA binary\n", 1)
    lines = {words[0]: words[1:] for words in (line.split() for line in head.decode().splitlines())}
    kinds = {"F": "f", "U": "u", "I": "i"}
    dtype = np.dtype([(n, f"<{kinds[t]}{s}") for n, t, s in zip(lines["FIELDS"], lines["TYPE"], lines["SIZE"])])
    points = np.frombuffer(data, dtype)
    same(f"points of {file.name}", len(points), int(lines["POINTS"][0]))
    return points


def pcd_imu(folder, truth):
    clouds = clouds_of(truth)
    files = {int(file.stem): file for file in folder.glob("*.pcd")}
    same("times of the clouds", sorted(files), list(clouds))
    for t_ns, wanted in clouds.items():
        points = read_pcd(files[t_ns])
        for column, field in enumerate(["x", "y", "z", "intensity"]):
            same(f"{field} of {t_ns}", points[field], wanted[:, column].astype(np.float32))
        same(f"rings of {t_ns}", points["ring"], wanted[:, 4])
        same(f"times of points of {t_ns}", points["t"], wanted[:, 5])
    header, times, samples = csv(folder / "imu.csv")
    if header != ["t_ns", "wx", "wy", "wz", "ax", "ay", "az"]:
        differ(f"header of imu.csv: {header}")
    same("times of the IMU", times, times_of(truth["imu"]))
    same("samples", samples, numbers_of(truth["imu"]))
    lines = [line.split() for line in (folder / "truth.tum").read_text().splitlines() if not line.startswith("#")]
    same("times of the truth", [nanoseconds(words[0]) for words in lines], times_of(truth["pose"]))
    rows = [[float(n) for n in words[1:]] for words in lines]
    check_poses([pose(row[:3], [row[6], *row[3:6]]) for row in rows], truth)
    tables = re.findall(r"\[(\w+)\]\nposition_m = \[(.*)\]\norientation_wxyz = \[(.*)\]\n", (folder / "mounts.toml").read_text())
    if [name for name, _, _ in tables] != ["lidar", "imu"]:
        differ("mounts.toml has other tables")
    for (name, position, wxyz), (_, rows) in zip(tables, truth["mount"]):
        same(name, pose([float(n) for n in position.split(",")], [float(n) for n in wxyz.split(",")]), matrix(rows), 1e-12)


if __name__ == "__main__":
    layout, folder, truth = sys.argv[1:]
    {"kitti": kitti, "euroc": euroc, "pcd_imu": pcd_imu}[layout](pathlib.Path(folder), read_truth(truth))
