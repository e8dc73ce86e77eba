# SPDX-License-Identifier: MIT
"""Trajectories of many shapes in three formats, scored by `hallway score` and by numpy.

usage: score_oracle.py HALLWAY FOLDER COUNT      (status 1, and what differs, where they do not agree to 1e-9)
"""
import json
import os
import subprocess
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import trajectory_oracle as paths  # noqa: E402

SHAPES = ("line", "line_exact", "circle", "eight", "helix", "walk", "rest", "tumble", "road", "far_away", "jumps")


def turn(rng, scale):
    """A rotation matrix by a random vector of that length in radians."""
    v = rng.normal(size=3) * scale
    angle = np.linalg.norm(v)
    if angle == 0:
        return np.eye(3)
    k = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]]) / angle
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def truth_of(shape, n, rng):
    s = np.linspace(0, 1, n)
    place = {
        "line": lambda: np.stack([40 * s, 3 * s, 0 * s], 1) + rng.normal(size=(n, 3)) * 0.02,
        "line_exact": lambda: np.stack([40 * s, 0 * s, 0 * s], 1),
        "circle": lambda: np.stack([10 * np.cos(7 * s), 10 * np.sin(7 * s), 0 * s], 1),
        "eight": lambda: np.stack([30 * np.sin(6.3 * s), 15 * np.sin(12.6 * s), 0.5 * np.cos(9 * s)], 1),
        "helix": lambda: np.stack([4 * np.cos(20 * s), 4 * np.sin(20 * s), 12 * s], 1),
        "walk": lambda: np.cumsum(rng.normal(size=(n, 3)) * 0.3, axis=0),
        "rest": lambda: rng.normal(size=(n, 3)) * 0.004,
        "tumble": lambda: np.cumsum(rng.normal(size=(n, 3)) * 0.1, axis=0),
        "road": lambda: np.stack([900 * s, 300 * np.sin(4 * s), 20 * s ** 2], 1),
        "far_away": lambda: np.stack([1e5 + 50 * np.sin(6 * s), -2e5 + 30 * s, 400 + 5 * s], 1),
        "jumps": lambda: np.cumsum(rng.normal(size=(n, 3)) * np.where(rng.random((n, 1)) < 0.1, 3.0, 0.05), axis=0),
    }[shape]()
    r, poses = turn(rng, 2.0), []
    for p in place:
        poses.append(paths.pose(p, r))
        r = r @ turn(rng, 1.5 if shape == "tumble" else 0.05)
    return poses


def estimate_of(truth, scale, rng):
    motion, noise = paths.pose(rng.normal(size=3) * 50, turn(rng, 2.0)), rng.choice([1e-3, 0.05, 0.5])
    drift, poses = np.eye(4), []
    for t in truth:
        e = motion @ t @ paths.pose(rng.normal(size=3) * noise, turn(rng, noise * 0.3)) @ drift
        e[:3, 3] *= scale
        poses.append(e)
        drift = drift @ paths.pose(rng.normal(size=3) * noise * 0.1, turn(rng, noise * 0.02))
    return poses


def quaternion(r):
    """w, x, y, z by the largest component."""
    four = np.array([1 + r[0, 0] + r[1, 1] + r[2, 2], 1 + r[0, 0] - r[1, 1] - r[2, 2], 1 - r[0, 0] + r[1, 1] - r[2, 2],
                     1 - r[0, 0] - r[1, 1] + r[2, 2]])
    i = int(np.argmax(four))
    v = {0: [four[0], r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]],
         1: [r[2, 1] - r[1, 2], four[1], r[0, 1] + r[1, 0], r[0, 2] + r[2, 0]],
         2: [r[0, 2] - r[2, 0], r[0, 1] + r[1, 0], four[2], r[1, 2] + r[2, 1]],
         3: [r[1, 0] - r[0, 1], r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], four[3]]}[i]
    return np.array(v) / np.linalg.norm(v)


def nearest_rotation(m):
    u, _, vt = np.linalg.svd(m)
    return u @ np.diag([1, 1, np.sign(np.linalg.det(u @ vt))]) @ vt


def write(path, fmt, times, poses, rng):
    """@return times and poses as the file has them"""
    lines, kept_t, kept = [], [], []
    if fmt == "euroc":
        lines.append("#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], v_RS_R_x [m s^-1]")
    elif rng.random() < 0.5:
        lines.append("# a comment, with commas")
    digits = rng.choice([7, 17])
    def text(v):
        return f"{v:.{digits}g}"
    for index, (t, p) in enumerate(zip(times, poses)):
        place = [float(text(v)) for v in p[:3, 3]]
        if fmt == "kitti":
            rows = [[float(text(v)) for v in row] for row in p[:3]]
            lines.append(" ".join(text(v) for row in p[:3] for v in row))
            kept.append(paths.pose([row[3] for row in rows], nearest_rotation(np.array([row[:3] for row in rows]))))
            kept_t.append(float(index))
            continue
        q = quaternion(p[:3, :3]) * rng.choice([-1, 1])
        q = [float(text(v)) for v in q]
        kept.append(paths.pose(place, paths.rotation(q)))
        if fmt == "tum":
            lines.append(" ".join([repr(float(t))] + [repr(v) for v in place + q[1:] + q[:1]]))
            kept_t.append(float(t))
        else:
            ns = round(t * 1e9)
            lines.append(",".join([str(ns)] + [repr(v) for v in place + q] + ["0.5"]))
            kept_t.append(ns / 1e9)
    with open(path, "w", encoding="utf-8", newline="") as file:
        end = "\r\n" if rng.random() < 0.2 else "\n"
        file.write(end.join(lines) + end)
    return kept_t, kept


