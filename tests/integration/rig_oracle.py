# SPDX-License-Identifier: MIT
"""What the sensors of a robot on a path of waypoints measure without noise, against the readings of its run's log: from the text of the scenario and the map, in double precision.

Ranges: each ray is traced from where the path has the robot at its own time, through all triangles of the map (body_oracle.py). Inertial readings: quadrature of the path.
Shares nothing with the program but the formats of files.

Usage: rig_oracle.py FOLDER FRAMES RAYS TOLERANCE_M: FRAMES is a file with a JSON document of `hallway log frame --json` in each line; of scans every n-th ray is traced, about RAYS in all.
Prints a JSON document."""
import json
import math
import os
import sys
import tomllib

import numpy as np
from body_oracle import read_map, rotations, world_of

GRAZING_RAD = 1e-6
TOLERANCE_M = 1e-6
NODES, WEIGHTS = np.polynomial.legendre.leggauss(24)


def share(u):
    """From 0 to 1 with two derivatives that vanish at both ends."""
    return u**3 * (10 - 15 * u + 6 * u**2)


def mean_direction(turn, u):
    """Of a smooth corner, over the first part u of its length: the integral of the direction over it, by u."""
    angles = turn * share(u * (NODES + 1) / 2)
    return u * (WEIGHTS / 2 * np.cos(angles)).sum(), u * (WEIGHTS / 2 * np.sin(angles)).sum()


class Path:
    """Straight lines with arcs or smooth curves at the corners, of an hw_path with waypoints; by distance."""

    def __init__(self, entities, name, smooth):
        scale = float(entities[0][0].get("_scale", 1 / 32))
        keys = next(k for k, _ in entities if k.get("classname") == "hw_path" and k["name"] == name)
        points = sorted(((int(k["index"]), k["origin"]) for k, _ in entities if k.get("classname") == "hw_waypoint" and k["path"] == name))
        points = [np.array(origin.split(), float) * scale for _, origin in points]
        radius, closed = float(keys.get("corner_radius_m", 0.5)), keys.get("closed") == "1"
        n = len(points)
        lines = [points[(i + 1) % n] - points[i] for i in range(n if closed else n - 1)]
        ahead = [line / np.linalg.norm(line) for line in lines]
        turn = [0.0] * n
        for i in range(n) if closed else range(1, n - 1):
            turn[i] = math.atan2(np.linalg.norm(np.cross(ahead[i - 1], ahead[i])), ahead[i - 1] @ ahead[i])
        trim = [radius * math.tan(a / 2) for a in turn]
        self.pieces, self.length = [], 0.0  # (begin, start, direction, inward, radius or 0 or (length, turn))
        for i, line in enumerate(lines):
            j = (i + 1) % n
            self.add(np.linalg.norm(line) - trim[i] - trim[j], points[i] + ahead[i] * trim[i], ahead[i], np.zeros(3), 0.0)
            if turn[j] > 0:
                inward = ahead[j] - ahead[i] * (ahead[i] @ ahead[j])
                length, bend = radius * turn[j], radius
                if smooth:
                    x, y = mean_direction(turn[j], 1.0)
                    length = 2 * trim[j] * math.cos(turn[j] / 2) / math.hypot(x, y)
                    bend = length, turn[j]
                self.add(length, points[j] - ahead[i] * trim[j], ahead[i], inward / np.linalg.norm(inward), bend)
        self.begins = np.array([p[0] for p in self.pieces])

    def add(self, length, start, direction, inward, radius):
        self.pieces.append((self.length, start, direction, inward, radius))
        self.length += length

    def piece(self, distance):
        return int(np.searchsorted(self.begins, distance % self.length, side="right")) - 1

    def frame(self, distance, piece):
        """Position and rotation matrix; analytic in the distance, which may be complex."""
        begin, start, direction, inward, radius = self.pieces[piece]
        along = distance - begin
        if isinstance(radius, tuple):
            length, turn = radius
            a, b = mean_direction(turn, along / length)
            angle = turn * share(along / length)
            position, x = start + length * (a * direction + b * inward), np.cos(angle) * direction + np.sin(angle) * inward
        elif radius == 0.0:
            position, x = start + along * direction, direction + 0 * along
        else:
            s, c = np.sin(along / radius), np.cos(along / radius)
            position, x = start + radius * (s * direction + (1 - c) * inward), c * direction + s * inward
        side = np.array([-x[1], x[0], 0 * x[0]])
        y = side / np.sqrt((side * side).sum())
        return position, np.array([x, y, np.cross(x, y)]).T


