#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the maps that are drawn by rule, figure_eight.map and office.map, and the office's model, beside this script.

    make_maps.py            writes them
    make_maps.py --check    exit status 1 if a file differs from what this script writes
"""
import json
import math
import pathlib
import struct
import sys
import zlib

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
# One solid block; rooms, doorways and the hall are cut out of it, then pillars, a ramp and furniture are put in.

HEIGHT = 270
DOOR_HEIGHT = 215
DOOR_HALF = 60   # of the opening in the wall
FRAME = 5        # width of a door frame
PROUD = 2        # how far a frame stands out of the wall
HALL = ((2420, 3620), (100, 1500), (-60, 390))


def room(x, y, z, floor, wall="wall_plaster"):
    """A box to be cut out: its faces become floor, ceiling and walls."""
    lines = prism([(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])], z[0], z[1], wall)
    lines[1] = lines[1].replace(f" {wall} ", " ceiling ")
    lines[2] = lines[2].replace(f" {wall} ", f" {floor} ")
    return lines


def rooms():
    z = (0, HEIGHT)
    brushes = [room((0, 2400), (700, 900), z, "floor_tile")]
    for x in ((0, 840), (860, 1690), (1710, 2400)):
        brushes.append(room(x, (0, 680), z, "floor_wood"))
    for x in ((0, 880), (900, 1690), (1710, 2400)):
        brushes.append(room(x, (920, 1600), z, "floor_wood"))
    return brushes


# Doorways: the wall's thickness along one axis, the middle of the opening along the other.
DOORS_ACROSS_Y = [(x, (680, 700)) for x in (300, 1300, 2200)] + [(x, (900, 920)) for x in (500, 1300, 2100)]
DOORS_ACROSS_X = [(340, (840, 860)), (1260, (880, 900)), (1260, (1690, 1710))]


def doorways():
    brushes = [room((x - DOOR_HALF, x + DOOR_HALF), y, (0, DOOR_HEIGHT), "threshold") for x, y in DOORS_ACROSS_Y]
    brushes += [room(x, (y - DOOR_HALF, y + DOOR_HALF), (0, DOOR_HEIGHT), "threshold") for y, x in DOORS_ACROSS_X]
    return brushes + [room((2400, 2420), (700, 900), (0, 240), "threshold")]


def door_frames():
    brushes = []
    top = (DOOR_HEIGHT - FRAME, DOOR_HEIGHT)
    for middle, wall in DOORS_ACROSS_Y + DOORS_ACROSS_X:
        across = (wall[0] - PROUD, wall[1] + PROUD)
        left, right = middle - DOOR_HALF, middle + DOOR_HALF
        for along, z in (((left, left + FRAME), (0, top[0])), ((right - FRAME, right), (0, top[0])), ((left, right), top)):
            flat = (along, across) if (middle, wall) in DOORS_ACROSS_Y else (across, along)
            brushes.append(block(*flat, z, "door_frame"))
    return brushes


def pillars():
    """Eight-sided pillars from floor to ceiling of the hall."""
    brushes = []
    for x in (2720, 3020, 3320):
        for y in (350, 580, 1020, 1250):
            corners = [(x + a, y + b) for a, b in ((30, -12), (30, 12), (12, 30), (-12, 30), (-30, 12), (-30, -12),
                                                   (-12, -30), (12, -30))]
            brushes.append(prism(corners, HALL[2][0], HALL[2][1], "pillar"))
    return brushes


def ramp():
    """From the corridor's floor down to the hall's, 4.8 m long."""
    (x0, x1), (y0, y1), (low, high) = (2420, 2900), (700, 900), (-60, 0)
    side = "ramp_side"
    return [["{",
             face([(x0, y0, high), (x0, y1, high), (x1, y1, low)], "ramp", (1, 0, 0), (0, -1, 0)),
             face([(x0, y0, low), (x1, y0, low), (x1, y1, low)], side, (1, 0, 0), (0, -1, 0)),
             face([(x0, y0, low), (x0, y1, low), (x0, y1, high)], side, (0, 1, 0), (0, 0, -1)),
             face([(x0, y0, low), (x0, y0, high), (x1, y0, low)], side, (1, 0, 0), (0, 0, -1)),
             face([(x0, y1, low), (x1, y1, low), (x0, y1, high)], side, (1, 0, 0), (0, 0, -1)),
             "}"]]


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
    for x, y in ((2560, 1360), (2560, 240)):  # benches in the hall
        brushes.append(block((x - 100, x + 100), (y - 25, y + 25), (-60, -15), "bench"))
    brushes.append(block((3290, 3370), (760, 840), (-60, 30), "plinth"))
    return brushes


def knot(around=96, across=10):
    """A trefoil knot as a tube, metres, y up: positions, normals, texture coordinates, triangles."""
    def centre(t):
        r = 0.24 + 0.10 * math.cos(3.0 * t)
        return (r * math.cos(2.0 * t), 0.45 + 0.12 * math.sin(3.0 * t), r * math.sin(2.0 * t))

    def unit(v):
        length = math.sqrt(sum(c * c for c in v))
        return tuple(c / length for c in v)

    def cross(a, b):
        return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])

    positions, normals, coordinates, triangles = [], [], [], []
    for i in range(around + 1):
        t = 2.0 * math.pi * (i % around) / around
        here, ahead = centre(t), centre(t + 1e-4)
        tangent = unit(tuple(b - a for a, b in zip(here, ahead)))
        side = unit(cross(tangent, (0.0, 1.0, 0.0)))
        up = cross(side, tangent)
        for j in range(across + 1):
            a = 2.0 * math.pi * (j % across) / across
            normal = tuple(math.cos(a) * s + math.sin(a) * u for s, u in zip(side, up))
            positions.append(tuple(c + 0.055 * n for c, n in zip(here, normal)))
            normals.append(normal)
            coordinates.append((12.0 * i / around, j / across))
    for i in range(around):
        for j in range(across):
            a, b = i * (across + 1) + j, (i + 1) * (across + 1) + j
            triangles += [(a, a + 1, b), (a + 1, b + 1, b)]
    return positions, normals, coordinates, triangles


def png(width, rows):
    """An RGB picture."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    raw = b"".join(b"\0" + bytes(row) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def sculpture():
    """The knot as a binary glTF with a striped texture."""
    positions, normals, coordinates, triangles = knot()
    stripes = [[c for x in range(16) for c in ((196, 138, 52) if x < 8 else (92, 64, 38))] for _ in range(4)]
    parts = [struct.pack(f"<{3 * len(positions)}f", *(c for p in positions for c in p)),
             struct.pack(f"<{3 * len(normals)}f", *(c for n in normals for c in n)),
             struct.pack(f"<{2 * len(coordinates)}f", *(c for t in coordinates for c in t)),
             struct.pack(f"<{3 * len(triangles)}H", *(c for t in triangles for c in t)), png(16, stripes)]
    views, offset = [], 0
    for part, target in zip(parts, (34962, 34962, 34962, 34963, None)):
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": len(part)})
        if target:
            views[-1]["target"] = target
        offset += (len(part) + 3) // 4 * 4
    data = b"".join(part.ljust((len(part) + 3) // 4 * 4, b"\0") for part in parts)
    rounded = struct.unpack(f"<{3 * len(positions)}f", parts[0])
    bounds = [[f(rounded[axis::3]) for axis in range(3)] for f in (min, max)]
    document = {
        "asset": {"version": "2.0", "generator": "make_maps.py"},
        "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "knot"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3,
                                    "material": 0}]}],
        "materials": [{"name": "bronze", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
                                                                  "metallicFactor": 0.2, "roughnessFactor": 0.6}}],
        "textures": [{"source": 0, "sampler": 0}], "samplers": [{"wrapS": 10497, "wrapT": 10497}],
        "images": [{"bufferView": 4, "mimeType": "image/png"}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3", "min": bounds[0],
             "max": bounds[1]},
            {"bufferView": 1, "componentType": 5126, "count": len(normals), "type": "VEC3"},
            {"bufferView": 2, "componentType": 5126, "count": len(coordinates), "type": "VEC2"},
            {"bufferView": 3, "componentType": 5123, "count": 3 * len(triangles), "type": "SCALAR"}],
        "bufferViews": views, "buffers": [{"byteLength": len(data)}]}
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    return (struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(data)) + struct.pack("<II", len(text), 0x4E4F534A) +
            text + struct.pack("<II", len(data), 0x004E4942) + data)


