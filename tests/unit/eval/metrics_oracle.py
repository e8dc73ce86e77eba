# SPDX-License-Identifier: MIT
"""The metrics of docs/metrics.md computed a second time, with numpy and from their definitions.

usage: metrics_oracle.py RUN.json METRICS.json

RUN.json holds what the evaluator was given:
  iterations: [{truth, estimate: [x, y, z, qw, qx, qy, qz] or null, t_s, map_epoch: number or null, covariance: 6x6 or null,
    associations, identities: [id or -1], points: [[x, y, z]], wall_ms, cpu_ms}]
  joined: [[epoch, into]]
  landmarks: {id: [x, y, z]} or null, has_identities: bool, noise_m
  online, refined: [{id, position, observations, status, covariance: 3x3 or null}] (refined may be null)
"""
import json
import math
import os
import sys
from collections import Counter, defaultdict

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "support"))
import trajectory_oracle as paths  # noqa: E402


def rotation(q):
    return paths.rotation(q)


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


def weighted_fit(model, data, weights):
    """R, t with data ~ R model + t; rows are points."""
    w = np.array(weights)[:, None] / sum(weights)
    mean_model, mean_data = (w * model).sum(axis=0), (w * data).sum(axis=0)
    u, _, vt = np.linalg.svd((w * (data - mean_data)).T @ (model - mean_model))
    r = u @ np.diag([1, 1, np.sign(np.linalg.det(u @ vt))]) @ vt
    return r, mean_data - r @ mean_model


def determine_a_pose(points):
    if len(points) < 3:
        return False
    extent = np.linalg.svd(np.array(points) - np.mean(points, axis=0), compute_uv=False)
    return extent[0] > 0 and extent[1] >= 0.01 * extent[0]


def score_refitted(run, result):
    if run["refined"] is None:
        return
    mapped = {m["id"]: m for m in run["refined"] if m["status"] == "mapped"}
    truth, estimate = [], []
    for i in run["iterations"]:
        if i["truth"] is None:
            continue
        pairs = [(p, mapped[a]) for p, a in zip(i["points"], i["associations"]) if a in mapped]
        points = np.array([p for p, _ in pairs])
        if len(pairs) < 3:
            continue
        landmarks = np.array([m["position"] for _, m in pairs])
        if not (determine_a_pose(points) and determine_a_pose(landmarks)):
            continue
        weights = [m["observations"] / (m["observations"] + 1) for _, m in pairs]
        _, t = weighted_fit(points, landmarks, weights)
        truth.append(i["truth"][:3])
        estimate.append(t)
    result["position_refitted_pairs"] = len(truth)
    result["position_rmse_m"]["refitted_aligned"] = aligned_rmse(truth, estimate)


def nees(errors):
    """errors: [(error, covariance)]; what has no variance is left out."""
    if not errors:
        return None
    total, freedom = 0.0, 0
    for error, covariance in errors:
        free = np.diag(covariance) != 0
        total += error[free] @ np.linalg.inv(covariance[np.ix_(free, free)]) @ error[free]
        freedom += free.sum()
    return total / freedom


def rotation_vector(r):
    angle = math.acos(max(-1.0, min(1.0, (np.trace(r) - 1) / 2)))
    skew = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    return 0.5 * skew if angle < 1e-7 else angle / (2 * math.sin(angle)) * skew


def score_pose_nees(run, parts, result):
    pairs = [(i["truth"], i["estimate"], i["covariance"]) for i in pairs_of(run, parts, parts["scored"])]
    if len(pairs) < 3:
        return
    truth, estimate = [a[:3] for a, _, _ in pairs], [b[:3] for _, b, _ in pairs]
    if parts["scored"] == parts["last"] and run["has_identities"] and run["landmarks"] is not None:
        of_landmarks = landmark_pairs(run["online"], owners(run["iterations"])[0], run["landmarks"])
        if all(determine_a_pose(side) for side in of_landmarks):
            truth, estimate = of_landmarks
    r, t = umeyama(np.array(truth).T, np.array(estimate).T)
    errors = [(np.concatenate([r @ np.array(a[:3]) + t - np.array(b[:3]),
                               rotation_vector(r @ rotation(a[3:]) @ rotation(b[3:]).T)]), np.array(c))
              for a, b, c in pairs if c is not None]
    result["nees"]["poses"], result["nees"]["pose_pairs"] = nees(errors), len(errors)


