#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the maps that are drawn by rule: figure_eight.map and office.map, beside this script.

    make_maps.py            writes both
    make_maps.py --check    exit status 1 if a map differs from what this script writes
"""
import math
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
HEADER = ["// Game: Hallway", "// Format: Valve"]


def number(value):
    return str(int(value)) if float(value) == int(value) else repr(float(value))


def vector(values):
    return " ".join(number(v) for v in values)


def face(points, material, u_axis, v_axis):
    corners = " ".join(f"( {vector(p)} )" for p in points)
    return f"{corners} {material} [ {vector(u_axis)} 0 ] [ {vector(v_axis)} 0 ] 0 1 1"


def prism(corners, low, high, material):
    """A brush over a convex polygon of (x, y), counter-clockwise from above, from height `low` to `high`."""
    a, b, c = corners[:3]
    lines = ["{",
             face([(*a, high), (*c, high), (*b, high)], material, (1, 0, 0), (0, -1, 0)),
             face([(*a, low), (*b, low), (*c, low)], material, (1, 0, 0), (0, -1, 0))]
    for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1]):
        along = (1, 0, 0) if abs(bx - ax) >= abs(by - ay) else (0, 1, 0)
        lines.append(face([(ax, ay, low), (ax, ay, high), (bx, by, low)], material, along, (0, 0, -1)))
    return lines + ["}"]


def block(x, y, z, material):
    """An upright box, each of x, y, z a pair (low, high)."""
    return prism([(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])], z[0], z[1], material)


def entity(keys, brushes=(), comment=None):
    lines = [f"// {comment}"] if comment else []
    lines.append("{")
    lines += [f'"{key}" "{value}"' for key, value in keys.items()]
    for brush in brushes:
        lines += brush
    return lines + ["}"]


# ---- figure eight ---------------------------------------------------------------------------------------------------

LENGTH_M = 1145
RISE_M = 12
GROUND = -700  # top of the ground, centimetres


def lemniscate(steps):
    """(x, y, z, direction) in centimetres at `steps` places evenly along the ground plan, from the crossing on."""
    fine = 20000
    width = 2.0 * math.pi / fine
    lengths = [0.0]
    for i in range(fine):
        lengths.append(lengths[-1] + width / math.sqrt(1.0 + math.cos((i + 0.5) * width) ** 2))
    scale = 100.0 * LENGTH_M / lengths[-1]
    places, i = [], 0
    for step in range(steps):
        wanted = lengths[-1] * step / steps
        while lengths[i + 1] <= wanted:
            i += 1
        w = width * (i + (wanted - lengths[i]) / (lengths[i + 1] - lengths[i]))
        c, s = math.sin(w), -math.cos(w)
        q = 1.0 + s * s
        z = 100.0 * RISE_M * math.sin(math.pi * step / steps) ** 2
        places.append((scale * c / q, scale * c * s / q, z, math.atan2(1.0 - 3.0 * s * s, -s * (3.0 - s * s))))
    return places


def track(places):
    """A low strip on the ground below the path."""
    half, brushes = 220.0, []

    def edge(place, side):
        x, y, _, direction = place
        return (round(x - side * half * math.sin(direction)), round(y + side * half * math.cos(direction)))

    for here, there in zip(places, places[1:] + places[:1]):
        corners = [edge(here, -1), edge(there, -1), edge(there, 1), edge(here, 1)]
        brushes.append(prism(corners, GROUND, GROUND + 8, "track"))
    return brushes


def pylons(places):
    """Posts that reach up to just below the path, but not where the other branch of the path passes."""
    brushes = []
    for i, (x, y, z, _) in enumerate(places):
        others = [math.hypot(x - px, y - py) for j, (px, py, _, _) in enumerate(places)
                  if min(abs(i - j), len(places) - abs(i - j)) > 2]
        if i % 2 == 0 and min(others) > 1500:
            brushes.append(block((round(x) - 25, round(x) + 25), (round(y) - 25, round(y) + 25),
                                 (GROUND + 8, round(z) - 80), "pylon"))
    return brushes


def figure_eight():
    world = [block((-24000, 24000), (-11000, 11000), (GROUND - 100, GROUND), "ground")]
    world += track(lemniscate(96))
    world += pylons(lemniscate(80))
    for side in (-1, 1):  # low halls inside the loops, below every line of sight to a landmark
        for along, across, height, material in ((9200, -1300, 260, "hall"), (11800, 900, 330, "hall"),
                                                (14300, -900, 220, "depot"), (16600, 500, 180, "depot")):
            x, y = side * along, side * across
            world.append(block((x - 900, x + 900), (y - 600, y + 600), (GROUND, GROUND + height), material))
    lines = list(HEADER)
    lines += entity({"classname": "worldspawn", "mapversion": "220", "_hallway": "1", "_scale": "0.01"}, world)
    lines += entity({"classname": "hw_path", "name": "round", "shape": "lemniscate", "origin": "0 0 0", "angle": "315",
                     "length_m": LENGTH_M, "rise_m": RISE_M},
                    comment="starts at the crossing, heading right and down on the plan")
    lines += entity({"classname": "hw_robot_start", "origin": "0 0 0", "angle": "315"})
    lines += entity({"classname": "hw_landmark_cloud", "name": "around_the_path", "path": "round", "per_100m": "100",
                     "sideways_m": "15", "height_m": "5", "seed": "1"})
    return lines


# ---- office ---------------------------------------------------------------------------------------------------------

HEIGHT = 270
DOOR_HEIGHT = 215
DOOR_HALF = 60   # of the opening in the wall
FRAME = 5        # width of a door frame
PROUD = 2        # how far a frame stands out of the wall


def along_x(y):
    return lambda begin, end, z, material, grow=0: block((begin, end), (y[0] - grow, y[1] + grow), z, material)


def along_y(x):
    return lambda begin, end, z, material, grow=0: block((x[0] - grow, x[1] + grow), (begin, end), z, material)


def wall(make, begin, end, doors):
    """A wall from `begin` to `end` with framed openings centred at `doors`."""
    brushes, at = [], begin
    for door in doors:
        left, right = door - DOOR_HALF, door + DOOR_HALF
        brushes.append(make(at, left, (0, HEIGHT), "wall_plaster"))
        brushes.append(make(left, right, (DOOR_HEIGHT, HEIGHT), "wall_plaster"))
        brushes.append(make(left, left + FRAME, (0, DOOR_HEIGHT - FRAME), "door_frame", PROUD))
        brushes.append(make(right - FRAME, right, (0, DOOR_HEIGHT - FRAME), "door_frame", PROUD))
        brushes.append(make(left, right, (DOOR_HEIGHT - FRAME, DOOR_HEIGHT), "door_frame", PROUD))
        at = right
    brushes.append(make(at, end, (0, HEIGHT), "wall_plaster"))
    return brushes


def office_shell():
    brushes = [
        block((-20, 2420), (-20, 690), (-20, 0), "floor_wood"),
        block((-20, 2420), (690, 910), (-20, 0), "floor_tile"),
        block((-20, 2420), (910, 1620), (-20, 0), "floor_wood"),
        block((-20, 2420), (-20, 1620), (HEIGHT, HEIGHT + 20), "ceiling"),
        block((-20, 2420), (-20, 0), (0, HEIGHT), "wall_outer"),
        block((-20, 2420), (1600, 1620), (0, HEIGHT), "wall_outer"),
        block((-20, 0), (0, 1600), (0, HEIGHT), "wall_outer"),
        block((2400, 2420), (0, 1600), (0, HEIGHT), "wall_outer"),
    ]
    brushes += wall(along_x((680, 700)), 0, 2400, [300, 1300, 2200])   # corridor, south side
    brushes += wall(along_x((900, 920)), 0, 2400, [500, 1300, 2100])   # corridor, north side
    brushes += wall(along_y((840, 860)), 0, 680, [340])                # between the southern rooms
    brushes += wall(along_y((1690, 1710)), 0, 680, [])
    brushes += wall(along_y((880, 900)), 920, 1600, [1260])            # between the northern rooms
    brushes += wall(along_y((1690, 1710)), 920, 1600, [1260])
    return brushes


def table(x, y):
    """A table top on four legs."""
    brushes = [block(x, y, (70, 74), "desk")]
    for leg_x in (x[0] + 4, x[1] - 10):
        for leg_y in (y[0] + 4, y[1] - 10):
            brushes.append(block((leg_x, leg_x + 6), (leg_y, leg_y + 6), (0, 70), "desk_leg"))
    return brushes


def furniture():
    brushes = []
    for x, y in (((100, 260), (60, 140)), ((520, 680), (60, 140)), ((960, 1120), (60, 140)), ((1440, 1600), (60, 140)),
                 ((1840, 2000), (200, 280)), ((2160, 2320), (200, 280)), ((120, 280), (1340, 1420)),
                 ((480, 640), (1340, 1420)), ((1000, 1160), (1440, 1520)), ((1860, 2020), (1440, 1520))):
        brushes += table(x, y)
    for x, y, high in (((560, 720), (625, 675), 190), ((960, 1080), (630, 675), 120), ((1500, 1660), (620, 675), 190),
                       ((5, 55), (1000, 1200), 190), ((700, 860), (1545, 1595), 160), ((1280, 1480), (1550, 1595), 110),
                       ((2345, 2395), (1150, 1400), 190), ((1730, 1900), (5, 55), 190), ((2345, 2395), (430, 600), 120)):
        brushes.append(block(x, y, (0, high), "cabinet"))
    for x, y in ((600, 480), (1560, 420), (2000, 480), (320, 1180), (1040, 1060), (1560, 1440), (1860, 1080)):
        brushes.append(block((x - 15, x + 15), (y - 15, y + 15), (0, HEIGHT), "pillar"))
    return brushes


def office():
    lines = list(HEADER)
    lines += entity({"classname": "worldspawn", "mapversion": "220", "_hallway": "1", "_scale": "0.01",
                     "_points_per_m2": "1", "_point_seed": "1"}, office_shell())
    lines += entity({"classname": "func_group", "_tb_type": "_tb_group", "_tb_name": "furniture", "_tb_id": "1"},
                    furniture())
    lines += entity({"classname": "hw_robot_start", "origin": "1800 800 80", "angle": "180"})
    lines += entity({"classname": "hw_path", "name": "round", "closed": "1", "corner_radius_m": "0.6"},
                    comment="west along the corridor, back through the southern rooms, across it and through the northern")
    for index, (x, y) in enumerate(((1800, 800), (300, 800), (300, 340), (1300, 340), (1300, 1260), (2100, 1260),
                                    (2100, 800))):
        lines += entity({"classname": "hw_waypoint", "path": "round", "index": index, "origin": f"{x} {y} 80"})
    return lines


def main():
    stale = []
    for name, lines in (("figure_eight.map", figure_eight()), ("office.map", office())):
        text, path = "\n".join(lines) + "\n", FOLDER / name
        if "--check" not in sys.argv[1:]:
            path.write_text(text, encoding="utf-8", newline="\n")
        elif not path.exists() or path.read_text(encoding="utf-8") != text:
            stale.append(name)
    for name in stale:
        print(f"maps/{name} is not what maps/make_maps.py writes", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
