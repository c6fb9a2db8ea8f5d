#!/usr/bin/env python3
"""Scenes that grids of voxels find hard: small rooms on large grounds, small lamps, thin walls, many separate bodies.

usage: scripts/extent_scenes.py FOLDER [NAME...]      writes all of them, or these; --list names them

Metres, +Y up, light in radiometric units as in scenes/. Same call, same bytes. Python 3 standard library only.
"""

import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.realpath(__file__))), "scenes"))

from gltf_writer import Gltf  # noqa: E402
from part import Part  # noqa: E402
from town_scene import town  # noqa: E402

GROUNDS = (10, 20, 80, 160, 1000, 10000)  # m a side
EMITTERS = (30, 10, 2, 0.2)               # cm a side
SUN = (-0.25, -0.9, -0.38)                # comes in through the doors
SUN_IRRADIANCE = 10                       # W/m^2
SKY = (0.5, 0.6, 0.8)                     # W/(sr m^2); --env, as glTF has no sky
WALL_AT = 0.09                            # m
EMITTER_POWER = 2.0                       # radiance times the side squared: 6 pi of it are 37.7 W


def room_on_ground(ground, door=0.0, lamp=False):
    """A room of 4 x 2.8 x 4 m with walls of 0.2 m, in the middle of a square of `ground` m.

    `door`: width of an opening of 2 m in the wall towards +x; 0: sealed. `lamp`: a point light of 3 W/sr in the room, and no
    sun. Cameras `inside` and `outside`.
    """
    g = Gltf("room on %g m of ground" % ground)
    white = g.material("white", (0.7, 0.7, 0.7))
    h = ground / 2
    g.add("ground", Part().quad((-h, 0, h), (h, 0, h), (h, 0, -h), (-h, 0, -h)), g.material("ground", (0.5, 0.5, 0.5)))
    low, high = 0.1, 3.1  # walls end inside floor and ceiling
    room = Part().box((-2.2, -0.1, -2.2), (2.2, 0.2, 2.2)).box((-2.2, 3, -2.2), (2.2, 3.2, 2.2))
    for z in (-2.2, 2):
        room.box((-2.19, low, z + 0.01 * (z < 0)), (2.19, high, z + 0.2 - 0.01 * (z > 0)))
    room.box((-2.18, low, -2.1), (-2, high, 2.1))
    if door:
        room.box((2, low, -2.1), (2.18, high, -door / 2)).box((2, low, door / 2), (2.18, high, 2.1))
        room.box((2, 2.2, -door / 2 - 0.1), (2.18, high, door / 2 + 0.1))
    else:
        room.box((2, low, -2.1), (2.18, high, 2.1))
    g.add("room", room, white)
    if lamp:
        g.light("point", "lamp", 3, position=(0, 2.7, 0))
    else:
        g.light("directional", "sun", SUN_IRRADIANCE, direction=SUN)
    g.camera("inside", (-1.7, 1.6, 1.7), (0.3, 1.35, -0.3), math.radians(70), zfar=2 * ground)
    g.camera("outside", (7, 3, 6), (0, 1.2, 0), math.radians(50), zfar=2 * ground)
    return g


def lamp_cube(size, shade=False):
    """A closed room of 4 x 2.6 x 4 m, albedo 0.7, and a black cube of `size` m in it that sends out 37.7 W.

    `shade`: inside a lampshade that is open above and below, without thickness.
    """
    g = Gltf("lamp of %g m" % size)
    g.add("room", Part().box((-2, 0, -2), (2, 2.6, 2), inward=True), g.material("white", (0.7, 0.7, 0.7)))
    if shade:
        sheet, count = Part(), 16
        ring = [(0.25 * math.cos(2 * math.pi * i / count), 0.25 * math.sin(2 * math.pi * i / count)) for i in range(count + 1)]
        for (ax, az), (bx, bz) in zip(ring, ring[1:]):
            sheet.quad((ax, 1.2, az), (ax, 1.6, az), (bx, 1.6, bz), (bx, 1.2, bz))
        g.add("shade", sheet, g.material("shade", (0.8, 0.75, 0.6)))
    h, light = size / 2, (EMITTER_POWER / size ** 2,) * 3
    g.add("lamp", Part().box((-h, 1.4 - h, -h), (h, 1.4 + h, h)), g.material("lamp", (0, 0, 0), emission=light))
    g.camera("main", (-1.8, 1.3, 1.8), (0.8, 1.19, -1.24), math.radians(80))
    return g