# The way down the ramp: its slope of 1 in 8 begins and ends within 1.5 m, in steps of less than 2 degrees.
SLOPE = ((2345, 80), (2395, 78.4375), (2445, 75.3125), (2495, 70.625), (2825, 29.375), (2875, 24.6875), (2925, 21.5625),
         (2975, 20))
WAY = (((1800, 760, 80), (300, 760, 80), (300, 340, 80), (1300, 340, 80), (1300, 1260, 80), (2100, 1260, 80),
        (2100, 840, 80)) + tuple((x, 840, z) for x, z in SLOPE) +
       ((3180, 840, 20), (3180, 1380, 20), (3430, 1380, 20), (3430, 220, 20), (3180, 220, 20), (3180, 760, 20)) +
       tuple((x, 760, z) for x, z in reversed(SLOPE)))


def office():
    lines = list(HEADER)
    lines += entity({"classname": "worldspawn", "mapversion": "220", "_hallway": "1", "_scale": "0.01",
                     "_points_per_m2": "1", "_point_seed": "1"},
                    [block((-40, 3660), (-40, 1640), (-120, 430), "concrete")])
    lines += entity({"classname": "hw_subtract", "order": "1", "targetname": "rooms"}, rooms())
    lines += entity({"classname": "hw_subtract", "order": "1", "targetname": "hall", "_points_per_m2": "1.5"},
                    [room(*HALL, "floor_stone", "wall_stone")])
    lines += entity({"classname": "hw_subtract", "order": "2", "targetname": "doorways"}, doorways())
    lines += entity({"classname": "hw_add", "order": "3", "targetname": "pillars_and_ramp"}, pillars() + ramp())
    lines += entity({"classname": "hw_detail", "order": "4", "targetname": "furniture"}, door_frames() + furniture())
    lines += entity({"classname": "hw_mesh", "model": "models/knot.glb", "origin": "3330 800 30", "angles": "0 30 0",
                     "_points_per_m2": "4"},
                    comment="a sculpture on the plinth in the middle of the hall")
    lines += entity({"classname": "hw_robot_start", "origin": "1800 760 80", "angle": "180"})
    lines += entity({"classname": "hw_path", "name": "round", "closed": "1", "corner_radius_m": "0.5"},
                    comment="west along the corridor, through the rooms, down the ramp, round the hall and back up")
    for index, place in enumerate(WAY):
        lines += entity({"classname": "hw_waypoint", "path": "round", "index": index, "origin": vector(place)})
    return lines


def main():
    stale = []
    files = [(name, ("\n".join(lines) + "\n").encode()) for name, lines in
             (("figure_eight.map", figure_eight()), ("office.map", office()))]
    files.append(("models/knot.glb", sculpture()))
    for name, content in files:
        path = FOLDER / name
        if "--check" not in sys.argv[1:]:
            path.parent.mkdir(exist_ok=True)
            path.write_bytes(content)
        elif not path.exists() or path.read_bytes() != content:
            stale.append(name)
    for name in stale:
        print(f"maps/{name} is not what maps/make_maps.py writes", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
