# SPDX-License-Identifier: MIT
"""How near the body of a robot, a cylinder, comes to what is solid in its run's map: from the text of the map and the files of its models, in double precision.

Brushes become convex pieces: planes, of which those that subtract leave what is outside of them. Pieces become triangles, and with those of the models each
is cut to the heights of the body, in its own frame, in closed form. Shares nothing with the program but the formats of files.

Usage: body_oracle.py FOLDER RADIUS LOW HIGH, the heights in the body's frame. Prints a JSON document."""
import csv
import json
import math
import os
import re
import struct
import sys
import xml.etree.ElementTree as ElementTree

import numpy as np

FAR = 1e7  # map units
BLOCK = 64  # poses that are looked at together
STRUCTURE = re.compile(r"worldspawn|func_group|func_wall|func_static|func_detail(?!_illusionary).*")
LEFT_OUT = re.compile(r"[*!].*|trigger|aaatrigger|origin|hint|hintskip|(|player|monster|weap|bot)clip|clip_.*|areaportal|antiportal|liquids/.*")
POINT = r"\(\s*(\S+)\s+(\S+)\s+(\S+)\s*\)"
FACE = re.compile(POINT + r"\s*" + POINT + r"\s*" + POINT + r"\s*(\S+)")


def read_map(text):
    """Entities as (keys, brushes); a brush as (materials, planes): rows n, d of n·x <= d inside, in map units."""
    entities, depth = [], 0
    for line in text.splitlines():
        line = line.strip()
        if line.startswith("{"):
            depth += 1
            if depth == 1:
                entities.append(({}, []))
            else:
                entities[-1][1].append(([], []))
        elif line.startswith("}"):
            depth -= 1
        elif line.startswith('"'):
            key, value = re.match(r'"((?:[^"\\]|\\.)*)"\s*"(.*)"', line).groups()
            entities[-1][0][key] = value
        elif face := FACE.match(line):
            a, b, c = np.array([float(x) for x in face.groups()[:9]]).reshape(3, 3)
            n = np.cross(c - a, b - a)  # clockwise from outside
            n /= np.linalg.norm(n)
            entities[-1][1][-1][0].append(face.group(10))
            entities[-1][1][-1][1].append(np.append(n, n @ a))
    return entities


def outline(planes, i):
    """The face of a convex set in its i-th plane, as corners; empty where it has none."""
    n, d = planes[i][:3], planes[i][3]
    u = np.cross(n, np.eye(3)[np.argmin(abs(n))])
    u /= np.linalg.norm(u)
    v = np.cross(n, u)
    corners = [d * n + FAR * (s * u + t * v) for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    for j, plane in enumerate(planes):
        if j == i:
            continue
        sides = [plane[:3] @ p - plane[3] for p in corners]
        cut = []
        for k, p in enumerate(corners):
            q, here, there = corners[(k + 1) % len(corners)], sides[k], sides[(k + 1) % len(corners)]
            if here <= 0:
                cut.append(p)
            if here * there < 0:
                cut.append(p + (q - p) * (here / (here - there)))
        corners = cut
        if len(corners) < 3:
            return []
    return corners


def box_of(planes):
    """The corners of a convex set's box; None where it has no inside."""
    faces = [f for f in (outline(planes, i) for i in range(len(planes))) if f]
    if len(faces) < 4:
        return None
    points = np.array([p for f in faces for p in f])
    low, high = points.min(axis=0), points.max(axis=0)
    return (low, high) if (high - low).min() > 1e-7 else None


def pieces_of(entities):
    """What is solid, as convex sets (planes, box), in map units."""
    steps = [(-math.inf, True, brushes) for keys, brushes in entities if STRUCTURE.fullmatch(keys["classname"])]
    steps += [(int(keys.get("order", "0")), keys["classname"] != "hw_subtract", brushes) for keys, brushes in entities
              if keys["classname"] in ("hw_add", "hw_detail", "hw_subtract")]
    pieces = []
    for _, adds, brushes in sorted(steps, key=lambda step: step[0]):
        for materials, planes in brushes:
            if adds and any(LEFT_OUT.fullmatch(m.lower()) for m in materials):
                continue
            box = box_of(planes)
            if box is None:
                continue
            if adds:
                pieces.append((planes, box))
                continue
            left = []
            for piece, around in pieces:
                if (around[0] >= box[1]).any() or (around[1] <= box[0]).any():
                    left.append((piece, around))
                    continue
                inside = list(piece)
                for plane in planes:
                    outer = inside + [-plane]
                    if (outer_box := box_of(outer)) is not None:
                        left.append((outer, outer_box))
                    inside.append(plane)
            pieces = left
    return pieces


def rotation_about_z(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def glb_triangles(data):
    """Triangles of a binary glTF file, z up."""
    length = struct.unpack_from("<I", data, 12)[0]
    tree, binary = json.loads(data[20:20 + length]), data[28 + length:]

    def read(index):
        accessor = tree["accessors"][index]
        view = tree["bufferViews"][accessor["bufferView"]]
        kind = {5121: "u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}[accessor["componentType"]]
        width = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        size = np.dtype(kind).itemsize * width
        stride = view.get("byteStride", size)
        begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        rows = [binary[begin + stride * i:begin + stride * i + size] for i in range(accessor["count"])]
        return np.frombuffer(b"".join(rows), kind).reshape(-1, width)

    def walk(index, above):
        node = tree["nodes"][index]
        here = np.eye(4)
        if "matrix" in node:
            here = np.array(node["matrix"], float).reshape(4, 4).T
        else:
            x, y, z, w = node.get("rotation", [0, 0, 0, 1])
            here[:3, :3] = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]) * node.get("scale", [1, 1, 1])
            here[:3, 3] = node.get("translation", [0, 0, 0])
        here = above @ here
        for part in tree["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []:
            points = read(part["attributes"]["POSITION"]).astype(float) @ here[:3, :3].T + here[:3, 3]
            order = read(part["indices"]).ravel() if "indices" in part else np.arange(len(points))
            found.append(points[order].reshape(-1, 3, 3))
        for child in node.get("children", []):
            walk(child, here)

    found = []
    for root in tree["scenes"][tree.get("scene", 0)]["nodes"]:
        walk(root, np.eye(4))
    return np.concatenate(found) @ np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]).T


