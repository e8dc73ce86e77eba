# SPDX-License-Identifier: MIT
"""check_layouts.py HALLWAY LOG FOLDER WHAT: compares what `hallway log convert` wrote with the log, by numpy and the definitions of the layouts.

The log is read as JSON (`hallway log frame`). Its truth is computed here: the robot goes with 2.5 m/s from 1, 1, 0.5 along x, from 5.5 m on through an arc of 0.5 m to the left, then along y. WHAT: kitti, deskewed, pcd-imu, euroc, tables, or again (FOLDER is a log that was made of a
PCD+IMU folder of LOG), again-kitti, again-euroc. The status is 1 where they differ: points beyond float32, poses beyond 1e-9, other numbers at all. The room of the log is from
0, 0, 0 to 8, 6, 2.7 m.
"""
import csv
import json
import pathlib
import subprocess
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "unit" / "import"))
import read_layouts as layouts

HALLWAY, LOG, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
ROOM_M = np.array([8, 6, 2.7])


def number(value):
    return {None: np.nan, "inf": np.inf, "-inf": -np.inf}.get(value, value)


class Log:
    def __init__(self, file):
        info = json.loads(subprocess.run([HALLWAY, "log", "info", file, "--json"], capture_output=True, check=True).stdout)
        count = next(c["messages"] for c in info["channels"] if c["topic"] == "/hallway/frame")
        self.ids = {sensor["name"]: sensor["id"] for sensor in info["sensors"]}
        self.frames = [json.loads(subprocess.run([HALLWAY, "log", "frame", file, str(i), "--json"], capture_output=True, check=True).stdout)["frame"]
                       for i in range(count)]

    def samples(self, name):
        return [sample for frame in self.frames for sample in frame["samples"] if sample["sensor"] == self.ids[name]]


def scan_points(sample):
    """x, y, z, intensity, ring, time of the rays with a return."""
    payload = sample["payload"]
    rays = np.array([[number(ray[key]) for key in ("azimuth_rad", "elevation_rad", "range_m")] for ray in payload["rays"]])
    hit = np.isfinite(rays[:, 2])
    azimuth, elevation, range_m = rays[hit].T
    xyz = range_m * np.array([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)])
    rest = [np.array([number(x) for x in payload[key]], dtype=float)[hit] for key in ("intensity", "ring", "t_offset_ns")]
    return np.column_stack([xyz.T, *rest])


def cloud_points(sample):
    payload = sample["payload"]
    columns = [payload["points"]] + [np.array([number(x) for x in payload[key]], dtype=float)[:, None] for key in ("intensity", "ring", "t_offset_ns") if key in payload]
    return np.hstack(columns)


def same_points(what, found, wanted):
    """Of float32: sines of two libraries may differ in the last bit."""
    layouts.same(what, found[:, :3], wanted[:, :3], 4e-7 * max(1.0, np.abs(wanted[:, :3]).max()))
    layouts.same(what, found[:, 3].astype(np.float32), wanted[:, 3].astype(np.float32))
    layouts.same(what, found[:, 4:], wanted[:, 4:])


def true_pose(t_ns):
    way, straight, radius = 2.5 * t_ns * 1e-9, 4.5, 0.5
    turn = min(max((way - straight) / radius, 0), np.pi / 2)
    further = max(way - straight - radius * np.pi / 2, 0)
    position = [1 + min(way, straight) + radius * np.sin(turn), 1 + radius * (1 - np.cos(turn)) + further, 0.5]
    return layouts.pose(position, [np.cos(turn / 2), 0, 0, np.sin(turn / 2)])


def mount(name):
    sensor = next(s for s in json.loads((LOG / "run.json").read_text())["sensors"] if s["name"] == name)
    return layouts.pose(sensor["T_body_sensor"]["position_m"], sensor["T_body_sensor"]["orientation_wxyz"])


