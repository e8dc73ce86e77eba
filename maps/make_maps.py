#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the office's model, models/knot.glb; and has what regress/make_regress_maps.py draws brushes with.

    make_maps.py            writes it
    make_maps.py --check    exit status 1 if the file differs from what this script writes
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


def main():
    path = FOLDER / "models" / "knot.glb"
    content = sculpture()
    if "--check" not in sys.argv[1:]:
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content)
    elif not path.exists() or path.read_bytes() != content:
        print("maps/models/knot.glb is not what maps/make_maps.py writes", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