def dae_triangles(data):
    """Triangles of a COLLADA file with z up, in metres. Its decimals are rounded to single precision, in which models are read."""
    root = ElementTree.fromstring(data)
    space = root.tag[:root.tag.index("}") + 1]
    tagged = lambda node, *names: node.iterfind("/".join(space + name for name in names))
    assert next(tagged(root, "asset", "up_axis")).text == "Z_UP"
    metre = float(next(tagged(root, "asset", "unit")).get("meter"))
    named = {"#" + node.get("id"): node for node in root.iter() if node.get("id")}

    def geometry(node):
        for part in tagged(node, "mesh", "triangles"):
            inputs = list(tagged(part, "input"))
            stride = 1 + max(int(i.get("offset")) for i in inputs)
            vertex = next(i for i in inputs if i.get("semantic") == "VERTEX")
            source = next(i for i in tagged(named[vertex.get("source")], "input") if i.get("semantic") == "POSITION")
            points = np.array(next(tagged(named[source.get("source")], "float_array")).text.split(), np.float32).astype(float).reshape(-1, 3)
            for p in tagged(part, "p"):
                order = np.array(p.text.split(), int).reshape(-1, stride)[:, int(vertex.get("offset"))]
                yield points[order].reshape(-1, 3, 3)

    def walk(node, above):
        here = above
        for matrix in tagged(node, "matrix"):
            here = here @ np.array(matrix.text.split(), np.float32).astype(float).reshape(4, 4)
        for instance in tagged(node, "instance_geometry"):
            for triangles in geometry(named[instance.get("url")]):
                found.append(triangles @ here[:3, :3].T + here[:3, 3])
        for instance in tagged(node, "instance_node"):
            walk(named[instance.get("url")], here)
        for child in tagged(node, "node"):
            walk(child, here)

    found = []
    for scene in tagged(root, "library_visual_scenes", "visual_scene"):
        walk(scene, np.eye(4))
    return np.concatenate(found) * metre


def world_of(folder):
    """Convex pieces as (planes, low, high), and triangles of them and of models, in metres."""
    with open(os.path.join(folder, "map.map"), encoding="utf-8", errors="replace") as file:
        entities = read_map(file.read())
    scale = float(entities[0][0].get("_scale", 1 / 32))
    pieces, triangles = [], []
    for planes, box in pieces_of(entities):
        rows = np.array(planes)
        pieces.append((rows * [1, 1, 1, scale], box[0] * scale, box[1] * scale))
        for i in range(len(planes)):
            corners = outline(planes, i)
            triangles += [[corners[0], corners[k], corners[k + 1]] for k in range(1, len(corners) - 1)]
    triangles = [np.array(triangles) * scale]
    for keys, _ in entities:
        if keys["classname"] != "hw_mesh":
            continue
        assert not set(keys) & {"angles", "scale", "mangle"}, "a placement that this oracle does not know"
        with open(os.path.join(folder, keys["model"]), "rb") as file:
            data = file.read()
        model = glb_triangles(data) if keys["model"].endswith(".glb") else dae_triangles(data)
        origin = np.array(keys["origin"].split(), float) * scale
        triangles.append(model @ rotation_about_z(float(keys.get("angle", "0"))).T + origin)
    return pieces, np.concatenate(triangles)


def rotations(q):
    w, x, y, z = q.T
    return np.stack([np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], -1),
                     np.stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], -1),
                     np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], -1)], -2)


def to_axis(a, b):
    """Distance of segments in the level, (n, 2) each, to the origin."""
    ab = b - a
    length = (ab * ab).sum(-1)
    share = np.clip(-(a * ab).sum(-1) / np.where(length > 0, length, 1), 0, 1)
    return np.linalg.norm(a + share[:, None] * ab, axis=-1)


