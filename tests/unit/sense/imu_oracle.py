# SPDX-License-Identifier: MIT
"""What a perfect IMU measures on the motions of test_motions.hpp.

Uses neither the acceleration nor the angular acceleration: with v the velocity of the sensor's place and R its orientation, integration by parts gives
the integral of R^T v' over an interval as the change of R^T v plus the integral of w x (R^T v), so jumps of v are in it by themselves. w is the vector of
R^T R', R' by the product rule. Quadrature: Gauss-Legendre with 24 nodes, on panels of at most 0.25 s between breaks.

Usage: imu_oracle.py OUT MOTION BEGIN_NS INTERVAL_NS COUNT GRAVITY X Y Z ROLL PITCH YAW: the mount as a lever arm [m] and angles [rad]. Writes a line for each
interval: mean angular rate, mean specific force, sensor frame."""
import sys

import numpy as np

PIECE_S = 0.3
RATES = (0.0, 2.0, 0.0, -4.0)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(24)


def turn(axis, angle):
    """Rotation about an axis, and its derivative by the angle."""
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    value, slope = np.eye(3), np.zeros((3, 3))
    value[i, i] = value[j, j] = np.cos(angle)
    value[j, i], value[i, j] = np.sin(angle), -np.sin(angle)
    slope[i, i] = slope[j, j] = -np.sin(angle)
    slope[j, i], slope[i, j] = np.cos(angle), -np.cos(angle)
    return value, slope


def wave(reach, rate, phase, t):
    return reach * np.sin(rate * t + phase), reach * rate * np.cos(rate * t + phase)


def attitude(yaw, pitch, roll):
    """Orientation and angular velocity from (angle, rate) of each."""
    (z, dz), (y, dy), (x, dx) = turn("z", yaw[0]), turn("y", pitch[0]), turn("x", roll[0])
    r = z @ y @ x
    slope = dz @ y @ x * yaw[1] + z @ dy @ x * pitch[1] + z @ y @ dx * roll[1]
    w = r.T @ slope
    return r, np.array([w[2, 1], w[0, 2], w[1, 0]])


def level(heading, rate, speed):
    r, w = attitude((heading, rate), (0, 0), (0, 0))
    return r, w, speed * np.array([np.cos(heading), np.sin(heading), 0])


def circle(t, piece):
    return level(0.5 * t, 0.5, 2.0)


def clothoid(t, piece):
    return level(0.3 * t + 0.4 * t**2, 0.3 + 0.8 * t, 1.5)


def waves(t, piece):
    r, w = attitude(wave(1.2, 0.8, 0.3, t), wave(0.3, 1.9, 0.0, t), wave(0.4, 2.9, 1.0, t))
    return r, w, np.array([wave(2.0, 0.7, 0.1, t)[1], wave(1.5, 1.1, 0.5, t)[1], wave(0.2, 2.3, 0.9, t)[1]])


def lines_and_arcs(t, piece):
    heading = PIECE_S * sum(RATES[i % 4] for i in range(piece))
    rate = RATES[piece % 4]
    return level(heading + rate * (t - piece * PIECE_S), rate, 1.0)


def means(motion, begin_ns, end_ns, gravity, arm, mount):
    """Of one interval; of a moment at a break the piece after it counts, at the begin and at the end."""
    piece_ns = round(1e9 * PIECE_S)
    cuts = [begin_ns] + [b for b in range(0, end_ns, piece_ns) if begin_ns < b < end_ns] + [end_ns]

    def state(t, piece):
        r, w, v = motion(t, piece)
        return r, w, r.T @ v + np.cross(w, arm)

    angular = np.zeros(3)
    force = state(1e-9 * end_ns, end_ns // piece_ns)[2] - state(1e-9 * begin_ns, begin_ns // piece_ns)[2]
    for low_ns, high_ns in zip(cuts, cuts[1:]):
        edges = np.linspace(1e-9 * low_ns, 1e-9 * high_ns, 2 + (high_ns - low_ns) // 250_000_000)
        for low, high in zip(edges, edges[1:]):
            for node, weight in zip(NODES, WEIGHTS):
                r, w, v = state((low + high) / 2 + node * (high - low) / 2, low_ns // piece_ns)
                angular += weight * (high - low) / 2 * w
                force += weight * (high - low) / 2 * (np.cross(w, v) + r.T @ [0, 0, gravity])
    duration = 1e-9 * (end_ns - begin_ns)
    return mount.T @ angular / duration, mount.T @ force / duration


def main(out, motion, begin_ns, interval_ns, count, gravity, x, y, z, roll, pitch, yaw):
    mount = turn("z", float(yaw))[0] @ turn("y", float(pitch))[0] @ turn("x", float(roll))[0]
    arm = np.array([float(x), float(y), float(z)])
    function = {f.__name__: f for f in (circle, clothoid, waves, lines_and_arcs)}[motion]
    with open(out, "w", encoding="utf-8") as file:
        for k in range(int(count)):
            begin = int(begin_ns) + k * int(interval_ns)
            both = means(function, begin, begin + int(interval_ns), float(gravity), arm, mount)
            file.write(" ".join(repr(float(value)) for value in np.concatenate(both)) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
