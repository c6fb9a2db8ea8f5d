"""A town of 1 km: some hundred houses with rooms, doors, windows and furniture, and a flight from a street through one.

Deterministic. One sun; the sky is --env 0.5,0.6,0.8. Camera `flight` moves for 5 s, 120 frames at 24 a second; it starts
in the street at z = 0, goes in by the front door of the house at the town's middle, round by its back room, which has a
lamp and no window, and out by the garden door. Standard library only.
"""

import math
import random

from gltf_writer import Gltf
from part import Part, look_rotation, normalized, sub, turn_y

SIDE = 1000.0               # m
LOTS_X, LOTS_Z = 12, 12     # of the grid of streets
PITCH_X, PITCH_Z = 80.0, 80.0
WALL, STOREY = 0.25, 2.8    # m
SECONDS, FRAMES = 5.0, 120
SEED = 11


class House:
    """Walls of boxes that reach into each other; openings are gaps between them."""

    def __init__(self, width, depth):
        self.width, self.depth = width, depth
        self.walls, self.floors, self.wood = Part(), Part(), Part()

    def wall(self, start, end, base, openings=()):
        """A wall along x or z, from (x, z) to (x, z). `openings`: (middle in m from its start, width, sill, head)."""
        (ax, az), (bx, bz) = start, end
        along_x = az == bz
        length = bx - ax if along_x else bz - az
        low, high = base - 0.1, base + STOREY + 0.1  # ends inside the floors

        def piece(s0, s1, y0, y1):
            if s1 <= s0 or y1 <= y0:
                return
            if along_x:
                self.walls.box((ax + s0, y0, az - WALL / 2), (ax + s1, y1, az + WALL / 2))
            else:
                self.walls.box((ax - WALL / 2, y0, az + s0), (ax + WALL / 2, y1, az + s1))

        at = 0.0
        for middle, width, sill, head in sorted(openings):
            piece(at, middle - width / 2, low, high)
            piece(middle - width / 2, middle + width / 2, low, base + sill)
            piece(middle - width / 2, middle + width / 2, base + head, high)
            at = middle + width / 2
        piece(at, length, low, high)

    def slab(self, bottom, over=0.0):
        x, z = self.width / 2 + over, self.depth / 2 + over
        self.floors.box((-x, bottom, -z), (x, bottom + 0.25, z))

    def leg(self, x, z, base, height):
        self.wood.box((x - 0.02, base, z - 0.02), (x + 0.02, base + height, z + 0.02))

    def table(self, x, z, base):
        self.wood.box((x - 0.7, base + 0.7, z - 0.4), (x + 0.7, base + 0.75, z + 0.4))
        for sx in (-1, 1):
            for sz in (-1, 1):
                self.leg(x + sx * 0.64, z + sz * 0.34, base, 0.72)

    def chair(self, x, z, base):
        self.wood.box((x - 0.2, base + 0.42, z - 0.2), (x + 0.2, base + 0.46, z + 0.2))
        self.wood.box((x - 0.2, base + 0.44, z + 0.17), (x + 0.2, base + 0.9, z + 0.2))
        for sx in (-1, 1):
            for sz in (-1, 1):
                self.leg(x + sx * 0.17, z + sz * 0.17, base, 0.43)

    def shelf(self, x, z, base):
        self.wood.box((x - 0.5, base, z - 0.15), (x - 0.47, base + 1.8, z + 0.15))
        self.wood.box((x + 0.47, base, z - 0.15), (x + 0.5, base + 1.8, z + 0.15))
        for i in range(5):
            self.wood.box((x - 0.48, base + 0.05 + 0.42 * i, z - 0.14), (x + 0.48, base + 0.08 + 0.42 * i, z + 0.14))


DOOR = (0.0, 2.1)    # sill, head (m)
WINDOW = (0.9, 2.2)
GROUND_FLOOR = 0.25  # top of the lowest slab