def thin_wall(degrees):
    """A lit and a dark room with a wall without thickness between them, turned about +Y. Cameras `lit` and `sealed`.

    The wall goes through x = WALL_AT, which is on no border of cells of a power of two.
    """
    g = Gltf("wall without thickness")
    white = g.material("white", (0.75, 0.75, 0.75))
    t, x1, y1, z1 = 0.25, 4, 3.5, 2.25
    shell = Part().box((-x1, 0, -z1), (x1, t, z1)).box((-x1, y1 - t, -z1), (x1, y1, z1))
    for z in (-z1 + 0.01, z1 - t):
        shell.box((-x1 + 0.1, 0.1, z), (x1 - 0.1, y1 - 0.1, z + t - 0.01))
    for x in (-x1 + 0.01, x1 - t):
        shell.box((x, 0.1, -z1 + 0.1), (x + t - 0.01, y1 - 0.1, z1 - 0.1))
    g.add("shell", shell, white)
    angle = math.radians(degrees)
    end = (z1 - t / 2) / math.cos(angle)  # in the middle of the walls
    ax, az = -math.sin(angle) * end, math.cos(angle) * end
    a, b = (WALL_AT + ax, az), (WALL_AT - ax, -az)
    g.add("wall between", Part().quad((a[0], 0.1, a[1]), (b[0], 0.1, b[1]), (b[0], y1 - 0.1, b[1]), (a[0], y1 - 0.1, a[1])), white)
    g.light("point", "point", 6, position=(-1.6, 2.6, 0.4))
    for name, side in (("lit", -1), ("sealed", 1)):
        g.camera(name, (3.4 * side, 1.9, 1.3 * -side), (0.4 * side, 1.4, 0.6 * side), math.radians(65))
    return g


def cubes(count):
    """So many separate cubes of 0.6 m, a metre apart, all instances of one mesh; a sun."""
    g = Gltf("%d cubes" % count)
    side = math.ceil(round(count ** (1 / 3), 9))
    mesh = g.mesh("cube", (Part().box((-0.3, -0.3, -0.3), (0.3, 0.3, 0.3)), g.material("white", (0.8, 0.8, 0.8))))
    for i in range(count):
        g.node("cube", mesh=mesh, translation=[i % side, i // side % side, i // side ** 2])
    g.light("directional", "sun", 5, direction=(0.3, -1, -0.4))
    middle = (side - 1) / 2
    g.camera("main", (middle, middle, 2.5 * side), (middle, middle, 0), 0.8, zfar=1000)
    return g


def scenes():
    """{file: maker} of all of them."""
    found = {"town.glb": town}
    for ground in GROUNDS:
        found["sealed-%d.gltf" % ground] = lambda ground=ground: room_on_ground(ground)
        found["door-%d.gltf" % ground] = lambda ground=ground: room_on_ground(ground, door=0.9)
        found["lamp-%d.gltf" % ground] = lambda ground=ground: room_on_ground(ground, lamp=True)
    found["narrow-door.gltf"] = lambda: room_on_ground(10, door=0.4)
    for size in EMITTERS:
        found["emitter-%g.gltf" % size] = lambda size=size: lamp_cube(size / 100)
        found["shaded-%g.gltf" % size] = lambda size=size: lamp_cube(size / 100, shade=True)
    for degrees in (0, 30):
        found["thin-wall-%d.gltf" % degrees] = lambda degrees=degrees: thin_wall(degrees)
    for count in (1000, 10000):
        found["cubes-%d.glb" % count] = lambda count=count: cubes(count)
    return found


def write(folder, name):
    """Writes one of scenes() and returns its path."""
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, name)
    with open(path, "wb") as f:
        f.write(scenes()[name]().to_bytes(name.endswith(".glb")))
    return path


def main(arguments):
    if arguments == ["--list"]:
        print("\n".join(scenes()))
        return 0
    if not arguments or arguments[0].startswith("-"):
        sys.exit(__doc__)
    for name in arguments[1:] or scenes():
        if name not in scenes():
            sys.exit("extent_scenes.py: no scene %s (--list names them)" % name)
        print(write(arguments[0], name))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