def covered(times, whole):
    if whole[-1] == whole[0]:
        return 1.0
    steps = np.diff(times)
    return min(float(steps[steps <= 5 * np.median(steps)].sum()) / (whole[-1] - whole[0]), 1.0) if len(steps) else 0.0


def expected(reference, estimate, options):
    (rt, rp), (et, ep) = reference, estimate
    pairs = paths.associate(rt, [t + options["offset"] for t in et], options["most"])
    truth, found = [rp[i] for i, _ in pairs], [ep[j] for _, j in pairs]
    motion = paths.fit(truth, found, options["align"])
    along = paths.travelled([p[:3, 3] for p in rp])
    places = {"frames": [0] * len(pairs), "metres": [along[i] for i, _ in pairs], "seconds": [rt[i] for i, _ in pairs]}
    rpe = [{"delta": value, "unit": unit, **paths.relative_error(truth, found, places[unit], value, unit, motion[0])}
           for value, unit in options["deltas"]]
    if options["kitti"]:
        for entry in rpe:
            if entry["unit"] == "seconds":
                entry["translation_m"] = entry["rotation_deg"] = None
    limit, worst, _, first = paths.divergence(truth, found, [p[:3, 3] for p in rp], False, "sim3" if options["align"] == "sim3" else "se3")
    coverage = covered([rt[i] for i, _ in pairs], rt)
    return {"pairs": len(pairs), "coverage": coverage, "scale": motion[0],
            "verdict": "diverged" if first is not None else "lost" if coverage < 0.5 else "ok",
            "ate": paths.absolute_error(truth, found, motion), "rpe": rpe,
            "divergence": {"position_limit_m": limit, "position_worst_m": worst,
                           "first_s": None if first is None else rt[pairs[first][0]]}}


def differences(ours, oracle, place=""):
    if isinstance(oracle, dict):
        return [d for k, v in oracle.items() for d in differences(ours[k], v, place + "." + k)]
    if isinstance(oracle, list):
        return [d for i, v in enumerate(oracle) for d in differences(ours[i], v, f"{place}[{i}]")]
    if isinstance(oracle, float) and isinstance(ours, (int, float)):
        return [] if abs(ours - oracle) <= 1e-9 else [f"{place}: {ours!r}, numpy {oracle!r}"]
    return [] if ours == oracle else [f"{place}: {ours!r}, numpy {oracle!r}"]


def one(seed, hallway, folder):
    rng = np.random.default_rng(seed)
    shape = SHAPES[seed % len(SHAPES)]
    n = int(rng.integers(8, 160))
    align = ("none", "first", "se3", "sim3")[int(rng.integers(4))]
    if shape in ("rest", "line_exact") and align == "sim3":
        align = "se3"
    kitti = rng.random() < 0.25
    formats = ("kitti", "kitti") if kitti else tuple(rng.choice(["tum", "euroc"], 2))
    times = np.cumsum(rng.uniform(0.02, 0.12, n)) + rng.choice([0.0, 1305031102.0])
    truth = truth_of(shape, n, rng)
    estimate = estimate_of(truth, rng.uniform(0.3, 3.0) if align == "sim3" else 1.0, rng)
    offset = 0.0 if kitti else float(rng.choice([0.0, 0.5, -12.25]))
    keep = np.full(n, True) if kitti else rng.random(n) < rng.choice([1.0, 0.7])
    keep[:4] = True
    files = [os.path.join(folder, f"{seed}_{side}.txt") for side in ("reference", "estimate")]
    reference = write(files[0], formats[0], times, truth, rng)
    jitter = 0.0 if kitti else rng.uniform(-0.009, 0.009, n)
    moved = times + jitter - offset
    estimate = write(files[1], formats[1], moved[keep], [e for e, k in zip(estimate, keep) if k], rng)
    deltas = [(1.0, "frames"), (float(rng.integers(2, 9)), "frames"), (1.0, "metres"), (5.0, "metres"), (1.0, "seconds"),
              (0.25, "seconds")]
    arguments = [hallway, "score", *files, "--json", "--align", align, "--max-difference", "0.015",
                 "--time-offset", repr(offset), "--delta", ",".join(repr(v if u != "frames" else int(v)) + u[0] for v, u in deltas)]
    ended = subprocess.run(arguments, capture_output=True, text=True)
    if ended.returncode != 0:
        return [f"status {ended.returncode}: {ended.stderr}"]
    document = json.loads(ended.stdout)
    document["scale"] = document["alignment"]["scale"]
    found = [] if [document[s]["format"] for s in ("reference", "estimate")] == list(formats) else ["formats are not told"]
    oracle = expected(reference, estimate, {"align": align, "offset": offset, "most": 0.0 if kitti else 0.015,
                                            "deltas": deltas, "kitti": kitti})
    return [f"{shape}, {formats}, {align}: {d}" for d in found + differences(document, oracle)]


def main():
    hallway, folder, count = sys.argv[1], sys.argv[2], int(sys.argv[3])
    wrong = [f"seed {seed}: {d}" for seed in range(count) for d in one(seed, hallway, folder)]
    print("\n".join(wrong[:40]))
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
