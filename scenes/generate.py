#!/usr/bin/env python3
"""Writes the built-in scenes. Run by hand; its output is committed, and a test checks that both agree.

usage: scenes/generate.py [FOLDER]        (default: the folder of this file)

Metres, +Y up. Light is radiometric: W/sr (point, spot), W/m^2 (sun), W/(sr m^2) (emission).
Walls are solid and reach into each other, so that no light passes where two of them meet.
"""

import math
import os
import sys

from arena import arena
from cornell import cornell
from cornell_dynamic import cornell_dynamic
from gltf_writer import Gltf
from part import Part, normalized
from room import room


def boxes():
    """48 triangles: a closed room and three boxes, a spot from the ceiling's edge."""
    g = Gltf("boxes")
    white = g.material("white", (0.75, 0.75, 0.72))
    red = g.material("red", (0.65, 0.12, 0.08))
    blue = g.material("blue", (0.12, 0.2, 0.6))
    yellow = g.material("yellow", (0.7, 0.55, 0.1))
    g.add("room", Part().box((-3, 0, -3), (3, 4, 3), inward=True), white)
    g.add("red box", Part().box((-2.2, 0, -2), (-0.8, 2.4, -0.8)), red)
    g.add("blue box", Part().box((0.6, 0, -1.8), (2.2, 1.2, -0.3)), blue)
    g.add("yellow box", Part().box((-0.9, 0, 0.1), (0.3, 0.8, 1.1)), yellow)
    g.light("spot", "spot", 60, position=(2.4, 3.7, 1.8), direction=(-0.72, -0.62, -0.62), cone_degrees=(25, 38))
    g.camera("main", (0.3, 2.1, 2.85), (-0.1, 1.35, -1), math.radians(65))
    return g


def furnace():
    """Closed box that emits 1 everywhere, albedo 0.5: radiance 2 in every direction."""
    g = Gltf("furnace", 0.5)
    wall = g.material("wall", (0.5, 0.5, 0.5), emission=(1, 1, 1))
    g.add("box", Part().box((-1, -1, -1), (1, 1, 1), inward=True), wall)
    g.camera("main", (0.2, 0.1, 0.6), (-0.3, -0.2, -1), math.radians(70))
    return g