def rotation(yaw, pitch, roll):
    """About z, then the new y, then the new x; degrees."""
    a, b, c = np.radians([yaw, pitch, roll])
    z = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
    y = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    x = np.array([[1, 0, 0], [0, np.cos(c), -np.sin(c)], [0, np.sin(c), np.cos(c)]])
    return z @ y @ x


def mount_of(sensor):
    return np.array(sensor.get("position_m", [0, 0, 0]), float), rotation(sensor.get("yaw_deg", 0), sensor.get("pitch_deg", 0), sensor.get("roll_deg", 0))


def first_hits(triangles, origins, directions):
    """Distance of the first hit of each ray, infinite where there is none. Rays of one origin that follow each other are traced together."""
    a, e1, e2 = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    normals = np.cross(e1, e2)
    usable = np.linalg.norm(normals, axis=1) > 0
    a, e1, e2, normals = a[usable], e1[usable], e2[usable], normals[usable]
    ranges = np.empty(len(origins))
    begin = 0
    while begin < len(origins):
        end = begin + 1
        while end < len(origins) and end - begin < 128 and (origins[end] == origins[begin]).all():
            end += 1
        rays = directions[begin:end].T
        to = a - origins[begin]
        facing = normals @ rays
        side = np.where(facing < 0, -1.0, 1.0)
        facing *= side
        u, v = -(np.cross(to, e2) @ rays) * side, (np.cross(to, e1) @ rays) * side
        depth = (normals * to).sum(1)[:, None] * side
        hit = (facing > 0) & (u >= 0) & (v >= 0) & (u + v <= facing) & (depth >= 0)
        distances = np.where(hit, depth / np.where(facing > 0, facing, 1), math.inf)
        ranges[begin:end] = distances.min(axis=0)
        begin = end
    return ranges


def cone(width_deg, resolution_deg):
    """The rays of a sonar's beam about x, as docs/sensors.md and sense/echo_beam.hpp say."""
    half, resolution = math.radians(width_deg) / 2, math.radians(resolution_deg)
    rays, rings = [[1.0, 0.0, 0.0]], math.ceil(half / resolution)
    for k in range(1, rings + 1):
        off = half * k / rings
        n = math.ceil(2 * math.pi * math.sin(off) / resolution)
        rays += [[math.cos(off), math.sin(off) * math.cos(2 * math.pi * i / n), math.sin(off) * math.sin(2 * math.pi * i / n)] for i in range(n)]
    return np.array(rays)


def grazes(triangles, origin, direction, up_to):
    """Whether a ray passes an edge of a triangle within GRAZING_RAD, up to a distance."""
    for k in range(3):
        p, e = triangles[:, k], triangles[:, (k + 1) % 3] - triangles[:, k]
        # The nearest point of the edge to the ray, by a few steps of alternating projection.
        s = np.full(len(p), 0.5)
        for _ in range(50):
            along = np.clip(((p + s[:, None] * e - origin) @ direction), 0, up_to)
            foot = origin + along[:, None] * direction
            s = np.clip(((foot - p) * e).sum(1) / np.maximum((e * e).sum(1), 1e-300), 0, 1)
        gap = np.linalg.norm(p + s[:, None] * e - (origin + along[:, None] * direction), axis=1)
        if (gap <= GRAZING_RAD * np.maximum(along, 1e-9)).any():
            return True
    return False


