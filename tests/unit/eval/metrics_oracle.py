# SPDX-License-Identifier: MIT
"""The metrics of docs/metrics.md computed a second time, with numpy and from their definitions.

usage: metrics_oracle.py RUN.json METRICS.json

RUN.json holds what the evaluator was given:
  iterations: [{truth, estimate: [x, y, z, qw, qx, qy, qz] or null, associations, identities: [id or -1], wall_ms, cpu_ms}]
  landmarks: {id: [x, y, z]} or null, has_identities: bool
  online, refined: [{id, position, status}] (refined may be null)
"""
import json
import math
import sys
from collections import Counter, defaultdict

import numpy as np


def rotation(q):
    w, x, y, z = np.array(q) / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def umeyama(model, data):
    """Umeyama 1991, eq. 34 to 43 with c = 1, as evo does `--align`: R, t with data ~ R model + t. 3xn each."""
    mean_model, mean_data = model.mean(axis=1), data.mean(axis=1)
    covariance = (data - mean_data[:, None]) @ (model - mean_model[:, None]).T / model.shape[1]
    u, _, vt = np.linalg.svd(covariance)
    s = np.eye(3)
    if np.linalg.det(u) * np.linalg.det(vt) < 0.0:
        s[2, 2] = -1
    r = u @ s @ vt
    return r, mean_data - r @ mean_model


def rmse(truth, estimate, r, t):
    if len(truth) == 0:
        return None
    error = np.array(truth) - (np.array(estimate) @ r.T + t)
    return math.sqrt((error ** 2).sum(axis=1).mean())


def aligned_rmse(truth, estimate):
    if len(truth) < 3:
        return None
    return rmse(truth, estimate, *umeyama(np.array(estimate).T, np.array(truth).T))


def angle_deg(a, b):
    """From the distance of the rotation matrices, which is 2 sqrt(2) sin(angle / 2)."""
    return math.degrees(2 * math.asin(min(1.0, np.linalg.norm(a - b) / (2 * math.sqrt(2)))))


def rotation_rmse(truth, estimate, r):
    return math.sqrt(np.mean([angle_deg(a, r @ b) ** 2 for a, b in zip(truth, estimate)]))


def summary(values):
    if not values:
        return None
    def percentile(percent):
        return min(v for v in values if 100 * sum(u <= v for u in values) >= percent * len(values))
    return {"mean": float(np.mean(values)), "p50": percentile(50), "p99": percentile(99), "max": max(values)}


def owners(iterations):
    votes = defaultdict(Counter)
    for iteration in iterations:
        for map_id, true_id in zip(iteration["associations"], iteration["identities"]):
            if map_id != -1:
                votes[map_id][true_id] += 1
    owner, errors = {}, 0
    for map_id, counter in votes.items():
        candidates = [true_id for true_id in counter if true_id != -1]
        if candidates:
            owner[map_id] = min(candidates, key=lambda true_id: (-counter[true_id], true_id))
            errors += sum(count for true_id, count in counter.items() if true_id != owner[map_id])
    return owner, errors


def landmark_pairs(landmark_map, owner, landmarks):
    pairs = [(landmarks[str(owner[m["id"]])], m["position"]) for m in landmark_map
             if m["status"] == "mapped" and m["id"] in owner and str(owner[m["id"]]) in landmarks]
    return [truth for truth, _ in pairs], [estimate for _, estimate in pairs]


def moving(run):
    """Of a run in which nothing moves: all that is marked is a false alarm."""
    status = {m["id"]: m["status"] for m in run["online"]}
    given = {"dynamic": Counter(), "mapped": Counter(), "temporary": Counter()}
    for iteration in run["iterations"]:
        for association, identity in zip(iteration["associations"], iteration["identities"]):
            if identity != -1 and association in status:
                given[status[association]][identity] += 1
    marked = sum(count > given["mapped"][truth] for truth, count in given["dynamic"].items())
    precision = None if marked == 0 else 0.0
    return {"moved": 0, "moved_marked": 0, "marked": marked, "marked_moving": 0, "recall": None, "precision": precision}


