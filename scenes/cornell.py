"""The Cornell box as measured: with its area light, or with a spot."""

import math

from gltf_writer import Gltf
from part import Part

# Cornell box: "Cornell Box Data", Program of Computer Graphics, Cornell University (measured, millimetres).
# RGB reflectances are the usual conversion of its spectra, light radiance (17, 12, 4).
CORNELL_COLORS = {"white": (0.725, 0.71, 0.68), "red": (0.63, 0.065, 0.05), "green": (0.14, 0.45, 0.091)}
CORNELL_WALLS = [
    ("floor", "white", [(552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2)]),
    ("back wall", "white", [(549.6, 0, 559.2), (0, 0, 559.2), (0, 548.8, 559.2), (556, 548.8, 559.2)]),
    ("right wall", "green", [(0, 0, 559.2), (0, 0, 0), (0, 548.8, 0), (0, 548.8, 559.2)]),
    ("left wall", "red", [(552.8, 0, 0), (549.6, 0, 559.2), (556, 548.8, 559.2), (556, 548.8, 0)]),
]
CORNELL_CEILING = [(556, 548.8, 0), (556, 548.8, 559.2), (0, 548.8, 559.2), (0, 548.8, 0)]
CORNELL_LIGHT = [(343, 548.8, 227), (343, 548.8, 332), (213, 548.8, 332), (213, 548.8, 227)]
# Height, and the four corners of the top (x, z).
CORNELL_BLOCKS = [
    ("short block", 165, [(130, 65), (82, 225), (240, 272), (290, 114)]),
    ("tall block", 330, [(423, 247), (265, 296), (314, 456), (472, 406)]),
]


def metres(points):
    return [tuple(x / 1000 for x in p) for p in points]


def add_walls(g):
    """Everything but the ceiling. Returns the materials by name."""
    materials = {n: g.material(n, c) for n, c in CORNELL_COLORS.items()}
    for wall, color, corners in CORNELL_WALLS:
        g.add(wall, Part().quad(*metres(corners)), materials[color])
    return materials


def add_camera(g):
    # 25 mm high film, 35 mm focal length, as measured: yfov = 2 atan(12.5 / 35).
    g.camera("main", (0.278, 0.273, -0.8), (0.278, 0.273, 0), 2 * math.atan(12.5 / 35))


def cornell(name, exposure, area_light):
    g = Gltf(name, exposure)
    materials = add_walls(g)
    outer, inner = metres(CORNELL_CEILING), metres(CORNELL_LIGHT)
    if area_light:
        # The ceiling is a frame around the light.
        frame = Part()
        for i in range(4):
            k = (i + 1) % 4
            frame.quad(outer[i], outer[k], inner[k], inner[i])
        g.add("ceiling", frame, materials["white"])
        g.add("light", Part().quad(*inner), g.material("light", (0, 0, 0), emission=(17, 12, 4)))
    else:
        g.add("ceiling", Part().quad(*outer), materials["white"])
        g.light("spot", "spot", 1, position=(0.278, 0.538, 0.2796), direction=(0, -1, 0), cone_degrees=(30, 40))
    for block, height, corners in CORNELL_BLOCKS:
        low = metres([(x, 0, z) for x, z in corners])
        top = metres([(x, height, z) for x, z in corners])
        part = Part().quad(*top)
        for i in range(4):
            k = (i + 1) % 4
            part.quad(low[i], low[k], top[k], top[i])
        g.add(block, part, materials["white"])
    add_camera(g)
    return g
