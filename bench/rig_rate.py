#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""rig_rate.py HALLWAY OUT [--steps 1010] [--rounds 3]: how many times faster than real time a robot with many sensors is simulated on one core, its log written.

The rig is that of maps/office_rig.toml (a lidar of 16 rings, an IMU, encoders, odometry, points for slam_point), then also with eight sonars at 20 Hz, cones of 30 degrees, as one ring and as
eight sensors, and five infrared detectors at 25 Hz. Rounds take turns; of each rig the median of the processor's time counts."""
import argparse
import os
import pathlib
import resource
import statistics
import subprocess

MAPS = pathlib.Path(__file__).resolve().parent.parent / "maps"
SONAR = """
[sensor.sonar{name}]
kind = "sonar"
rate_hz = 20
{heads}
head_radius_m = 0.25
max_range_m = 6
noise_m = 0.003
noise_per_m = 0.01
own_body = false
"""
INFRARED = """
[sensor.infrared{i}]
kind = "infrared"
preset = "ir_sharp"
position_m = [0, 0, -0.4]
yaw_deg = {yaw}
"""


def rigs():
    base = (MAPS / "office_rig.toml").read_text().replace('map = "office.map"', f'map = "{MAPS / "office.map"}"')
    infrared = "".join(INFRARED.format(i=i, yaw=45 * (i - 2)) for i in range(5))
    ring = SONAR.format(name="s", heads="pings = 8\nping_step_deg = 45")
    heads = "".join(SONAR.format(name=i, heads=f"yaw_deg = {45 * i}") for i in range(8))
    return {"office_rig.toml": base, "with a ring of eight sonars and five infrared": base + ring + infrared, "with eight sonars and five infrared": base + heads + infrared}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("hallway")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--steps", type=int, default=1010)
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    seconds = {name: [] for name in rigs()}
    for _ in range(arguments.rounds):
        for i, (name, text) in enumerate(rigs().items()):
            scenario = arguments.out / f"rig{i}.toml"
            scenario.write_text(text)
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            command = [arguments.hallway, "run", scenario, "--out", arguments.out / f"rig{i}", "--force", "--quiet", "--set", f"steps={arguments.steps}"]
            subprocess.run(command, check=True)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            seconds[name].append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    for name, times in seconds.items():
        median = statistics.median(times)
        print(f"{name}: {0.1 * arguments.steps:.0f} s in {median:.2f} s of a core, {0.1 * arguments.steps / median:.1f} times real time")


if __name__ == "__main__":
    main()