def score_landmarks(run, first_pose_frame, result):
    owner, errors = owners(run["iterations"])
    observed = {i for iteration in run["iterations"] for i in iteration["identities"] if i != -1}
    mapped = [m["id"] for m in run["online"] if m["status"] == "mapped"]
    owned = Counter(owner[i] for i in mapped if i in owner)
    result["association_errors"] = errors
    result["landmarks_true"] = len(observed)
    result["landmarks_duplicated"] = sum(count - 1 for count in owned.values())
    result["landmarks_missed"] = len(observed - set(owned))
    result["landmarks_unmatched"] = sum(i not in owner for i in mapped)
    if run["landmarks"] is None:
        return
    result["moving"] = moving(run)
    truth, estimate = landmark_pairs(run["online"], owner, run["landmarks"])
    result["landmark_pairs"] = len(truth)
    if first_pose_frame is not None:
        result["landmark_rmse_m"]["first_pose"] = rmse(truth, estimate, *first_pose_frame)
    result["landmark_rmse_m"]["aligned"] = aligned_rmse(truth, estimate)
    if run["refined"] is not None:
        result["landmark_rmse_m"]["final_aligned"] = aligned_rmse(*landmark_pairs(run["refined"], owner, run["landmarks"]))


def score_trajectory(run, result):
    pairs = [(i["truth"], i["estimate"]) for i in run["iterations"] if i["truth"] and i["estimate"]]
    result["position_pairs"] = len(pairs)
    if not pairs:
        return None
    truth, estimate = [np.array(a[:3]) for a, _ in pairs], [np.array(b[:3]) for _, b in pairs]
    truth_r, estimate_r = [rotation(a[3:]) for a, _ in pairs], [rotation(b[3:]) for _, b in pairs]
    r = truth_r[0] @ estimate_r[0].T
    t = truth[0] - r @ estimate[0]
    result["position_rmse_m"] = {"first_pose": rmse(truth, estimate, r, t), "aligned": aligned_rmse(truth, estimate)}
    result["position_final_m"] = float(np.linalg.norm(truth[-1] - (r @ estimate[-1] + t)))
    u, _, vt = np.linalg.svd(sum(a @ b.T for a, b in zip(truth_r, estimate_r)))
    mean = u @ np.diag([1, 1, np.sign(np.linalg.det(u @ vt))]) @ vt
    result["rotation_rmse_deg"] = {"first_pose": rotation_rmse(truth_r, estimate_r, r),
                                   "aligned": rotation_rmse(truth_r, estimate_r, mean)}
    return r, t


def evaluate(run):
    iterations = run["iterations"]
    result = {
        "schema": "hallway.metrics/1",
        "iterations": len(iterations),
        "lost_iterations": sum(i["estimate"] is None for i in iterations),
        "observations": sum(len(i["associations"]) for i in iterations),
        "associations_none": sum(i["associations"].count(-1) for i in iterations),
        "association_errors": None,
        "landmarks_true": None,
        "landmarks_mapped": sum(m["status"] == "mapped" for m in run["online"]),
        "landmarks_duplicated": None,
        "landmarks_missed": None,
        "landmarks_unmatched": None,
        "moving": None,
        "landmark_pairs": 0,
        "landmark_rmse_m": {"first_pose": None, "aligned": None, "final_aligned": None},
        "position_rmse_m": {"first_pose": None, "aligned": None},
        "position_final_m": None,
        "rotation_rmse_deg": {"first_pose": None, "aligned": None},
        "iteration_ms": summary([i["wall_ms"] for i in iterations if i["wall_ms"] is not None]),
        "iteration_cpu_ms": summary([i["cpu_ms"] for i in iterations if i["cpu_ms"] is not None]),
    }
    first_pose_frame = score_trajectory(run, result)
    if run["has_identities"]:
        score_landmarks(run, first_pose_frame, result)
    return result


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        runs = json.load(file)
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        json.dump([evaluate(run) for run in runs], file)


if __name__ == "__main__":
    main()