def house(width, depth, storeys):
    """Front door at z = +depth / 2, a hall and two rooms on each floor; the back room at x < 0 has no window below."""
    h = House(width, depth)
    x, z = width / 2 - WALL / 2, depth / 2 - WALL / 2
    inset = 0.01  # walls along z end inside those along x
    for storey in range(storeys):
        base = GROUND_FLOOR + storey * (STOREY + 0.25)
        h.slab(base - 0.25, over=0.02 if storey == 0 else -0.02)
        windows = [(width * 0.2, 1.4, *WINDOW), (width * 0.8, 1.4, *WINDOW)]
        h.wall((-x, z), (x, z), base, [*windows, (x, 1.0, *(DOOR if storey == 0 else WINDOW))])
        back = [(width * 0.75, 0.9, *DOOR)] if storey == 0 else [(width * 0.2, 1.4, *WINDOW), (width * 0.8, 1.4, *WINDOW)]
        h.wall((-x, -z), (x, -z), base, back)
        for side in (-1, 1):
            openings = [(depth * 0.7, 1.2, *WINDOW)] + ([(depth * 0.2, 0.8, *WINDOW)] if side > 0 else [])
            h.wall((side * x, -z + inset), (side * x, z - inset), base, openings)
        # Front room and, behind it, two rooms with a door of 0.8 m between them.
        h.wall((-x + inset, 0), (x - inset, 0), base, [(width * 0.2, 0.9, *DOOR), (width * 0.75, 0.9, *DOOR)])
        h.wall((0, -z + inset), (0, -inset), base, [(depth * 0.25, 0.8, *DOOR)])
        h.table(-x * 0.55, z * 0.5, base)
        h.chair(-x * 0.55 + 0.3, z * 0.5 + 0.75, base)
        h.shelf(x * 0.55, z - 0.3, base)
        h.shelf(-x * 0.3, -z + 0.3, base)
        h.wood.box((x * 0.5, base, -2.2), (x * 0.9, base + 0.45, -0.2))  # bed
    top = GROUND_FLOOR + storeys * (STOREY + 0.25)
    h.slab(top - 0.25, over=0.3)
    # The roof: two slopes and gables, closed below by the slab.
    r, e = width / 2 + 0.3, depth / 2 + 0.3
    ridge = top + 0.35 * depth
    h.floors.quad((-r, top, e), (r, top, e), (r, ridge, 0), (-r, ridge, 0))
    h.floors.quad((r, top, -e), (-r, top, -e), (-r, ridge, 0), (r, ridge, 0))
    h.floors.triangle((r, top, e), (r, top, -e), (r, ridge, 0)).triangle((-r, top, -e), (-r, top, e), (-r, ridge, 0))
    return h


KINDS = ((10, 9, 1), (12, 10, 2), (9, 8, 2))  # width, depth (m), storeys
PAINTS = ((0.75, 0.72, 0.66), (0.7, 0.6, 0.45), (0.6, 0.62, 0.68))
VISITED = 1                                   # kind of the house of the flight