class Pace:
    """The way over time: at a speed, or smoothly from rest to it; analytic in the time within a phase."""

    def __init__(self, speed, smooth):
        self.speed, self.ramp = speed, 1.875 * speed if smooth else 0.0

    def way(self, t):
        if t.real < self.ramp:
            u = t / self.ramp
            return self.speed * self.ramp * (2.5 * u**4 - 3 * u**5 + u**6)
        return self.speed * (t - self.ramp / 2)

    def time(self, way):
        low, high = 0.0, way / self.speed + self.ramp
        for _ in range(100):
            middle = (low + high) / 2
            low, high = (middle, high) if self.way(middle) < way else (low, middle)
        return high


class Rig:
    def __init__(self, folder):
        with open(os.path.join(folder, "scenario.toml"), "rb") as file:
            self.scenario = tomllib.load(file)
        with open(os.path.join(folder, "map.map"), encoding="utf-8") as file:
            entities = read_map(file.read())
        robot = self.scenario["robot"]
        if "path" not in robot:  # it stands
            with open(os.path.join(folder, "truth.tum"), encoding="utf-8") as file:
                row = np.array([line for line in file if not line.startswith("#")][0].split(), float)
            self.stands = row[1:4], rotations(row[None, [7, 4, 5, 6]])[0]
            return
        self.stands = None
        self.path = Path(entities, robot["path"], robot.get("smooth", False))
        period = self.scenario.get("period_s", 0.1)
        speed = robot["speed_m_s"] if "speed_m_s" in robot else self.path.length / robot["loop_steps"] / period
        self.pace = Pace(speed, robot.get("smooth", False))

    def at(self, t_ns):
        if self.stands:
            return self.stands
        distance = self.pace.way(t_ns * 1e-9) % self.path.length
        return self.path.frame(distance, self.path.piece(distance))

    def pings(self, sensor, sample, triangles):
        """Ranges of a sweep without noise: of each ping the nearest hit of its beam's rays, from where the robot was then."""
        arm, turn = mount_of(sensor)
        beam = cone(sensor.get("cone_deg", 30), sensor.get("resolution_deg", 1))
        n, sweep_ns = sensor.get("pings", 1), sensor.get("sweep_s", 0) * 1e9
        ranges = []
        for i in range(n):
            p, r = self.at(sample["t_begin_ns"] + round(sweep_ns * i / n))
            head = r @ turn @ rotation(sensor.get("first_deg", 0) + i * sensor.get("ping_step_deg", 0), 0, 0)
            origin = p + r @ arm + head[:, 0] * sensor.get("head_radius_m", 0)
            nearest = first_hits(triangles, np.repeat(origin[None], len(beam), 0), beam @ head.T).min()
            ranges.append(nearest if nearest <= sensor.get("max_range_m", 100) else math.inf)
        return ranges

    def imu(self, sensor, begin_ns, end_ns):
        """Means of angular velocity and specific force, by parts: of first derivatives alone, which complex steps give."""
        arm, turn = mount_of(sensor)
        gravity = np.array([0, 0, -sensor.get("gravity_m_s2", 9.80665)])
        t0, t1 = begin_ns * 1e-9, end_ns * 1e-9
        d0, d1 = self.pace.way(t0), self.pace.way(t1)
        base = math.floor(d0 / self.path.length) * self.path.length
        ways = [base + r * self.path.length + b for r in range(2) for b in self.path.begins]
        joints = sorted([t0, t1] + [self.pace.time(d) for d in ways if d0 < d < d1] + [t for t in [self.pace.ramp] if t0 < t < t1])

        def state(t, piece, wrap):
            step = 1e-30
            p, r = self.path.frame(self.pace.way(t + 1j * step) - wrap, piece)
            return r.real, r.imag / step, (p + r @ arm).imag / step

        angular, force = np.zeros(3), np.zeros(3)
        for begin, end in zip(joints, joints[1:]):
            middle = self.pace.way((begin + end) / 2)
            piece = self.path.piece(middle)
            wrap = math.floor(middle / self.path.length) * self.path.length
            # Where an arc begins the sensor's velocity jumps, by its arm: an impulse, which the ends of the whole interval have.
            for edge, sign, is_end in ((end, 1, end == joints[-1]), (begin, -1, begin == joints[0])):
                if is_end:
                    r, _, v = state(edge, piece, wrap)
                    force += sign * (r.T @ v)
            half = (end - begin) / 2
            for node, weight in zip(NODES, WEIGHTS):
                r, rate, v = state((begin + end) / 2 + half * node, piece, wrap)
                spin = r.T @ rate
                seconds = half * weight
                angular += seconds * np.array([spin[2, 1], spin[0, 2], spin[1, 0]])
                force -= seconds * (rate.T @ v + r.T @ gravity)
        duration = (end_ns - begin_ns) * 1e-9
        return turn.T @ angular / duration, turn.T @ force / duration


