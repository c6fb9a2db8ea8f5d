"""room: a closed hall with open windows on the left, an open staircase along the back, and a low sun.

704 triangles. Only patches on the right wall see the sun; everything else is lit by what they reflect.
"""

import math

from gltf_writer import Gltf
from part import Part

WIDTH, HEIGHT, DEPTH, WALL = 9.0, 5.0, 6.5, 0.35  # inside, x y z; thickness
INTO = 0.1                                       # how far walls reach into their neighbours


def shell(g, wall, floor, right, back):
    w, h, d, t, i = WIDTH, HEIGHT, DEPTH, WALL, INTO
    g.add("floor", Part().box((-t, -t, -t), (w + t, 0, d + t)), floor)
    g.add("ceiling", Part().box((-t, h, -t), (w + t, h + t, d + t)), wall)
    g.add("back wall", Part().box((-i, -i, -t + 0.01), (w + i, h + i, 0)), back)
    g.add("front wall", Part().box((-i, -i, d), (w + i, h + i, d + t - 0.01)), wall)
    g.add("right wall", Part().box((w, -i, -i), (w + t - 0.01, h + i, d + i)), right)


def windows(g, wall):
    """The left wall: a parapet, a lintel, and six piers between five openings."""
    d, h, t, i = DEPTH, HEIGHT, WALL, INTO
    sill, head = 2.7, 4.2
    part = Part()
    part.box((-t + 0.01, -i, -i), (0, sill, d + i))
    part.box((-t + 0.01, head, -i), (0, h + i, d + i))
    edges = [-i, 0.75, 1.55, 1.9, 2.7, 3.05, 3.85, 4.2, 5.0, 5.35, 6.15, d + i]
    for z0, z1 in zip(edges[::2], edges[1::2]):
        part.box((-t + 0.02, sill - i, z0), (-0.01, head + i, z1))
    g.add("window wall", part, wall)


def staircase(g, stone, wood):
    """14 treads up to a landing in the back right corner, two posts below it, a railing above."""
    rise, run, x0, width = 3.0 / 15, 0.32, 2.3, 1.4
    treads = Part()
    for step in range(14):
        y = rise * (step + 1)
        x = x0 + run * step
        treads.box((x, y - 0.1, 0.02), (x + run + 0.04, y, width))
    g.add("treads", treads, stone)
    edge = x0 + run * 14
    landing = Part().box((edge, 2.8, 0.01), (WIDTH - 0.01, 3.0, width + 0.5))
    for x in (edge + 0.1, WIDTH - 0.35):
        landing.box((x, 0.01, width + 0.15), (x + 0.2, 2.85, width + 0.35))
    g.add("landing", landing, stone)
    rail = Part()
    for post in range(8):
        x = edge + 0.06 + post * (WIDTH - edge - 0.2) / 7
        rail.box((x, 2.95, width + 0.4), (x + 0.05, 3.85, width + 0.45))
    rail.box((edge, 3.85, width + 0.37), (WIDTH - 0.02, 3.93, width + 0.48))
    g.add("railing", rail, wood)


def furniture(g, wood, dark, red, green):
    table = Part().box((3.2, 0.72, 3.3), (5.6, 0.8, 4.3))
    for x in (3.3, 5.4):
        for z in (3.4, 4.1):
            table.box((x, 0.005, z), (x + 0.1, 0.725, z + 0.1))
    g.add("table", table, wood)
    for name, z in (("back bench", 2.65), ("front bench", 4.65)):
        bench = Part().box((3.4, 0.42, z), (5.4, 0.48, z + 0.35))
        for x in (3.55, 5.15):
            bench.box((x, 0.005, z + 0.05), (x + 0.1, 0.425, z + 0.3))
        g.add(name, bench, dark)
    shelf = Part()
    for x in (0.6, 1.95):
        shelf.box((x, 0.005, 0.01), (x + 0.05, 2.0, 0.4))
    for y in (0.1, 0.95, 1.9):
        shelf.box((0.64, y, 0.015), (1.96, y + 0.05, 0.39))
    g.add("shelf", shelf, dark)
    beams = Part()
    for x in (2.2, 4.5, 6.8):
        beams.box((x, HEIGHT - 0.3, -0.05), (x + 0.2, HEIGHT + 0.05, DEPTH + 0.05))
    g.add("beams", beams, wood)
    rug = Part().quad((2.6, 0.01, 5.3), (6.3, 0.01, 5.3), (6.3, 0.01, 2.4), (2.6, 0.01, 2.4))
    g.add("rug", rug, red)
    pictures = Part()
    for x in (2.6, 4.0, 5.4):
        pictures.quad((x, 3.3, 0.015), (x + 0.9, 3.3, 0.015), (x + 0.9, 4.2, 0.015), (x, 4.2, 0.015))
    g.add("pictures", pictures, green)


def room():
    g = Gltf("room", 2)
    wall = g.material("wall", (0.76, 0.74, 0.7))
    right = g.material("right wall", (0.8, 0.7, 0.52))
    back = g.material("back wall", (0.38, 0.48, 0.66))
    floor = g.material("floor", (0.42, 0.28, 0.17))
    stone = g.material("stone", (0.64, 0.62, 0.58))
    wood = g.material("wood", (0.5, 0.34, 0.18))
    dark = g.material("dark wood", (0.24, 0.14, 0.08))
    red = g.material("rug", (0.58, 0.12, 0.1))
    green = g.material("pictures", (0.18, 0.42, 0.24))
    shell(g, wall, floor, right, back)
    windows(g, wall)
    staircase(g, stone, wood)
    furniture(g, wood, dark, red, green)
    # 9 degrees above the horizon.
    g.light("directional", "sun", 20, color=(1, 0.92, 0.78), direction=(0.98, -0.155, -0.06))
    g.camera("main", (2.4, 2.2, 6.3), (6.4, 1.8, 1.6), math.radians(68))
    g.camera("under-stairs", (4.2, 1.3, 3.0), (7.6, 1.0, 0.4), math.radians(60))
    return g