def town(instanced=True):
    """`instanced`: houses of one kind share their meshes; otherwise each has its own."""
    g = Gltf("town", 0.3)
    ground = g.material("ground", (0.35, 0.4, 0.3))
    road = g.material("road", (0.3, 0.3, 0.32))
    floor = g.material("floors and roofs", (0.55, 0.4, 0.32))
    wood = g.material("wood", (0.5, 0.36, 0.22))
    paints = [g.material("walls %d" % i, color) for i, color in enumerate(PAINTS)]
    h = SIDE / 2
    g.add("ground", Part().quad((-h, 0, h), (h, 0, h), (h, 0, -h), (-h, 0, -h)), ground)
    roads = Part()
    for i in range(LOTS_Z + 1):
        z = (i - LOTS_Z / 2) * PITCH_Z
        roads.quad((-h, 0.02, z + 4), (h, 0.02, z + 4), (h, 0.02, z - 4), (-h, 0.02, z - 4))
    for i in range(LOTS_X):
        x = (i - LOTS_X / 2) * PITCH_X + PITCH_X / 2
        roads.quad((x - 3, 0.03, h), (x + 3, 0.03, h), (x + 3, 0.03, -h), (x - 3, 0.03, -h))
    g.add("roads", roads, road)

    def mesh(kind, paint):
        built = house(*KINDS[kind])
        return g.mesh("house %d %d" % (kind, paint), (built.walls, paints[paint]), (built.floors, floor), (built.wood, wood))

    draw = random.Random(SEED).random  # its values are the same for all versions of Python
    known = {}
    for row in range(LOTS_Z):
        for column in range(LOTS_X):
            kind, paint, turn = (int(3 * draw()), int(3 * draw()), int(4 * draw()))
            x, z = (column - LOTS_X / 2) * PITCH_X, (row - LOTS_Z / 2) * PITCH_Z + PITCH_Z / 2
            x, z = x + 8 * (draw() - 0.5), z + 8 * (draw() - 0.5)
            if (row, column) == (LOTS_Z // 2 - 1, LOTS_X // 2):  # the one that is visited
                kind, paint, turn, x, z = VISITED, 0, 0, 0.0, -PITCH_Z / 2
            key = (kind, paint)
            if not instanced or key not in known:
                known[key] = mesh(*key)
            g.node("house %d" % (row * LOTS_X + column), mesh=known[key], translation=[round(x, 3), 0, round(z, 3)],
                   rotation=[round(v, 9) for v in turn_y(turn * math.pi / 2)])
    g.light("directional", "sun", 20, direction=(0.35, -0.8, -0.5))
    # In the back room.
    g.light("point", "lamp", 8, position=(-3, 2.4, -PITCH_Z / 2 - 2.5))
    g.camera("flight", *pose(0.0), math.radians(70), zfar=2 * SIDE)
    flight = len(g.json["nodes"]) - 1
    times = [SECONDS * i / FRAMES for i in range(FRAMES)]
    g.animate(flight, "translation", times, [pose(t)[0] for t in times])
    g.animate(flight, "rotation", times, [look_rotation(sub(*reversed(pose(t)))) for t in times])
    return g


# Places (x, z) relative to the visited house's middle, in even times: street, front door, front room, back room with the
# lamp, the room beside it, garden door, garden.
PATH = ((6.0, 40.0), (2.0, 25.0), (0.0, 12.0), (0.0, 5.0), (-3.2, 2.2), (-3.4, -1.5), (-2.0, -2.6), (1.5, -2.4), (3.0, -4.4),
        (3.4, -9.0), (5.0, -14.0))


def place(t):
    """Camera position at t seconds: a Catmull-Rom curve through PATH."""
    u = min(max(t / SECONDS, 0.0), 1.0) * (len(PATH) - 1)
    i = min(int(u), len(PATH) - 2)
    f = u - i
    p = [PATH[min(max(k, 0), len(PATH) - 1)] for k in (i - 1, i, i + 1, i + 2)]
    x, z = (0.5 * (2 * p[1][c] + (p[2][c] - p[0][c]) * f + (2 * p[0][c] - 5 * p[1][c] + 4 * p[2][c] - p[3][c]) * f * f +
                   (3 * p[1][c] - p[0][c] - 3 * p[2][c] + p[3][c]) * f ** 3) for c in (0, 1))
    return (x, 1.7 + GROUND_FLOOR * (abs(z) < 5.0), z - PITCH_Z / 2)


def pose(t):
    """(eye, target): it looks where it will be half a second later."""
    eye, ahead = place(t), place(t + 0.5)
    way = normalized((ahead[0] - eye[0] + 1e-6, 0.0, ahead[2] - eye[2] - 1e-3))
    return eye, (eye[0] + way[0], eye[1] - 0.08, eye[2] + way[2])
