# SPDX-License-Identifier: MIT
"""Errors of trajectories (docs/metrics.md), computed with numpy from their definitions alone: 4x4 matrices, brute force."""
import math

import numpy as np


def rotation(wxyz):
    w, x, y, z = np.array(wxyz, dtype=float) / np.linalg.norm(wxyz)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def pose(position, r):
    t = np.eye(4)
    t[:3, :3], t[:3, 3] = r, position
    return t


def inverse(t):
    r = t[:3, :3].T
    return pose(-r @ t[:3, 3], r)


def angle_deg(r):
    """Of a rotation matrix; well-conditioned from 0 to 180."""
    sine = 0.5 * np.linalg.norm([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    return math.degrees(math.atan2(sine, 0.5 * (np.trace(r) - 1)))


def statistics(errors):
    if not errors:
        return None
    e = np.array(errors)
    return {"count": len(e), "rmse": float(np.sqrt(np.mean(e ** 2))), "mean": float(np.mean(e)),
            "median": float(np.median(e)), "max": float(np.max(e))}


def associate(reference_s, estimate_s, most_s):
    """associate.py of the TUM RGB-D benchmark: all pairs by their difference, each time once."""
    candidates = sorted((abs(e - r), i, j) for i, r in enumerate(reference_s) for j, e in enumerate(estimate_s)
                        if abs(e - r) <= most_s)
    used_i, used_j, pairs = set(), set(), []
    for _, i, j in candidates:
        if i not in used_i and j not in used_j:
            used_i.add(i)
            used_j.add(j)
            pairs.append((i, j))
    return sorted(pairs)


def near_a_line(points):
    if len(points) < 3:
        return True
    extent = np.linalg.svd(np.array(points) - np.mean(points, axis=0), compute_uv=False)
    return not (extent[0] > 0 and extent[1] >= 0.01 * extent[0])


def fit(truth, estimate, kind):
    """Lists of 4x4 poses. @return scale, R, from, to: p -> to + scale R (p - from); whether the rotation is determined"""
    if kind == "none":
        return 1.0, np.eye(3), np.zeros(3), np.zeros(3), True
    if kind == "first":
        r = truth[0][:3, :3] @ estimate[0][:3, :3].T
        return 1.0, r, estimate[0][:3, 3], truth[0][:3, 3], True
    x = np.array([p[:3, 3] for p in estimate])
    y = np.array([p[:3, 3] for p in truth])
    mx, my = x.mean(axis=0), y.mean(axis=0)
    u, d, vt = np.linalg.svd((y - my).T @ (x - mx) / len(x))  # Umeyama 1991, eq. 38 to 42
    s = np.diag([1.0, 1.0, 1.0 if np.linalg.det(u) * np.linalg.det(vt) > 0 else -1.0])
    scale = np.trace(np.diag(d) @ s) / np.mean(((x - mx) ** 2).sum(axis=1)) if kind == "sim3" else 1.0
    return scale, u @ s @ vt, mx, my, not (near_a_line(x) or near_a_line(y))


def absolute_error(truth, estimate, motion):
    scale, r, start, to, determined = motion
    distances = [float(np.linalg.norm(to + scale * (r @ (e[:3, 3] - start)) - t[:3, 3])) for t, e in zip(truth, estimate)]
    angles = [angle_deg(t[:3, :3].T @ r @ e[:3, :3]) for t, e in zip(truth, estimate)] if determined else []
    return {"translation_m": statistics(distances), "rotation_deg": statistics(angles)}


def stretches(places, delta, unit):
    """`places`: metres travelled or seconds of each pair."""
    n = len(places)
    if unit == "frames":
        return [(i, i + int(delta)) for i in range(n - int(delta))]
    result = []
    for i in range(n):
        ends = [j for j in range(i + 1, n) if places[j] - places[i] >= delta - 1e-6]
        if ends and places[ends[0]] - places[i] <= 2 * delta:
            result.append((i, ends[0]))
    return result


def relative_error(truth, estimate, places, delta, unit, scale=1.0):
    def scaled(p):
        return pose(scale * p[:3, 3], p[:3, :3])
    errors = []
    for i, j in stretches(places, delta, unit):
        q = inverse(truth[i]) @ truth[j]
        p = inverse(scaled(estimate[i])) @ scaled(estimate[j])
        errors.append(inverse(q) @ p)
    return {"translation_m": statistics([float(np.linalg.norm(e[:3, 3])) for e in errors]),
            "rotation_deg": statistics([angle_deg(e[:3, :3]) for e in errors])}


def travelled(positions):
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(np.array(positions), axis=0), axis=1))]) \
        if len(positions) > 1 else np.zeros(len(positions))


def divergence(truth, estimate, path, judge_rotation, kind="se3", noise_m=0.0):
    """@param path  the true positions of the whole path, also without an estimate
    @return limit, worst position error, worst rotation error or None, index of the first pair over a limit or None"""
    if len(truth) < 3:
        return None
    scale, r, start, to, _ = fit(truth, estimate, kind)
    y = np.array(path)
    limit = max(0.1, 10 * noise_m, 0.05 * 2 * np.linalg.norm(y - y.mean(axis=0), axis=1).max())
    distances = [np.linalg.norm(to + scale * (r @ (e[:3, 3] - start)) - t[:3, 3]) for t, e in zip(truth, estimate)]
    over = [d > limit for d in distances]
    worst_deg = None
    if judge_rotation:
        u, _, vt = np.linalg.svd(sum(t[:3, :3] @ e[:3, :3].T for t, e in zip(truth, estimate)))
        turn = u @ np.diag([1, 1, np.sign(np.linalg.det(u @ vt))]) @ vt
        angles = [angle_deg(t[:3, :3].T @ turn @ e[:3, :3]) for t, e in zip(truth, estimate)]
        over = [o or a > 30.0 for o, a in zip(over, angles)]
        worst_deg = max(angles)
    return limit, float(max(distances)), worst_deg, over.index(True) if any(over) else None