def icosphere(levels):
    """Unit sphere seen from inside, normals inward and smooth."""
    golden = (1 + math.sqrt(5)) / 2
    points = [normalized(p) for p in [
        (-1, golden, 0), (1, golden, 0), (-1, -golden, 0), (1, -golden, 0), (0, -1, golden), (0, 1, golden),
        (0, -1, -golden), (0, 1, -golden), (golden, 0, -1), (golden, 0, 1), (-golden, 0, -1), (-golden, 0, 1)]]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
             (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11),
             (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    for _ in range(levels):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(points)
                points.append(normalized(tuple(x + y for x, y in zip(points[a], points[b]))))
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    part = Part()
    part.positions = points
    part.normals = [tuple(-x for x in p) for p in points]
    part.indices = [i for a, b, c in faces for i in (a, c, b)]
    return part


def sphere():
    """Light of pi W/sr in the middle of a unit sphere of albedo 0.5: direct radiance 0.5, with all bounces 1."""
    g = Gltf("sphere")
    g.add("sphere", icosphere(4), g.material("wall", (0.5, 0.5, 0.5)))
    g.light("point", "point", math.pi, position=(0, 0, 0))
    g.camera("main", (0.3, 0.1, 0.4), (-0.5, -0.2, -0.6), math.radians(70))
    return g


def two_rooms():
    """Two mirrored rooms; x < 0 is lit, x > 0 is sealed. The wall between, 0.25 m, is one cell of 32 across 8 m."""
    g = Gltf("two-rooms")
    white = g.material("white", (0.75, 0.75, 0.75))
    crate = g.material("crate", (0.6, 0.4, 0.2))
    t = 0.25
    x1, y1, z1 = 4, 3.5, 2.25  # outside; the floor's underside is at y = 0
    h = t / 2
    g.add("floor", Part().box((-x1, 0, -z1), (x1, t, z1)), white)
    g.add("ceiling", Part().box((-x1, y1 - t, -z1), (x1, y1, z1)), white)
    g.add("front wall", Part().box((-x1 + h, h, z1 - t), (x1 - h, y1 - h, z1 - 0.01)), white)
    g.add("back wall", Part().box((-x1 + h, h, -z1 + 0.01), (x1 - h, y1 - h, -z1 + t)), white)
    g.add("left wall", Part().box((-x1 + 0.01, h, -z1 + h), (-x1 + t, y1 - h, z1 - h)), white)
    g.add("right wall", Part().box((x1 - t, h, -z1 + h), (x1 - 0.01, y1 - h, z1 - h)), white)
    g.add("wall between", Part().box((-h, h, -z1 + h), (h, y1 - h, z1 - h)), white)
    g.add("lit crate", Part().box((-2.2, t, -1.4), (-1.4, t + 0.8, -0.6)), crate)
    g.add("sealed crate", Part().box((1.4, t, -1.4), (2.2, t + 0.8, -0.6)), crate)
    g.light("point", "point", 6, position=(-1.6, 2.6, 0.4))
    for name, side in (("main", -1), ("lit", -1), ("sealed", 1)):
        g.camera(name, (3.4 * side, 1.9, 1.3), (0.2 * side, 1.4, -0.6), math.radians(65))
    return g


def corridor():
    """A Z of three arms, 2 m wide, a lamp at the end of the first: the last arm sees light after two bends."""
    g = Gltf("corridor")
    wall = g.material("wall", (0.78, 0.76, 0.72))
    floor = g.material("floor", (0.4, 0.36, 0.32))
    red = g.material("red end", (0.65, 0.15, 0.1))
    t, height = 0.5, 2.5
    g.add("floor", Part().box((-t, -t, -t), (14 + t, 0, 8 + t)), floor)
    g.add("ceiling", Part().box((-t, height, -t), (14 + t, height + t, 8 + t)), wall)
    low, top = -t / 2, height + t / 2
    # Corners of the inside (x, z), the floor on the left when walked along; and each wall's outside, t further out.
    inner = [(0, 0), (8, 0), (8, 6), (14, 6), (14, 8), (6, 8), (6, 2), (0, 2)]
    outer = [(-t, -t), (8 + t, -t), (8 + t, 6 - t), (14 + t, 6 - t), (14 + t, 8 + t), (6 - t, 8 + t), (6 - t, 2 + t),
             (-t, 2 + t)]
    inset = 0.01  # keeps the outside off the slabs' edges
    plain, end = Part(), Part()
    for i in range(8):
        k = (i + 1) % 8
        (ax, az), (bx, bz) = inner[i], inner[k]
        (end if i == 3 else plain).quad((bx, low, bz), (ax, low, az), (ax, top, az), (bx, top, bz))
        (ax, az), (bx, bz) = [(x - math.copysign(inset, x - 7), z - math.copysign(inset, z - 4))
                              for x, z in (outer[i], outer[k])]
        plain.quad((ax, low, az), (bx, low, bz), (bx, top, bz), (ax, top, az))
    g.add("walls", plain, wall)
    g.add("far end", end, red)
    g.light("point", "lamp", 24, position=(0.7, 2.0, 1))
    g.camera("main", (6.7, 1.6, 0.5), (7.1, 1.2, 7), math.radians(70))
    g.camera("first", (7.5, 1.6, 1.3), (0, 1.2, 0.9), math.radians(70))
    g.camera("last", (6.5, 1.6, 7.4), (14, 1.2, 6.9), math.radians(70))
    return g


def textured():
    """Checker floor, a fence cut out by its alpha mask, a glowing sign."""
    g = Gltf("textured", 0.6)
    checker = g.texture("checker", 16, 16, lambda x, y: (214, 208, 196, 255) if (x // 8 + y // 8) % 2 else
                        (86, 74, 66, 255), nearest=True)

    def fence_texel(x, y):
        wire = (x + y) % 32 < 5 or (x - y) % 32 < 5
        return (150, 158, 150, 255 if wire else 0)

    fence = g.texture("fence", 64, 64, fence_texel)
    letters = ["#...#..##.#..#.###", "#...#.#...#..#..#.", "#...#.#.#.####..#.", "#...#.#.#.#..#..#.",
               "###.#..##.#..#..#."]

    def sign_texel(x, y):
        column, row = x // 2 - 1, y // 2 - 1
        on = 0 <= row < 5 and 0 <= column < 18 and letters[row][column] == "#"
        return (255, 190, 90, 255) if on else (20, 6, 60, 255)

    sign = g.texture("sign", 40, 14, sign_texel, nearest=True)
    wall = g.material("wall", (0.66, 0.62, 0.58))
    g.add("floor", Part().quad((-4, 0, 4), (4, 0, 4), (4, 0, -3), (-4, 0, -3), uv=(0, 0, 1, 1)),
          g.material("checker", (1, 1, 1), texture=checker, texture_scale=(8, 7)))
    g.add("back wall", Part().box((-4, -0.1, -3.2), (4, 3.2, -3)), wall)
    g.add("side wall", Part().box((-4.2, -0.1, -3.1), (-4, 3.2, 4)), g.material("side wall", (0.2, 0.42, 0.5)))
    g.add("fence", Part().quad((-2.6, 0, -0.4), (2.6, 0, -0.4), (2.6, 1.6, -0.4), (-2.6, 1.6, -0.4), uv=(0, 0, 13, 4)),
          g.material("fence", (1, 1, 1), texture=fence, alpha_cutoff=0.5))
    g.add("sign", Part().quad((-1.4, 1.9, -2.9), (1.4, 1.9, -2.9), (1.4, 2.88, -2.9), (-1.4, 2.88, -2.9),
                              uv=(0, 0, 1, 1)),
          g.material("sign", (0, 0, 0), emission=(6, 6, 6), emission_texture=sign))
    g.add("crate", Part().box((1.4, 0, -2.2), (2.4, 1, -1.2)), g.material("crate", (0.6, 0.42, 0.2)))
    g.light("directional", "sun", 6, color=(1, 0.93, 0.82), direction=(-0.35, -0.6, -0.72))
    g.camera("main", (1.6, 1.8, 3.6), (-0.3, 1.0, -1.5), math.radians(60))
    return g


# Name -> (maker, True for .glb).
SCENES = {
    "arena": (arena, True),
    "boxes": (boxes, False),
    "cornell-box": (lambda: cornell("cornell-box", 1, area_light=True), False),
    "cornell-dynamic": (cornell_dynamic, True),
    "cornell-spot": (lambda: cornell("cornell-spot", 2, area_light=False), False),
    "corridor": (corridor, False),
    "furnace": (furnace, False),
    "room": (room, False),
    "sphere": (sphere, True),
    "textured": (textured, False),
    "two-rooms": (two_rooms, False),
}


def generate(folder):
    """Writes every scene into `folder`; returns the file names."""
    names = []
    for name, (make, binary) in SCENES.items():
        names.append(name + (".glb" if binary else ".gltf"))
        with open(os.path.join(folder, names[-1]), "wb") as f:
            f.write(make().to_bytes(binary))
    return names


if __name__ == "__main__":
    target = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    for file in generate(target):
        print(os.path.join(target, file))
