#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the maps of this folder, one for each behaviour, and their list in README.md.

    make_regress_maps.py            writes them
    make_regress_maps.py --check    exit status 1 if a file differs from what this script writes, or is not written by it

A map is a function: its name is the file's, its first line the line in README.md. Units are centimetres unless it says otherwise.
"""
import math
import pathlib
import sys

sys.dont_write_bytecode = True
FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent))
from make_maps import HEADER, block, entity, face, prism  # noqa: E402

MAPS = {}
X, Y, Z = (0, 400), (0, 300), (0, 250)  # of the usual room
WALL = 16


def regress(function):
    MAPS[function.__name__] = function
    return function


def walls(x=X, y=Y, z=Z, thick=WALL, without=()):
    """Floor and ceiling over all, -x and +x over -y and +y, each its own material."""
    (x0, x1), (y0, y1), (z0, z1), t = x, y, z, thick
    named = {"floor": ((x0 - t, x1 + t), (y0 - t, y1 + t), (z0 - t, z0)),
             "ceiling": ((x0 - t, x1 + t), (y0 - t, y1 + t), (z1, z1 + t)),
             "west": ((x0 - t, x0), (y0 - t, y1 + t), (z0, z1)), "east": ((x1, x1 + t), (y0 - t, y1 + t), (z0, z1)),
             "south": ((x0, x1), (y0 - t, y0), (z0, z1)), "north": ((x0, x1), (y1, y1 + t), (z0, z1))}
    return [block(*box, name) for name, box in named.items() if name not in without]


def east_with_hole(y, z, material="east"):
    """The wall +x of the usual room around a hole."""
    x = (X[1], X[1] + WALL)
    parts = [((Y[0] - WALL, y[0]), Z), ((y[1], Y[1] + WALL), Z), (y, (Z[0], z[0])), (y, (z[1], Z[1]))]
    return [block(x, py, pz, material) for py, pz in parts if py[1] > py[0] and pz[1] > pz[0]]


def start(origin=(200, 150, 80)):
    return entity({"classname": "hw_robot_start", "origin": " ".join(str(v) for v in origin), "angle": "0"})


def of_class(classname, brushes, **keys):
    return entity({"classname": classname, **keys}, brushes)


def subtract(*brushes, order=0):
    return of_class("hw_subtract", brushes, order=str(order))


def add(*brushes, order=0):
    return of_class("hw_add", brushes, order=str(order))


def world(brushes=(), *others, scale="0.01"):
    lines = list(HEADER)
    lines += entity({"classname": "worldspawn", "mapversion": "220", "_hallway": "1", "_scale": scale}, brushes)
    for other in others:
        lines += other
    return lines


def slanted_column(top, material):
    """The ground below a triangle of points, counter-clockwise from above."""
    (p, q, r), low = top, 0
    lines = ["{", face([p, r, q], material, (1, 0, 0), (0, -1, 0)),
             face([(*p[:2], low), (*q[:2], low), (*r[:2], low)], material, (1, 0, 0), (0, -1, 0))]
    for a, b in ((p, q), (q, r), (r, p)):
        lines.append(face([(*a[:2], low), a, (*b[:2], low)], material, (1, 0, 0), (0, 0, -1)))
    return lines + ["}"]


def renamed(brush, old, new):
    return [line.replace(f") {old} [", f") {new} [") for line in brush]


# ---- leaks ----------------------------------------------------------------------------------------------------------

@regress
def leak_missing_wall():
    """a room without its wall at +x"""
    return world(walls(without=("east",)), start())


@regress
def leak_gap_1mm():
    """a gap of 1 mm from floor to ceiling in the wall at +x"""
    return world(walls(without=("east",)) + east_with_hole((150, 150.1), Z), start())


@regress
def leak_diagonal_corner():
    """two walls whose corners are 1 mm apart along x and along y"""
    brushes = walls(without=("east", "north", "floor", "ceiling"))
    brushes += [block((400.1, 416), (-16, 300), Z, "east"), block((-16, 400), (300.1, 316), Z, "north")]
    brushes += [block((-40, 440), (-40, 340), (-16, 0), "floor"), block((-40, 440), (-40, 340), (250, 266), "ceiling")]
    return world(brushes, start())


@regress
def leak_open_door():
    """a doorway of 90 x 200 cm that leads into the void"""
    return world(walls(without=("east",)) + east_with_hole((105, 195), (0, 200)), start())


@regress
def leak_ceiling_hole():
    """a skylight of 40 x 60 cm without glass"""
    brushes = walls(without=("ceiling",))
    for x, y in (((-16, 180), (-16, 316)), ((220, 416), (-16, 316)), ((180, 220), (-16, 120)), ((180, 220), (180, 316))):
        brushes.append(block(x, y, (250, 266), "ceiling"))
    return world(brushes, start())


@regress
def leak_pinhole():
    """a hole of 1 x 1 mm"""
    return world(walls(without=("east",)) + east_with_hole((150, 150.1), (80, 80.1)), start())


@regress
def leak_under_a_door():
    """a slit of 5 mm between floor and wall"""
    return world(walls(without=("east",)) + east_with_hole((105, 195), (0, 0.5)), start())


@regress
def leak_behind_detail():
    """a wall of detail stops robots, but does not seal the map"""
    return world(walls(without=("east",)), of_class("hw_detail", [block((400, 416), (-16, 316), Z, "east")]), start())


@regress
def leak_subtracted_hole():
    """a window of 20 x 50 cm cut through the wall by hw_subtract"""
    return world(walls(), subtract(block((390, 430), (140, 160), (100, 150), "cut")), start())


@regress
def leak_func_door():
    """a doorway closed by a func_door: doors move, so they are not part of the world"""
    return world(walls(without=("east",)) + east_with_hole((105, 195), (0, 200)),
                 of_class("func_door", [block((400, 416), (105, 195), (0, 200), "door")]), start())


@regress
def leak_light_outside():
    """a closed room, and a light outside of it"""
    return world(walls(), start(), entity({"classname": "light", "origin": "600 150 80", "light": "300"}))


@regress
def leak_one_room_of_two():
    """two rooms with a wall between; the one with the light is open"""
    return world(walls(without=("east",)) + [block((190, 210), Y, Z, "between")] + east_with_hole((105, 195), (0, 200)),
                 start((100, 150, 80)), entity({"classname": "light", "origin": "300 150 80"}))


# ---- closed ---------------------------------------------------------------------------------------------------------

@regress
def sealed_room():
    """six walls"""
    return world(walls(), start())


@regress
def sealed_touching_edges():
    """walls that meet in their edges only"""
    brushes = [block(X, Y, (-16, 0), "floor"), block(X, Y, (250, 266), "ceiling"), block((-16, 0), Y, Z, "west"),
               block((400, 416), Y, Z, "east"), block(X, (-16, 0), Z, "south"), block(X, (300, 316), Z, "north")]
    return world(brushes, start())


@regress
def sealed_crack_tenth_mm():
    """a gap of 0.1 mm, as left by rounded coordinates, counts as closed"""
    return world(walls(without=("east",)) + east_with_hole((150, 150.01), Z), start())


@regress
def sealed_by_sky():
    """a ceiling of sky is solid"""
    brushes = walls(without=("ceiling",)) + [block((-16, 416), (-16, 316), (250, 266), "sky1")]
    return world(brushes, start())


@regress
def sealed_empty_room_open():
    """an open room without an occupant, beside a closed one"""
    return world(walls(without=("east",)) + [block((190, 210), Y, Z, "between")] + east_with_hole((105, 195), (0, 200)),
                 start((100, 150, 80)))


@regress
def sealed_by_func_group():
    """a wall in a func_group"""
    return world(walls(without=("east",)), of_class("func_group", [block((400, 416), (-16, 316), Z, "east")]), start())


# ---- addition and subtraction ---------------------------------------------------------------------------------------

@regress
def coplanar_later_owns():
    """two slabs whose tops coincide where they overlap: the later one owns the common part"""
    return world([block((0, 200), (0, 100), (0, 50), "first"), block((100, 300), (0, 100), (0, 50), "second")])


@regress
def coplanar_same_material():
    """two slabs side by side, of one material: no face remains between them"""
    return world([block((0, 100), (0, 100), (0, 50), "stone"), block((100, 200), (0, 100), (0, 50), "stone")])


@regress
def duplicate_brush():
    """the same brush twice"""
    return world([block((0, 100), (0, 100), (0, 100), "first"), block((0, 100), (0, 100), (0, 100), "second")])


@regress
def overlapping_brushes():
    """two blocks that cross each other"""
    return world([block((0, 300), (100, 200), (0, 100), "along"), block((100, 200), (0, 300), (20, 80), "across")])


@regress
def brush_inside_brush():
    """a block within a block is not visible"""
    return world([block((0, 90), (0, 90), (0, 90), "outer"), block((30, 60), (30, 60), (30, 60), "inner")])


@regress
def touching_corner():
    """two cubes that share one corner"""
    return world([block((0, 50), (0, 50), (0, 50), "low"), block((50, 100), (50, 100), (50, 100), "high")])


@regress
def touching_edge():
    """two cubes that share one edge"""
    return world([block((0, 50), (0, 50), (0, 50), "left"), block((50, 100), (50, 100), (0, 50), "right")])


@regress
def subtract_through():
    """a tunnel through a block"""
    return world([block((0, 90), (0, 90), (0, 90), "rock")], subtract(block((-10, 100), (30, 60), (30, 60), "bore")))


@regress
def subtract_crossing():
    """three tunnels through a block, which meet in its middle"""
    return world([block((0, 90), (0, 90), (0, 90), "rock")],
                 subtract(block((-10, 100), (30, 60), (30, 60), "bore"), block((30, 60), (-10, 100), (30, 60), "bore"),
                          block((30, 60), (30, 60), (-10, 100), "bore")))


@regress
def subtract_order():
    """a post added after the cut remains, a post added before is cut off"""
    return world([block((0, 100), (0, 100), (0, 100), "rock")],
                 add(block((60, 80), (60, 80), (0, 200), "late"), order=3),
                 subtract(block((0, 100), (0, 100), (50, 250), "cut"), order=2),
                 add(block((20, 40), (20, 40), (0, 200), "early"), order=1))


@regress
def subtract_ties():
    """brushes of equal `order` apply in the order of the file"""
    return world([], add(block((0, 50), (0, 50), (0, 50), "gone"), order=1),
                 subtract(block((0, 100), (0, 50), (0, 50), "cut"), order=1),
                 add(block((60, 90), (0, 50), (0, 50), "stays"), order=1))


@regress
def subtract_misses():
    """an hw_subtract that touches a block from outside removes nothing; as the later brush it owns the common face"""
    return world([block((0, 50), (0, 50), (0, 50), "rock")], subtract(block((50, 90), (0, 50), (0, 50), "cut")))


@regress
def nested_rooms():
    """a block, a room in it, a block in that, a room in that"""
    return world([block((-300, 300), (-300, 300), (-300, 300), "shell")],
                 subtract(block((-250, 250), (-250, 250), (-250, 250), "hall"), order=1),
                 add(block((-150, 150), (-150, 150), (-150, 150), "vault"), order=2),
                 subtract(block((-100, 100), (-100, 100), (-100, 100), "chamber"), order=3), start((0, 0, 0)))


@regress
def room_in_a_block():
    """a room cut out of a solid block"""
    return world([block((-16, 416), (-16, 316), (-16, 266), "rock")], subtract(block(X, Y, Z, "plaster")), start())


# ---- shapes ---------------------------------------------------------------------------------------------------------

@regress
def t_junction_floor():
    """small tiles along a large one: their corners are on its edge"""
    brushes = [block((0, 400), (0, 100), (-10, 0), "large")]
    brushes += [block((x, x + 100), (100, 150), (-10, 0), "small") for x in range(0, 400, 100)]
    return world(brushes)


@regress
def sliver_1e6():
    """a film of 0.000001 units is too thin to be a brush, a foil of 0.001 units is a brush"""
    return world([block((0, 100), (0, 100), (0, 50), "left"), block((0, 100), (0, 100), (50, 50.000001), "film"),
                  block((200, 300), (0, 100), (0, 0.001), "foil")])


@regress
def slanted_columns():
    """hilly ground of columns whose sides are one plane except for the rounding of their corners"""
    cells, at = 6, lambda i: round(X[0] + i * (X[1] - X[0]) / 7.3, 6)
    height = lambda i, j: round(40 + 20 * math.sin(1.7 * i) * math.cos(1.3 * j), 6)
    corner = lambda i, j: (at(i), at(j) * 0.6, height(i, j))
    brushes = []
    for i in range(cells):
        for j in range(cells):
            a, b, c, d = corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)
            for triangle in ((a, b, c), (a, c, d)):
                brushes.append(slanted_column(triangle, "ground"))
    return world(walls() + brushes, start((200, 150, 120)))


@regress
def thin_wall_1mm():
    """a wall of 1 mm between two halves of a room"""
    return world(walls() + [block((200, 200.1), Y, Z, "sheet")], start((100, 150, 80)),
                 entity({"classname": "light", "origin": "300 150 80"}))


@regress
def stairs():
    """ten steps of 20 x 15 cm"""
    return world(walls() + [block((100 + 20 * i, 300), (100, 200), (15 * i, 15 * i + 15), "step") for i in range(10)],
                 start((50, 150, 80)))


@regress
def arch():
    """a passage below an arch of sixteen segments"""
    brushes, radius = [], 100
    for i in range(16):
        a, b = (round(radius * math.cos(math.pi * k / 16), 3) for k in (i, i + 1))
        c, d = (round(radius * math.sin(math.pi * k / 16), 3) for k in (i, i + 1))
        left, right, low = 150 + min(a, b), 150 + max(a, b), (c, d)
        at_left, at_right = (low[0], low[1]) if a < b else (low[1], low[0])
        brushes.append(slab_over((190, 210), (left, right), (at_left, at_right), 250))
    brushes += [block((190, 210), (0, 50), Z, "arch"), block((190, 210), (250, 300), Z, "arch")]
    return world(walls() + brushes, start((100, 150, 80)), entity({"classname": "light", "origin": "300 150 80"}))


def slab_over(x, y, low, high):
    """What lies between a slanted line, at height `low` over both ends of y, and `high`."""
    (x0, x1), (y0, y1), (z0, z1) = x, y, low
    m = "arch"
    return ["{", face([(x0, y0, high), (x1, y1, high), (x1, y0, high)], m, (1, 0, 0), (0, -1, 0)),
            face([(x0, y0, z0), (x1, y0, z0), (x1, y1, z1)], m, (1, 0, 0), (0, -1, 0)),
            face([(x0, y0, 0), (x0, y1, 0), (x0, y1, high)], m, (0, 1, 0), (0, 0, -1)),
            face([(x1, y0, 0), (x1, y0, high), (x1, y1, high)], m, (0, 1, 0), (0, 0, -1)),
            face([(x0, y0, 0), (x0, y0, high), (x1, y0, 0)], m, (1, 0, 0), (0, 0, -1)),
            face([(x0, y1, 0), (x1, y1, 0), (x0, y1, high)], m, (1, 0, 0), (0, 0, -1)), "}"]


@regress
def doorway():
    """two rooms and an opening of 90 x 200 cm between them"""
    wall = [block((190, 210), (0, 105), Z, "between"), block((190, 210), (195, 300), Z, "between"),
            block((190, 210), (105, 195), (200, 250), "between")]
    return world(walls() + wall, start((100, 150, 80)), entity({"classname": "light", "origin": "300 150 80"}))


@regress
def cylinder_362_sides():
    """a column of 362 sides"""
    corners = [(round(150 * math.cos(math.tau * i / 362), 4), round(150 * math.sin(math.tau * i / 362), 4))
               for i in range(362)]
    return world([prism(corners, 0, 200, "column")])


@regress
def pyramid():
    """four slanted faces and a floor that meet in points"""
    m, top = "stone", (50, 50, 80)
    base = [(0, 0, 0), (100, 0, 0), (100, 100, 0), (0, 100, 0)]
    sides = [face([a, top, b], m, (1, 0, 0), (0, -1, 0)) for a, b in zip(base, base[1:] + base[:1])]
    return world([["{", face(base[:3], m, (1, 0, 0), (0, -1, 0)), *sides, "}"]])


@regress
def rotated_room():
    """a closed room turned by 37 degrees, its coordinates rounded to 1/1000 unit"""
    c, s = math.cos(math.radians(37)), math.sin(math.radians(37))

    def turned(brush):
        x, y, z, material = brush
        corners = [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])]
        return prism([(round(c * a - s * b, 3), round(s * a + c * b, 3)) for a, b in corners], *z, material)
    x, y, z, t = (-200, 200), (-150, 150), Z, WALL
    boxes = [((x[0] - t, x[1] + t), (y[0] - t, y[1] + t), (-t, 0), "floor"),
             ((x[0] - t, x[1] + t), (y[0] - t, y[1] + t), (250, 250 + t), "ceiling"),
             ((x[0] - t, x[0]), (y[0] - t, y[1] + t), z, "west"), ((x[1], x[1] + t), (y[0] - t, y[1] + t), z, "east"),
             (x, (y[0] - t, y[0]), z, "south"), (x, (y[1], y[1] + t), z, "north")]
    return world([turned(box) for box in boxes], start((0, 0, 80)))


@regress
def decimal_coordinates():
    """a closed room whose walls are at tenths of a unit, which are not binary numbers"""
    return world(walls((0.1, 400.3), (0.7, 300.9), (0.2, 250.6), 16.1), start())


@regress
def far_from_origin():
    """a closed room 10 km from the origin"""
    o = 1000000
    return world(walls((o, o + 400), (-o, -o + 300), (o, o + 250)), start((o + 200, -o + 150, o + 80)))


@regress
def huge_coordinates():
    """a closed box with walls at the largest coordinates allowed"""
    edge = 16777216
    a, b = (-edge, edge), (-edge + 1000, edge - 1000)
    return world([block(a, a, (-edge, b[0]), "floor"), block(a, a, (b[1], edge), "ceiling"),
                  block((-edge, b[0]), a, b, "west"), block((b[1], edge), a, b, "east"),
                  block(b, (-edge, b[0]), b, "south"), block(b, (b[1], edge), b, "north")], start((0, 0, 0)))


# ---- brushes that are none ------------------------------------------------------------------------------------------

@regress
def bad_brush_left_out():
    """a brush that is open at its top, in a closed room"""
    broken = block((100, 200), (100, 200), (0, 100), "broken")
    del broken[1]
    return world(walls() + [broken], start())


@regress
def inverted_brush():
    """a brush whose faces look inward"""
    def flip(line):
        parts = line.split(") ", 3)
        return ") ".join([parts[0], parts[2], parts[1], parts[3]]) if line.startswith("(") else line
    return world(walls() + [[flip(line) for line in block((100, 200), (100, 200), (0, 100), "inside_out")]], start())


@regress
def parallel_planes():
    """a brush whose top lies below its floor"""
    x = y = (100, 200)
    above, below = block(x, y, (0, 50), "nothing"), block(x, y, (100, 150), "nothing")
    return world(walls() + [above[:2] + below[2:3] + above[3:]], start())


@regress
def duplicate_plane():
    """a brush with one face twice"""
    twice = block((100, 200), (100, 200), (0, 100), "twice")
    return world(walls() + [twice[:2] + twice[1:]], start())


@regress
def collinear_points():
    """a face whose three points lie on a line"""
    brush = block((100, 200), (100, 200), (0, 100), "flat")
    brush[1] = face([(100, 100, 100), (150, 100, 100), (200, 100, 100)], "flat", (1, 0, 0), (0, -1, 0))
    return world(walls() + [brush], start())


@regress
def beyond_coordinates():
    """a brush that reaches beyond the largest coordinate"""
    return world(walls() + [block((100, 20000000), (100, 200), (0, 100), "far")], start())


@regress
def redundant_plane():
    """a face that only touches its brush in an edge is no error and has no polygon"""
    brush = block((0, 100), (0, 100), (0, 100), "cube")
    brush.insert(-1, face([(100, 0, 100), (0, 0, 200), (100, 100, 100)], "extra", (1, 0, 0), (0, -1, 0)))
    return world([brush])


# ---- formats --------------------------------------------------------------------------------------------------------

def standard(line):
    """A face with the numbers of the Standard format in place of the axes."""
    if not line.startswith("("):
        return line
    points, rest = line[:line.rindex(") ") + 2], line[line.rindex(") ") + 2:]
    return f"{points}{rest.split()[0]} 0 0 0 1 1"


@regress
def standard_format():
    """a closed room in the Standard format"""
    lines = world([[standard(line) for line in brush] for brush in walls()], start())
    return [line.replace("// Format: Valve", "// Format: Standard") for line in lines if "mapversion" not in line]


@regress
def mixed_formats():
    """a closed room with every second face in the Standard format"""
    brushes = [[standard(line) if i % 2 else line for i, line in enumerate(brush)] for brush in walls()]
    return world(brushes, start())


@regress
def crlf_bom():
    """a closed room in a file with a byte order mark and CRLF line ends"""
    return ("\ufeff" + "\r\n".join(world(walls(), start())) + "\r\n").encode()


@regress
def empty():
    """a file of no bytes"""
    return b""


@regress
def no_worldspawn():
    """no worldspawn, so that a unit is 1/32 m: a block by hw_add alone"""
    return list(HEADER) + add(block((0, 64), (0, 64), (0, 64), "alone"))


@regress
def no_brushes():
    """a worldspawn without brushes"""
    return world([], start())


@regress
def cut_short():
    """a file that ends within a brush"""
    lines = world(walls(), start())
    return "\n".join(lines[:20]).encode()


# ---- what brushes are -----------------------------------------------------------------------------------------------

@regress
def liquid():
    """a pool: water is not part of the world"""
    return world(walls() + [block(X, Y, (0, 50), "*water1")], start())


@regress
def clip():
    """a clip brush stops only the players of a game"""
    return world(walls() + [block((100, 200), (100, 200), (0, 100), "clip")], start())


@regress
def trigger():
    """a trigger marks a region"""
    return world(walls(), of_class("trigger_once", [block((100, 200), (100, 200), (0, 100), "trigger")]), start())


@regress
def skip_faces():
    """a wall of `skip` is solid, and not drawn"""
    return world(walls(without=("east",)) + [block((400, 416), (-16, 316), Z, "skip")], start())


@regress
def func_detail():
    """a func_detail of other games is detail"""
    return world(walls(), of_class("func_detail", [block((100, 150), (100, 150), (0, 100), "crate")]), start())


@regress
def detail_pillar():
    """a pillar of detail occludes nothing in the visible sets"""
    return world(walls(), of_class("hw_detail", [block((180, 220), (130, 170), Z, "pillar")]), start((100, 150, 80)),
                 entity({"classname": "light", "origin": "300 150 80"}))


@regress
def structure_pillar():
    """the pillar of `detail_pillar.map` as structure"""
    return world(walls() + [block((180, 220), (130, 170), Z, "pillar")], start((100, 150, 80)),
                 entity({"classname": "light", "origin": "300 150 80"}))


@regress
def hint_split():
    """a hint across an empty room divides it into two clusters"""
    return world(walls() + [block((-8, 200), (-8, 308), (-8, 258), "hint")], start((100, 150, 80)))


@regress
def tb_layers_reordered():
    """the walls in TrenchBroom layers and groups, last layer first"""
    brushes = walls()
    layers = [of_class("func_group", brushes[i:i + 2], _tb_type="_tb_layer" if i < 4 else "_tb_group", _tb_name=f"part {i}",
                       _tb_id=str(9 - i)) for i in (4, 2, 0)]
    return world([], *layers, start())


# ---- what can be seen -----------------------------------------------------------------------------------------------

@regress
def two_rooms_one_window():
    """two rooms and a window of 40 x 40 cm between them"""
    wall = [block((190, 210), (0, 130), Z, "between"), block((190, 210), (170, 300), Z, "between"),
            block((190, 210), (130, 170), (0, 100), "between"), block((190, 210), (130, 170), (140, 250), "between")]
    return world(walls() + wall, start((100, 150, 80)), entity({"classname": "light", "origin": "300 150 80"}))


@regress
def dead_straight_corridor():
    """a corridor of 100 m with ten side rooms: one end sees the other"""
    brushes, rooms = [block((-16, 10016), (-616, 616), (-16, 266), "rock")], [block((0, 10000), (-100, 100), Z, "corridor")]
    for i in range(10):
        x = 500 + 1000 * i
        rooms += [block((x - 45, x + 45), (100, 120), (0, 200), "doorway"),
                  block((x - 200, x + 200), (120, 600), Z, "room")]
    return world(brushes, subtract(*rooms), start((100, 0, 80)), entity({"classname": "light", "origin": "9900 0 80"}))


@regress
def labyrinth_corner():
    """a passage around three corners: its ends do not see each other"""
    return world([block((-16, 1016), (-16, 1016), (-16, 266), "rock")],
                 subtract(block((0, 1000), (0, 100), Z, "first"), block((900, 1000), (100, 500), Z, "second"),
                          block((0, 1000), (500, 600), Z, "third"), block((0, 100), (600, 1000), Z, "fourth")),
                 start((50, 50, 80)), entity({"classname": "light", "origin": "50 950 80"}))


# ---- what stands in it ----------------------------------------------------------------------------------------------

@regress
def start_in_solid():
    """the robot starts inside a wall"""
    return world(walls(), start((408, 150, 80)))


@regress
def start_on_the_floor():
    """the robot starts at the height of the floor"""
    return world(walls(), start((200, 150, 0)))


@regress
def two_robot_starts():
    """two hw_robot_start"""
    return world(walls(), start((100, 150, 80)), start((300, 150, 80)))


@regress
def start_without_origin():
    """an hw_robot_start without an origin"""
    return world(walls(), entity({"classname": "hw_robot_start", "angle": "0"}))


def text_of(made):
    return made if isinstance(made, bytes) else ("\n".join(made) + "\n").encode()


def readme():
    lines = ["# Regression maps", "",
             "One small map for each behaviour of the compiler. `make_regress_maps.py` writes the maps and this page; a test compares them (`--check`).",
             "`tests/integration/regress_maps_test.cpp` checks for every map which points are solid, whether it is sealed, what is visible and what is reported.", "",
             "| map | content |", "|---|---|"]
    return lines + [f"| `{name}.map` | {function.__doc__} |" for name, function in sorted(MAPS.items())]


def main():
    files = {f"{name}.map": text_of(function()) for name, function in MAPS.items()}
    files["README.md"] = text_of(readme())
    stale = [path.name for path in FOLDER.glob("*.map") if path.name not in files]
    for name, content in files.items():
        path = FOLDER / name
        if "--check" not in sys.argv[1:]:
            path.write_bytes(content)
        elif not path.exists() or path.read_bytes() != content:
            stale.append(name)
    for name in stale:
        print(f"maps/regress/{name} is not what make_regress_maps.py writes", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