def score_landmark_nees(run, owner, result):
    pairs = [(np.array(run["landmarks"][str(owner[m["id"]])]), np.array(m["position"]), m["covariance"])
             for m in run["refined"]
             if m["status"] == "mapped" and m["id"] in owner and str(owner[m["id"]]) in run["landmarks"]]
    if len(pairs) < 3:
        return
    r, t = umeyama(np.array([a for a, _, _ in pairs]).T, np.array([b for _, b, _ in pairs]).T)
    errors = [(r @ a + t - b, np.array(c)) for a, b, c in pairs if c is not None]
    result["nees"]["landmarks"], result["nees"]["landmark_pairs"] = nees(errors), len(errors)


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


def score_landmarks(run, first_frame, result):
    owner, errors = owners(run["iterations"])
    observed = {i for iteration in run["iterations"] for i in iteration["identities"] if i != -1}
    mapped = [m["id"] for m in run["online"] if m["status"] == "mapped"]
    owned = Counter(owner[i] for i in mapped if i in owner)
    result["association_errors"] = errors
    result["landmarks_true"] = len(observed)
    result["landmarks_duplicated"] = sum(count - 1 for count in owned.values())
    result["landmarks_missed"] = len(observed - set(owned))
    result["coverage"]["landmarks"] = 1 - result["landmarks_missed"] / len(observed) if observed else None
    result["landmarks_unmatched"] = sum(i not in owner for i in mapped)
    if run["landmarks"] is None:
        return
    result["moving"] = moving(run)
    truth, estimate = landmark_pairs(run["online"], owner, run["landmarks"])
    result["landmark_pairs"] = len(truth)
    if first_frame is not None:
        result["landmark_rmse_m"]["first_pose"] = rmse(truth, estimate, *first_frame)
    result["landmark_rmse_m"]["aligned"] = aligned_rmse(truth, estimate)
    if run["refined"] is not None:
        result["landmark_rmse_m"]["final_aligned"] = aligned_rmse(*landmark_pairs(run["refined"], owner, run["landmarks"]))
        score_landmark_nees(run, owner, result)


def parts_of(run):
    """Which part of the map each frame with a pose is in, and what that comes to."""
    final = dict(run["joined"])
    number, raw, frames, last = 0, {}, {}, 0
    for index, i in enumerate(run["iterations"]):
        if i["estimate"] is None:
            continue
        number = number if i["map_epoch"] is None else i["map_epoch"]
        raw[index] = number
        frames.setdefault(final.get(number, number), []).append(index)
        last = final.get(number, number)
    scored = max(frames, key=lambda part: (len(frames[part]), -frames[part][0])) if frames else 0
    return {"frames": frames, "scored": scored, "last": last, "restarts": max(len(set(raw.values())) - 1, 0)}


def pairs_of(run, parts, part):
    return [run["iterations"][i] for i in parts["frames"].get(part, []) if run["iterations"][i]["truth"]]


def first_pose_frame(pairs):
    if not pairs:
        return None
    truth, estimate = pairs[0]["truth"], pairs[0]["estimate"]
    r = rotation(truth[3:]) @ rotation(estimate[3:]).T
    return r, np.array(truth[:3]) - r @ np.array(estimate[:3])


def poses_of(pairs, side):
    return [paths.pose(i[side][:3], rotation(i[side][3:])) for i in pairs]


def dropped_associations(run):
    if not run["has_identities"] or not run["online"]:
        return None, False
    there = {m["id"] for m in run["online"]}
    given = [a for i in run["iterations"] for a in i["associations"] if a != -1]
    dropped = sum(a not in there for a in given)
    return dropped, 2 * dropped > len(given)