def main(folder, frames, wanted_rays):
    rig = Rig(folder)
    triangles = world_of(folder)[1]
    sensors = list(rig.scenario["sensor"].items())
    said = {"rays": 0, "worst_range_m": 0.0, "different": 0, "unexplained": 0, "free": 0, "imu_samples": 0, "worst_angular": 0.0, "most_angular": 0.0, "worst_force": 0.0, "most_skew_m": 0.0, "pings": 0, "worst_ping_m": 0.0}
    with open(frames, encoding="utf-8") as file:
        documents = [json.loads(line) for line in file]
    samples = [s for d in documents for s in d["frame"]["samples"]]
    scans = [s for s in samples if s["kind"] == "range_scan" and sensors[s["sensor"]][1]["kind"] == "lidar"]
    total = sum(len(s["payload"]["rays"]) for s in scans)
    every = max(1, total // wanted_rays)
    count = 0
    for sample in samples:
        sensor = sensors[sample["sensor"]][1]
        payload = sample["payload"]
        if sample["kind"] == "imu":
            angular, force = rig.imu(sensor, sample["t_begin_ns"], sample["t_end_ns"])
            said["imu_samples"] += 1
            said["most_angular"] = max(said["most_angular"], float(np.abs(angular).max()))
            said["worst_angular"] = max(said["worst_angular"], float(np.abs(angular - payload["angular_rad_s"]).max()))
            said["worst_force"] = max(said["worst_force"], float(np.abs(force - payload["force_m_s2"]).max()))
        if sample["kind"] != "range_scan":
            continue
        if sensor["kind"] == "sonar":
            for mine, ray in zip(rig.pings(sensor, sample, triangles), payload["rays"]):
                said["pings"] += 1
                said["worst_ping_m"] = max(said["worst_ping_m"], 0.0 if mine == float(ray["range_m"]) else abs(mine - float(ray["range_m"])))
            continue
        arm, turn = mount_of(sensor)
        begin_p, begin_r = rig.at(sample["t_begin_ns"])
        chosen = [i for i in range(len(payload["rays"])) if (count + i) % every == 0]
        count += len(payload["rays"])
        chosen.sort(key=lambda i: payload["t_offset_ns"][i])
        origins, directions, measured = np.empty((len(chosen), 3)), np.empty((len(chosen), 3)), []
        for k, i in enumerate(chosen):
            ray = payload["rays"][i]
            p, r = rig.at(sample["t_begin_ns"] + payload["t_offset_ns"][i])
            e, a = ray["elevation_rad"], ray["azimuth_rad"]
            d = np.array([math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)])
            origins[k], directions[k] = p + r @ arm, r @ turn @ d
            measured.append(float(ray["range_m"]))
            said["most_skew_m"] = max(said["most_skew_m"], float(np.linalg.norm(p + r @ (arm + 5 * turn @ d) - begin_p - begin_r @ (arm + 5 * turn @ d))))
        ranges = first_hits(triangles, origins, directions)
        ranges[ranges > sensor.get("max_range_m", 100)] = math.inf
        for k, (mine, theirs) in enumerate(zip(ranges, measured)):
            said["rays"] += 1
            if math.isinf(mine) and math.isinf(theirs):
                said["free"] += 1
                continue
            difference = abs(mine - theirs)
            if difference <= TOLERANCE_M:
                said["worst_range_m"] = max(said["worst_range_m"], difference)
                continue
            said["different"] += 1
            if not grazes(triangles, origins[k], directions[k], min(mine, theirs) + TOLERANCE_M):
                said["unexplained"] += 1
    print(json.dumps(said))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], int(sys.argv[3]))