def distances(t, low, high):
    """Least distance to the z axis of the part of each triangle (n, 3, 3) that is between two heights; infinite where there is none."""
    least = np.full(len(t), math.inf)
    crossings = {low: [], high: []}
    for i in range(3):
        a, b = t[:, i], t[:, (i + 1) % 3]
        rise = b[:, 2] - a[:, 2]
        safe = np.where(rise != 0, rise, 1)
        first = np.where(rise != 0, np.minimum((low - a[:, 2]) / safe, (high - a[:, 2]) / safe), 0)
        last = np.where(rise != 0, np.maximum((low - a[:, 2]) / safe, (high - a[:, 2]) / safe), 1)
        first, last = np.maximum(first, 0), np.minimum(last, 1)
        level = (rise == 0) & ((a[:, 2] < low) | (a[:, 2] > high))
        on = (first <= last) & ~level
        ab = (b - a)[:, :2]
        reach = to_axis(a[:, :2] + first[:, None] * ab, a[:, :2] + last[:, None] * ab)
        least = np.where(on, np.minimum(least, reach), least)
        for height in crossings:
            share = (height - a[:, 2]) / safe
            crosses = (rise != 0) & (share >= 0) & (share <= 1)
            crossings[height].append((crosses, a[:, :2] + share[:, None] * ab))
    for ends in crossings.values():  # the lines in which the two heights cut the triangle
        for i, j in ((0, 1), (1, 2), (0, 2)):
            both = ends[i][0] & ends[j][0]
            least = np.where(both, np.minimum(least, to_axis(ends[i][1], ends[j][1])), least)
    # The axis passes through the triangle between the heights.
    n = np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0])
    turn = np.stack([t[:, i, 0] * t[:, (i + 1) % 3, 1] - t[:, i, 1] * t[:, (i + 1) % 3, 0] for i in range(3)], -1)
    around = ((turn >= 0).all(-1) | (turn <= 0).all(-1)) & (n[:, 2] != 0)
    z = (n * t[:, 0]).sum(-1) / np.where(n[:, 2] != 0, n[:, 2], 1)
    return np.where(around & (z >= low) & (z <= high), 0.0, least)


def look(position, q, pieces, triangles, radius, low, high):
    """The least gap, at which pose, and how many pairs of a pose and a triangle were looked at."""
    r = rotations(q / np.linalg.norm(q, axis=1)[:, None])
    reach = math.hypot(radius, max(abs(low), abs(high))) + 0.05
    t_low, t_high = triangles.min(axis=1), triangles.max(axis=1)
    least, where, looked = math.inf, -1, 0
    for begin in range(0, len(position), BLOCK):
        p, turn = position[begin:begin + BLOCK], r[begin:begin + BLOCK]
        near = np.flatnonzero((t_low <= p.max(axis=0) + reach).all(-1) & (t_high >= p.min(axis=0) - reach).all(-1))
        pose, which = np.nonzero(((t_low[near] <= p[:, None] + reach) & (t_high[near] >= p[:, None] - reach)).all(-1))
        looked += len(pose)
        if len(pose) > 0:
            inner = np.einsum("nba,nib->nia", turn[pose], triangles[near[which]] - p[pose][:, None])
            gaps = distances(inner, low, high) - radius
            if gaps.min() < least:
                least, where = gaps.min(), begin + pose[gaps.argmin()]
        centre = p + turn @ [0, 0, (low + high) / 2]
        for planes, piece_low, piece_high in pieces:
            if (piece_low > centre.max(axis=0)).any() or (piece_high < centre.min(axis=0)).any():
                continue
            inside = (centre @ planes[:, :3].T < planes[:, 3]).all(-1)
            if inside.any():
                least, where = -radius, begin + int(inside.argmax())
    return float(least), int(where), looked


def longest_stand(position, q):
    """The most frames in a row in which a robot moves by less than 1 cm and turns by less than 0.02 rad."""
    begin = longest = 0
    for k in range(len(position)):
        turned = 2 * math.acos(min(1.0, abs(q[k] @ q[begin])))
        if np.linalg.norm(position[k] - position[begin]) > 0.01 or turned > 0.02:
            begin = k
        longest = max(longest, k - begin)
    return longest


def main(folder, radius, low, high):
    with open(os.path.join(folder, "truth_poses.csv"), encoding="utf-8") as file:
        rows = [[float(row[c]) for c in ("x", "y", "z", "qw", "qx", "qy", "qz")] for row in csv.DictReader(file)]
    poses = np.array(rows)
    pieces, triangles = world_of(folder)
    gap, where, looked = look(poses[:, :3], poses[:, 3:], pieces, triangles, radius, low, high)
    print(json.dumps({"poses": len(poses), "pieces": len(pieces), "triangles": len(triangles), "looked_at": looked, "least_gap_m": gap,
                      "at_iteration": where, "longest_stand_frames": longest_stand(poses[:, :3], poses[:, 3:])}))


if __name__ == "__main__":
    main(sys.argv[1], *(float(a) for a in sys.argv[2:5]))