def imu_rows(log, name="imu"):
    samples = log.samples(name)
    times = [s["t_begin_ns"] + (s["t_end_ns"] - s["t_begin_ns"]) // 2 for s in samples]
    return times, [s["payload"]["angular_rad_s"] + s["payload"]["force_m_s2"] for s in samples]


def kitti_clouds():
    return [np.fromfile(file, dtype="<f4").reshape(-1, 4) for file in sorted((FOLDER / "sequences/00/velodyne").iterdir())]


def kitti_poses():
    calib = dict(line.split(":") for line in (FOLDER / "sequences/00/calib.txt").read_text().splitlines())
    Tr = layouts.matrix([float(n) for n in calib["Tr"].split()])
    return [np.linalg.inv(Tr) @ layouts.matrix(rows) @ Tr for rows in np.loadtxt(FOLDER / "poses/00.txt", ndmin=2)]


def check_kitti_truth(log):
    times = [layouts.nanoseconds(line) for line in (FOLDER / "sequences/00/times.txt").read_text().split()]
    layouts.same("times", times, [s["t_end_ns"] for s in log.samples("lidar")])
    poses = [true_pose(t_ns) @ mount("lidar") for t_ns in times]
    for i, (found, wanted) in enumerate(zip(kitti_poses(), poses, strict=True)):
        layouts.same(f"pose {i}", found, np.linalg.inv(poses[0]) @ wanted, 1e-9)
    return poses


def kitti(log):
    check_kitti_truth(log)
    for i, (found, sample) in enumerate(zip(kitti_clouds(), log.samples("lidar"), strict=True)):
        same_points(f"cloud {i}", found, scan_points(sample)[:, :4])


def off_the_walls(points):
    """How far the farthest of the points is from the nearest wall."""
    return np.min(np.minimum(np.abs(points), np.abs(points - ROOM_M)), axis=1).max()


def deskewed(log):
    poses = check_kitti_truth(log)
    worst = {"skewed": [], "deskewed": []}
    for found, sample, pose in zip(kitti_clouds(), log.samples("lidar"), poses, strict=True):
        for what, points in (("skewed", scan_points(sample)), ("deskewed", found.astype(float))):
            worst[what].append(off_the_walls(points[:, :3] @ pose[:3, :3].T + pose[:3, 3]))
    # Where the arc begins and ends, the rate jumps by 5 rad/s between two true poses of 0.005 s.
    if sum(m < 1e-4 for m in worst["deskewed"]) < len(poses) - 3 or max(worst["deskewed"]) > 0.03 or min(worst["skewed"]) < 0.03:
        layouts.differ(f"points off the walls [m]: {worst}")


def pcd_imu(log):
    files = {int(file.stem): file for file in FOLDER.glob("*.pcd")}
    samples = log.samples("lidar")
    layouts.same("times of the clouds", sorted(files), [s["t_begin_ns"] for s in samples])
    for sample in samples:
        points = layouts.read_pcd(files[sample["t_begin_ns"]])
        same_points("cloud", np.column_stack([points[name].astype(float) for name in ("x", "y", "z", "intensity", "ring", "t")]), scan_points(sample))
    header, times, rows = layouts.csv(FOLDER / "imu.csv")
    layouts.same("times of the IMU", times, imu_rows(log)[0])
    layouts.same("samples", rows, imu_rows(log)[1])
    lines = [line.split() for line in (FOLDER / "truth.tum").read_text().splitlines()[1:]]
    check_truth(log, {layouts.nanoseconds(w[0]): layouts.pose([float(n) for n in w[1:4]], [float(w[7]), *map(float, w[4:7])]) for w in lines})


def check_truth(log, found):
    for t_ns, pose in found.items():
        layouts.same(f"pose at {t_ns}", pose, true_pose(t_ns), 1e-9)
    wanted = {frame["t_ns"] for frame in log.frames} | {s["t_end_ns"] for s in log.samples("imu")}
    if not wanted <= set(found):
        layouts.differ(f"there are no true poses at {sorted(wanted - set(found))[:3]}")


def euroc(log):
    sensor = (FOLDER / "mav0/imu0/sensor.yaml").read_text()
    layouts.same("T_BS", layouts.yaml_mount(sensor), mount("imu"), 1e-12)
    layouts.same("rate", layouts.yaml_number(sensor, "rate_hz"), 200)
    header, times, rows = layouts.csv(FOLDER / "mav0/imu0/data.csv")
    layouts.same("times of the IMU", times, imu_rows(log)[0])
    layouts.same("samples", rows, imu_rows(log)[1])
    header, times, rows = layouts.csv(FOLDER / "mav0/state_groundtruth_estimate0/data.csv")
    check_truth(log, {t: layouts.pose(row[:3], row[3:7]) for t, row in zip(times.tolist(), rows)})


def table(name):
    with open(FOLDER / name, newline="") as file:
        return list(csv.DictReader(file))


def cells(rows, columns):
    return np.array([[float(row[c]) if row[c] else np.nan for c in columns] for row in rows])


def same_cells(what, found, wanted):
    if not np.array_equal(found, np.array(wanted, dtype=float), equal_nan=True):
        layouts.differ(f"{what}: other numbers")


def tables(log):
    samples = log.samples("lidar")
    wanted = [[s["sequence"], s["t_begin_ns"] + s["payload"]["t_offset_ns"][i], s["payload"]["ring"][i],
               *(number(ray[k]) for k in ("azimuth_rad", "elevation_rad", "range_m")), number(s["payload"]["intensity"][i]), 0]
              for s in samples for i, ray in enumerate(s["payload"]["rays"])]
    same_cells("rays", cells(table("lidar.csv"), ["sequence", "t_ns", "ring", "azimuth_rad", "elevation_rad", "range_m", "intensity", "layer"]), wanted)
    same_cells("IMU", cells(table("imu.csv"), ["t_begin_ns", "t_end_ns", "wx_rad_s", "wy_rad_s", "wz_rad_s", "fx_m_s2", "fy_m_s2", "fz_m_s2"]),
               [[s["t_begin_ns"], s["t_end_ns"], *s["payload"]["angular_rad_s"], *s["payload"]["force_m_s2"]] for s in log.samples("imu")])
    same_cells("ticks", cells(table("wheels.csv"), ["sequence", "t_ns", "wheel", "ticks"]),
               [[s["sequence"], s["t_end_ns"], i, ticks] for s in log.samples("wheels") for i, ticks in enumerate(s["payload"]["wheels"])])
    same_cells("odometry", cells(table("odometry.csv"), ["t_ns", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz", "cov_00", "cov_55"]),
               [[s["t_end_ns"], *s["payload"]["position"], *s["payload"]["orientation"], number(s["payload"]["covariance"][0]), number(s["payload"]["covariance"][20])]
                for s in log.samples("odometry")])
    same_cells("points", cells(table("eyes.csv"), ["sequence", "t_ns", "x_m", "y_m", "z_m"]),
               [[s["sequence"], s["t_begin_ns"], *point] for s in log.samples("eyes") for point in s["payload"]["points"]])
    layouts.same("frames", [int(row["t_ns"]) for row in table("frames.csv")], [frame["t_ns"] for frame in log.frames])
    for name in ("frames", "imu_readings", "lidar_readings"):
        for row in table(name + ".csv"):
            numbers = [float(row[c]) for c in ("x_m", "y_m", "z_m", "qw", "qx", "qy", "qz")]
            t_ns = int(row["t_ns" if name == "frames" else "true_end_ns"])
            layouts.same(f"true pose in {name}", layouts.pose(numbers[:3], numbers[3:]), true_pose(t_ns), 1e-9)
    layouts.same("readings", [int(row["sequence"]) for row in table("imu_readings.csv")], [s["sequence"] for s in log.samples("imu")])


def same_imu(log, other, name):
    for a, b in zip(log.samples("imu"), other.samples(name), strict=True):
        for key in ("sequence", "t_begin_ns", "t_end_ns"):
            layouts.same(key, b[key], a[key])
        for key in ("angular_rad_s", "force_m_s2"):
            layouts.same(key, b["payload"][key], a["payload"][key])


def again(log):
    other = Log(FOLDER)
    layouts.same("frames", [f["t_ns"] for f in other.frames], [f["t_ns"] for f in log.frames])
    same_imu(log, other, "imu")
    for a, b in zip(log.samples("lidar"), other.samples("lidar"), strict=True):
        layouts.same("begin", b["t_begin_ns"], a["t_begin_ns"])
        same_points("cloud", cloud_points(b), scan_points(a))


def again_kitti(log):
    for a, b in zip(log.samples("lidar"), Log(FOLDER).samples("lidar"), strict=True):
        layouts.same("time", b["t_end_ns"], a["t_end_ns"])
        same_points("cloud", cloud_points(b), scan_points(a)[:, :4])


def again_euroc(log):
    same_imu(log, Log(FOLDER), "imu0")


if __name__ == "__main__":
    {"kitti": kitti, "deskewed": deskewed, "pcd-imu": pcd_imu, "euroc": euroc, "tables": tables, "again": again, "again-kitti": again_kitti,
     "again-euroc": again_euroc}[sys.argv[4]](Log(LOG / "run.mcap"))
