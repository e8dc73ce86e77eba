#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""stereo_batch.py TABLE RUN: all poses and points of KITTI stereo points at once, as good as the images tell (docs/real-data.md).

TABLE is kitti_0022_obs3d.csv and RUN the folder of its replay, whose path is where this starts (python3 -B bench/real_data.py leaves one behind). Bundle
adjustment: the squares of what separates the image of each point in both eyes from where it was seen, 0.5 pixels wherever the point is, with a robust
loss (Cauchy's, squared after three steps); Gauss-Newton steps over all poses, points eliminated. Prints the ATE against the reference, as it stands and
without its motion in frames whose points are copies of those before. Takes minutes: the system is solved as a dense one."""
import csv
import pathlib
import sys

import numpy as np

from real_data import ate, chain, copied_frames, exponential, length, read_poses, step

SIGMA_PX = 0.5
LOSS_SIGMAS2 = 12.0  # squared, from which on a residual counts less
STEPS = 8


def read_table(path):
    """Frame, track, and image (u and v left, disparity) of each point, as arrays; and the camera: focal length, centre, base."""
    with open(path) as file:
        rows = list(csv.DictReader(file))
    frame, track = (np.array([int(row[name]) for row in rows]) for name in ("frame", "id"))
    x, y, z, u, v, u_right = (np.array([float(row[name]) for row in rows]) for name in ("x_right_m", "y_down_m", "z_fwd_m", "uL", "vL", "uR"))
    focal, centre_u = np.linalg.lstsq(np.column_stack([x / z, np.ones_like(z)]), u, rcond=None)[0]
    centre_v = (v - focal * y / z).mean()
    base = np.median(z * (u - u_right)) / focal
    return frame, track, np.column_stack([u, v, u - u_right]), np.column_stack([z, -x, -y]), (focal, centre_u, centre_v, base)


def skew(v):
    s = np.zeros((len(v), 3, 3))
    s[:, 0, 1], s[:, 0, 2], s[:, 1, 2] = -v[:, 2], v[:, 1], -v[:, 0]
    return s - s.transpose(0, 2, 1)


def sum_into(n, where, values):
    out = np.zeros((n,) + values.shape[1:])
    np.add.at(out, where, values)
    return out


def project(p, camera):
    """Images of points (x forward, y left, z up) and their derivatives."""
    focal, centre_u, centre_v, base = camera
    x = np.maximum(p[:, 0], 0.5)
    image = np.column_stack([centre_u - focal * p[:, 1] / x, centre_v - focal * p[:, 2] / x, focal * base / x])
    d = np.zeros((len(p), 3, 3))
    d[:, 0, 0], d[:, 0, 1] = focal * p[:, 1] / x**2, -focal / x
    d[:, 1, 0], d[:, 1, 2] = focal * p[:, 2] / x**2, -focal / x
    d[:, 2, 0] = -focal * base / x**2
    return image, d


def gauss_newton(rotations, places, points, frame, track, image, camera, squared_loss):
    n, landmarks = len(rotations), len(points)
    seen = np.einsum("mji,mj->mi", rotations[frame], points[track] - places[frame])
    predicted, derivative = project(seen, camera)
    residual, derivative = (predicted - image) / SIGMA_PX, derivative / SIGMA_PX
    weight = 1 / (1 + (residual**2).sum(1) / LOSS_SIGMAS2)
    weight = weight**2 if squared_loss else weight
    by_point = derivative @ rotations[frame].transpose(0, 2, 1)
    by_pose = np.concatenate([-derivative, derivative @ skew(seen)], 2)
    own = sum_into(landmarks, track, np.einsum("mai,maj,m->mij", by_point, by_point, weight)) + 1e-9 * np.eye(3)
    pull = sum_into(landmarks, track, np.einsum("mai,ma,m->mi", by_point, residual, weight))
    cross = np.einsum("mai,maj,m->mij", by_pose, by_point, weight)
    reduced = cross @ np.linalg.inv(own)[track]
    system = np.zeros((n, n, 6, 6))
    np.add.at(system, (frame, frame), np.einsum("mai,maj,m->mij", by_pose, by_pose, weight))
    order = np.argsort(track, kind="stable")
    for group in np.split(order, np.cumsum(np.bincount(track, minlength=landmarks))[:-1]):
        blocks = np.einsum("aij,bkj->abik", reduced[group], cross[group])
        np.subtract.at(system, (frame[group][:, None], frame[group][None, :]), blocks)
    gradient = sum_into(n, frame, np.einsum("mai,ma,m->mi", by_pose, residual, weight) - np.einsum("mij,mj->mi", reduced, pull[track]))
    flat = system.transpose(0, 2, 1, 3).reshape(6 * n, 6 * n)[6:, 6:]  # the first pose stays
    move = np.zeros((n, 6))
    move[1:] = -np.linalg.solve(flat + 1e-6 * np.eye(len(flat)), gradient.ravel()[6:]).reshape(n - 1, 6)
    points -= np.einsum("lij,lj->li", np.linalg.inv(own), pull + sum_into(landmarks, track, np.einsum("mij,mi->mj", cross, move[frame])))
    for i in range(n):
        places[i] += rotations[i] @ move[i, :3]
        rotations[i] = rotations[i] @ exponential(move[i, 3:])


def main():
    table, run = sys.argv[1], pathlib.Path(sys.argv[2])
    frame, track, image, seen, camera = read_table(table)
    truth, estimate = (read_poses(run / f"{kind}.tum") for kind in ("truth", "trajectory"))
    poses = [estimate[t] for t in truth]
    rotations, places = np.array([r for r, _ in poses]), np.array([t for _, t in poses])
    often = np.bincount(track)[track] > 1
    frame, image, seen = frame[often], image[often], seen[often]
    track = np.unique(track[often], return_inverse=True)[1]
    points = np.zeros((track.max() + 1, 3))
    for o in np.argsort(-seen[:, 0]):  # the nearest sighting is the best
        points[track[o]] = rotations[frame[o]] @ seen[o] + places[frame[o]]
    reference = list(truth.values())
    copies = copied_frames(table)
    steps = [step(a, b) for a, b in zip(reference, reference[1:])]
    still = chain([(np.eye(3), np.zeros(3)) if i in copies else s for i, s in enumerate(steps, 1)])
    for number in range(STEPS):
        gauss_newton(rotations, places, points, frame, track, image, camera, number > 2)
        found = list(zip(rotations, places))
        errors = ate(reference, found), ate(still, found)
        print(f"step {number + 1}: ATE {errors[0]:.1f} m ({100 * errors[0] / length(reference):.2f} %), without motion in copies "
              f"{errors[1]:.1f} m ({100 * errors[1] / length(still):.2f} %)", flush=True)
    print(f"the reference without motion in copies against itself as it stands: ATE {ate(reference, still):.1f} m")


if __name__ == "__main__":
    main()