def score_parts(run, parts, result):
    n = len(run["iterations"])
    scored = parts["frames"].get(parts["scored"], [])
    others = sum(len(f) for f in parts["frames"].values()) - len(scored)
    ends = parts["last"] == parts["scored"]
    result["coverage"]["poses"] = len(scored) / n if n else None
    result["parts"] = {"count": len(parts["frames"]), "restarts": parts["restarts"], "scored_iterations": len(scored),
                       "other_iterations": others, "ends_in_scored": ends}
    result["associations_dropped"], forgotten = dropped_associations(run)
    lost = n > 0 and (forgotten or len(scored) < n / 2 or others > n / 20 or not ends or
                      (n - 1 - scored[-1] if scored else n - 1) * 10 >= n)
    pairs = pairs_of(run, parts, parts["scored"])
    truth, estimate = poses_of(pairs, "truth"), poses_of(pairs, "estimate")
    found = paths.divergence(truth, estimate, [i["truth"][:3] for i in run["iterations"] if i["truth"]], True, noise_m=run["noise_m"])
    if found is None:
        result["verdict"] = "lost" if lost else None
    else:
        limit, worst_m, worst_deg, first = found
        at = None if first is None else [i for i in scored if run["iterations"][i]["truth"]][first]
        result["divergence"] = {"position_limit_m": limit, "position_worst_m": worst_m, "rotation_worst_deg": worst_deg,
                                "iteration": at}
        result["verdict"] = "diverged" if first is not None else "lost" if lost else "ok"
    along, last, sum_m = {}, None, 0.0
    for index, i in enumerate(run["iterations"]):
        if i["truth"]:
            if last is not None:
                sum_m += float(np.linalg.norm(np.array(i["truth"][:3]) - last))
            last = np.array(i["truth"][:3])
            along[index] = sum_m
    indices = [i for i in scored if run["iterations"][i]["truth"]]
    for name, unit, places in (("frame", "frames", indices), ("metre", "metres", [along[i] for i in indices]),
                               ("second", "seconds", [run["iterations"][i]["t_s"] for i in indices])):
        result["rpe"][name] = paths.relative_error(truth, estimate, places, 1.0, unit)


def score_trajectory(run, parts, result):
    pairs = [(i["truth"], i["estimate"]) for i in pairs_of(run, parts, parts["scored"])]
    result["position_pairs"] = len(pairs)
    if not pairs:
        return
    truth, estimate = [np.array(a[:3]) for a, _ in pairs], [np.array(b[:3]) for _, b in pairs]
    truth_r, estimate_r = [rotation(a[3:]) for a, _ in pairs], [rotation(b[3:]) for _, b in pairs]
    r = truth_r[0] @ estimate_r[0].T
    t = truth[0] - r @ estimate[0]
    result["position_rmse_m"].update({"first_pose": rmse(truth, estimate, r, t), "aligned": aligned_rmse(truth, estimate)})
    result["position_final_m"] = float(np.linalg.norm(truth[-1] - (r @ estimate[-1] + t)))
    u, _, vt = np.linalg.svd(sum(a @ b.T for a, b in zip(truth_r, estimate_r)))
    mean = u @ np.diag([1, 1, np.sign(np.linalg.det(u @ vt))]) @ vt
    result["rotation_rmse_deg"] = {"first_pose": rotation_rmse(truth_r, estimate_r, r),
                                   "aligned": rotation_rmse(truth_r, estimate_r, mean)}


def evaluate(run):
    iterations = run["iterations"]
    result = {
        "schema": "hallway.metrics/1",
        "iterations": len(iterations),
        "lost_iterations": sum(i["estimate"] is None for i in iterations),
        "verdict": None,
        "coverage": {"poses": None, "landmarks": None, "walls": None},
        "parts": None,
        "divergence": None,
        "observations": sum(len(i["associations"]) for i in iterations),
        "associations_none": sum(i["associations"].count(-1) for i in iterations),
        "association_errors": None,
        "associations_dropped": None,
        "landmarks_true": None,
        "landmarks_mapped": sum(m["status"] == "mapped" for m in run["online"]),
        "landmarks_duplicated": None,
        "landmarks_missed": None,
        "landmarks_unmatched": None,
        "moving": None,
        "landmark_pairs": 0,
        "landmark_rmse_m": {"first_pose": None, "aligned": None, "final_aligned": None},
        "position_rmse_m": {"first_pose": None, "aligned": None, "refitted_aligned": None},
        "position_refitted_pairs": 0,
        "position_final_m": None,
        "rotation_rmse_deg": {"first_pose": None, "aligned": None},
        "rpe": {},
        "nees": {"landmarks": None, "landmark_pairs": 0, "poses": None, "pose_pairs": 0},
        "planes": None,
        "iteration_ms": summary([i["wall_ms"] for i in iterations if i["wall_ms"] is not None]),
        "iteration_cpu_ms": summary([i["cpu_ms"] for i in iterations if i["cpu_ms"] is not None]),
    }
    parts = parts_of(run)
    score_parts(run, parts, result)
    score_trajectory(run, parts, result)
    score_refitted(run, result)
    score_pose_nees(run, parts, result)
    if run["has_identities"]:
        score_landmarks(run, first_pose_frame(pairs_of(run, parts, parts["last"])), result)
    return result


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        runs = json.load(file)
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        json.dump([evaluate(run) for run in runs], file)


if __name__ == "__main__":
    main()
