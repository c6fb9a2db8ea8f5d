#!/usr/bin/env python3
"""Small glTF files, one for each thing that the format can say about a picture, and for each a plain file that shows the same.

usage: scripts/sample_scenes.py FOLDER      writes NAME.glb and NAME-plain.glb of every situation

The plain files use nothing but float positions, normals and first texture coordinates, constant base colours and nodes without
transforms, so what a renderer makes of both must agree. Same call, same bytes. Python 3 standard library only.
"""

import math
import os
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.realpath(__file__))), "scenes"))

from gltf_writer import FLOAT, UBYTE, USHORT, Gltf  # noqa: E402
from part import Part, normalized  # noqa: E402
from sample_codecs import draco_mesh, meshopt_indices, meshopt_vertices  # noqa: E402

BYTE, SHORT = 5120, 5122
ORANGE, BLUE, GREEN = (0.8, 0.4, 0.1), (0.15, 0.3, 0.75), (0.2, 0.6, 0.25)
MOMENT = 0.7  # s, at which the animated situation is looked at


class Room(Gltf):
    """Half a room of 3 x 2 x 2 m with a lamp, open towards the camera."""

    def __init__(self, name):
        super().__init__(name, 2.0)
        white, red, green = (self.material(*m) for m in (("white", (0.7, 0.7, 0.7)), ("red", (0.6, 0.1, 0.1)),
                                                         ("green", (0.15, 0.5, 0.15))))
        self.add("floor", Part().quad((-1.5, 0, 1), (1.5, 0, 1), (1.5, 0, -1), (-1.5, 0, -1)), white)
        self.add("ceiling", Part().quad((-1.5, 2, -1), (1.5, 2, -1), (1.5, 2, 1), (-1.5, 2, 1)), white)
        self.add("back", Part().quad((-1.5, 0, -1), (1.5, 0, -1), (1.5, 2, -1), (-1.5, 2, -1)), white)
        self.add("left", Part().quad((-1.5, 0, 1), (-1.5, 0, -1), (-1.5, 2, -1), (-1.5, 2, 1)), red)
        self.add("right", Part().quad((1.5, 0, -1), (1.5, 0, 1), (1.5, 2, 1), (1.5, 2, -1)), green)
        self.light("point", "lamp", 2, position=(0.2, 1.45, 0.9))
        self.camera("main", (0, 1, 4.1), (0, 1, 0), math.radians(38))

    def hang(self, part, material, **fields):
        """A node of its own for one mesh of one part; returns the node."""
        return self.node("", mesh=self.mesh("", (part, material)), **fields)

    def use(self, extension, required=False):
        self.used.add(extension)
        if required:
            self.json.setdefault("extensionsRequired", []).append(extension)

    def accessor(self, fmt, rows, kind, component, view=None, **more):
        """Packed by `fmt`, e.g. "<3h2x"."""
        data = b"".join(struct.pack(fmt, *row) for row in rows)
        view = self._view(data, None) if view is None else view
        if struct.calcsize(fmt) > 4 and fmt.endswith("x"):
            self.json["bufferViews"][view]["byteStride"] = struct.calcsize(fmt)
        self.json["accessors"].append({"bufferView": view, "componentType": component, "count": len(rows), "type": kind,
                                       **more})
        return len(self.json["accessors"]) - 1


def panel(column, columns=4, uv=(0, 0, 1, 1)):
    """An upright square in the middle of the room, one of a row."""
    side = 2.6 / columns
    x = (column - columns / 2) * side
    half = 0.45 * side
    return Part().quad((x + side / 2 - half, 1 - half, 0), (x + side / 2 + half, 1 - half, 0),
                       (x + side / 2 + half, 1 + half, 0), (x + side / 2 - half, 1 + half, 0), uv)


def letter(x, y):
    """Texel of an F in an 8 x 8 texture, which shows every turn and mirroring; opaque."""
    on = 1 <= y <= 6 and (x in (1, 2) or (y in (1, 2) and x <= 6) or (y == 4 and x <= 4))
    return (230, 120, 30, 255) if on else (40, 90, 200, 255)


def body():
    """An L of two boxes with a notch: it differs from its mirror image and has no axis of symmetry."""
    return Part().box((0, 0, 0), (0.25, 0.75, 0.25)).box((0.25, 0, 0), (0.5, 0.25, 0.25)).box((0, 0.5, 0.25), (0.125, 0.75, 0.5))


def moved(part, place, turn=lambda v: v, mirrored=False):
    """A copy with `turn`, a linear map, and a translation baked in."""
    result = Part()
    result.positions = [tuple(a + b for a, b in zip(turn(p), place)) for p in part.positions]
    # Mirrored triangles have to run the other way round, so that their fronts stay fronts.
    result.normals = [normalized(turn(n)) for n in part.normals]
    result.texcoords = list(part.texcoords)
    triangles = [part.indices[i:i + 3] for i in range(0, len(part.indices), 3)]
    result.indices = [i for t in triangles for i in (reversed(t) if mirrored else t)]
    return result


def turned(axis, degrees):
    """(quaternion, function) of a turn about axis 0, 1 or 2."""
    half = math.radians(degrees) / 2
    q = [0, 0, 0, math.cos(half)]
    q[axis] = math.sin(half)
    c, s = math.cos(2 * half), math.sin(2 * half)
    first, second = (axis + 1) % 3, (axis + 2) % 3

    def turn(v):
        result = list(v)
        result[first], result[second] = c * v[first] - s * v[second], s * v[first] + c * v[second]
        return tuple(result)
    return q, turn


def matrix(columns, place):
    """As glTF has it: column by column."""
    return [x for column in columns for x in (*column, 0)] + [*place, 1]


# ---- the situations; each function makes one file, and with `plain` the same picture in plain words ----


def alpha_modes(plain):
    """Opaque, mask with cutoffs 0.5 and 0.7, blend, which is shown as a mask: of a texture with stripes of alpha."""
    g = Room("alpha modes")

    def alpha(x, y):
        return 16 + 32 * ((x + 2 * y) % 8)
    texture = g.texture("stripes", 8, 8, lambda x, y: (204, 102, 26, alpha(x, y)), nearest=True)
    linear = [((c / 255 + 0.055) / 1.055) ** 2.4 for c in (204, 102, 26)]
    for column, (mode, cutoff, factor) in enumerate((("OPAQUE", 0, 1), ("MASK", 0.5, 1), ("MASK", 0.7, 1), ("BLEND", 0.5, 0.7))):
        part = panel(column)
        if plain:
            (x0, y0, z), (x1, _, _), (_, y1, _), _ = part.positions
            part = Part()
            for y in range(8):
                for x in range(8):
                    if factor * alpha(x, y) / 255 >= cutoff:
                        left, right = (x0 + (x1 - x0) * i / 8 for i in (x, x + 1))
                        low, high = (y1 + (y0 - y1) * i / 8 for i in (y + 1, y))
                        part.quad((left, low, z), (right, low, z), (right, high, z), (left, high, z))
            g.hang(part, g.material("orange", linear))
            continue
        material = g.material(mode, (1, 1, 1), texture=texture)
        fields = g.json["materials"][material]
        fields["pbrMetallicRoughness"]["baseColorFactor"][3] = factor
        fields["alphaMode"] = mode
        if mode == "MASK":
            fields["alphaCutoff"] = cutoff
        g.hang(part, material)
    return g


def texture_transform(plain):
    """KHR_texture_transform: an offset, a turn, a scale that repeats, all three."""
    g = Room("texture transform")
    texture = g.texture("letter", 8, 8, letter, nearest=True)
    for column, (offset, degrees, scale) in enumerate((((0.25, 0.5), 0, (1, 1)), ((0, 1), 90, (1, 1)), ((0, 0), 0, (2, 3)),
                                                       ((0.1, 0.3), -30, (1.5, -1.5)))):
        part, material = panel(column), g.material("letter", (1, 1, 1), texture=texture)
        if plain:
            c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
            scaled = [(u * scale[0], v * scale[1]) for u, v in part.texcoords]
            # Counter-clockwise with u to the right and v downward.
            part.texcoords = [(c * u + s * v + offset[0], c * v - s * u + offset[1]) for u, v in scaled]
        else:
            g.json["materials"][material]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
                "KHR_texture_transform": {"offset": offset, "rotation": math.radians(degrees), "scale": scale}}
            g.use("KHR_texture_transform")
        g.hang(part, material)
    return g


def vertex_colors(plain):
    """COLOR_0 as bytes, as shorts and as floats, times the base colour; the last one runs from corner to corner."""
    g = Room("vertex colours")
    factor = (0.9, 0.8, 1)
    colors = ((1, 0.4, 0.2), (0.2, 0.6, 1), (0.4, 1, 0.2))
    kinds = (("<4B", 255, UBYTE), ("<4H", 65535, USHORT), ("<4f", 1, FLOAT))
    for column, (color, (fmt, full, component)) in enumerate(zip(colors, kinds)):
        if plain:
            g.hang(panel(column), g.material("product", [a * b for a, b in zip(factor, color)]))
            continue
        node = g.hang(panel(column), g.material("factor", factor))
        rows = [[full * c if full == 1 else round(full * c) for c in (*color, 1)]] * 4
        primitive = g.json["meshes"][g.json["nodes"][node]["mesh"]]["primitives"][0]
        primitive["attributes"]["COLOR_0"] = g.accessor(fmt, rows, "VEC4", component, **({"normalized": True} if full > 1 else {}))
    last = panel(3)
    if plain:
        (x0, y0, z), (x1, _, _), (_, y1, _), _ = last.positions
        for i in range(32):
            left, right = (x0 + (x1 - x0) * k / 32 for k in (i, i + 1))
            t = (i + 0.5) / 32
            g.hang(Part().quad((left, y0, z), (right, y0, z), (right, y1, z), (left, y1, z)), g.material("strip", (1 - t, t, 0.2)))
        return g
    node = g.hang(last, g.material("white", (1, 1, 1)))
    rows = [(1, 0, 0.2), (0, 1, 0.2), (0, 1, 0.2), (1, 0, 0.2)]
    primitive = g.json["meshes"][g.json["nodes"][node]["mesh"]]["primitives"][0]
    primitive["attributes"]["COLOR_0"] = g.accessor("<3f", rows, "VEC3", FLOAT)
    return g


def negative_scale(plain):
    """Mirroring by one axis of a scale, by a matrix, by a parent; lamps that shine from their front side only are mirrored, too."""
    g = Room("negative scale")
    materials = [g.material(*m) for m in (("orange", ORANGE), ("blue", BLUE), ("green", GREEN))]
    lamp_material = g.material("lamp", (0, 0, 0), emission=(3, 3, 3))
    del g.json["materials"][lamp_material]["doubleSided"]
    lamp = Part().quad((0, 0.8, 0), (0.25, 0.8, 0), (0.25, 1.05, 0), (0, 1.05, 0))
    places = ((-0.6, 0.1, 0), (0.3, 0.1, 0), (0.7, 1.3, 0))
    mirrors = (lambda v: (-v[0], v[1], v[2]), lambda v: (v[0], v[1], -v[2]), lambda v: (v[0], -v[1], v[2]))
    if plain:
        for material, place, mirror in zip(materials, places, mirrors):
            g.hang(moved(body(), place, mirror, True), material)
            g.hang(moved(lamp, place, mirror, True), lamp_material)
        return g
    bodies = [g.mesh("body", (body(), material), (lamp, lamp_material)) for material in materials]
    g.node("scale", mesh=bodies[0], translation=places[0], scale=(-1, 1, 1))
    g.node("matrix", mesh=bodies[1], matrix=matrix(((1, 0, 0), (0, 1, 0), (0, 0, -1)), places[1]))
    parent = g.node("parent", translation=places[2], scale=(1, -1, 1))
    g.node("child", parent, mesh=bodies[2])
    return g


def multi_uv(plain):
    """Base colours from texture coordinates 0 to 3, and emission from another set than the colour's."""
    g = Room("multiple texture coordinates")
    texture = g.texture("letter", 8, 8, letter, nearest=True)
    dots = g.texture("dots", 4, 4, lambda x, y: (255, 255, 255, 255) if (x, y) in ((3, 3), (2, 3)) else (0, 0, 0, 255), nearest=True)
    wanted = [(0, 1), (1, 1), (1, 0), (0, 0)]
    useless = [(0.1, 0.1)] * 4
    for column in range(4):
        glow = (column + 1) % 4
        part = panel(column)
        part.texcoords = list(wanted) if plain or column == 0 or glow == 0 else list(useless)
        material = g.material("letter", (1, 1, 1), texture=texture, emission=(0.2, 0.2, 0.2), emission_texture=dots)
        node = g.hang(part, material)
        if plain:
            continue
        fields = g.json["materials"][material]
        fields["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = column
        fields["emissiveTexture"]["texCoord"] = glow
        attributes = g.json["meshes"][g.json["nodes"][node]["mesh"]]["primitives"][0]["attributes"]
        for k in (1, 2, 3):
            attributes["TEXCOORD_%d" % k] = g.accessor("<2f", wanted if k in (column, glow) else useless, "VEC2", FLOAT)
    return g


def orientation(plain):
    """Turns about each axis by rotations, by a matrix, and by a parent and its child one after the other."""
    g = Room("orientation")
    materials = [g.material(*m) for m in (("orange", ORANGE), ("blue", BLUE), ("green", GREEN))]
    mesh = [g.mesh("body", (body(), m)) for m in materials] if not plain else None
    cases = (((-1.3, 0.1, 0), 0, 40), ((-0.6, 0.1, 0), 1, 110), ((0.3, 0.1, 0), 2, 75), ((0.9, 0.1, 0), 1, -30))
    for i, (place, axis, degrees) in enumerate(cases):
        q, turn = turned(axis, degrees)
        if plain:
            g.hang(moved(body(), place, turn), materials[i % 3])
        elif i == 3:
            g.node("matrix", mesh=mesh[0], matrix=matrix([turn(a) for a in ((1, 0, 0), (0, 1, 0), (0, 0, 1))], place))
        else:
            g.node("rotation", mesh=mesh[i], translation=place, rotation=q)
    (q0, turn0), (q1, turn1) = turned(2, -50), turned(0, 130)
    place = (-0.3, 1.2, 0)
    if plain:
        g.hang(moved(moved(body(), (0.1, 0.2, 0), turn1), place, turn0), materials[1])
    else:
        parent = g.node("parent", translation=place, rotation=q0)
        g.node("child", parent, mesh=mesh[1], translation=(0.1, 0.2, 0), rotation=q1)
    return g


def instancing(plain):
    """EXT_mesh_gpu_instancing with translations, rotations as normalised shorts and scales, below a node that moves all."""
    g = Room("instancing")
    material = g.material("orange", ORANGE)
    whole = (-1.2, 0.1, -0.3)
    places, turns, scales = [], [], []
    for i in range(12):
        places.append((0.6 * (i % 4) + 0.1, 0.55 * (i // 4), 0.1 * (i // 4)))
        turns.append(turned(1, 25 * i))
        scales.append((0.5 + 0.03 * i, 0.6, 0.6))
    if plain:
        for place, (_, turn), scale in zip(places, turns, scales):
            # Normals of boxes along the axes stay what they are under such scales.
            part = moved(body(), (0, 0, 0), lambda v, s=scale: tuple(a * b for a, b in zip(v, s)))
            g.hang(moved(part, tuple(a + b for a, b in zip(place, whole)), turn), material)
        return g
    attributes = {"TRANSLATION": g.accessor("<3f", places, "VEC3", FLOAT), "SCALE": g.accessor("<3f", scales, "VEC3", FLOAT),
                  "ROTATION": g.accessor("<4h", [[round(32767 * x) for x in q] for q, _ in turns], "VEC4", SHORT, normalized=True)}
    g.hang(body(), material, translation=whole, extensions={"EXT_mesh_gpu_instancing": {"attributes": attributes}})
    g.use("EXT_mesh_gpu_instancing", required=True)
    return g


def interpolation(plain):
    """Translations by steps, along lines and along splines, and a turn, between two keys."""
    g = Room("interpolation")
    materials = [g.material(*m) for m in (("orange", ORANGE), ("blue", BLUE), ("green", GREEN))]
    times = (0, 0.4, 1.2)
    t, span = (MOMENT - 0.4) / 0.8, 0.8
    start, end = (0, 0.2, 0), (0, 1.1, 0.3)
    slope = ((0, 1.5, -1), (0, -2, 0.5))  # a second
    hermite = [(2 * t**3 - 3 * t**2 + 1) * a + (t**3 - 2 * t**2 + t) * span * da + (3 * t**2 - 2 * t**3) * b + (t**3 - t**2) * span * db
               for a, da, b, db in zip(start, slope[0], end, slope[1])]
    linear = [a + t * (b - a) for a, b in zip(start, end)]
    values = {"STEP": (start, start, end), "LINEAR": (end, start, end),
              "CUBICSPLINE": ((0, 0, 0), end, (0, 0, 0), (0, 0, 0), start, slope[0], slope[1], end, (0, 0, 0))}
    for i, (kind, place) in enumerate((("STEP", start), ("LINEAR", linear), ("CUBICSPLINE", hermite))):
        x = (-1.2, -0.4, 0.4)[i]
        if plain:
            g.hang(moved(body(), (x + place[0], *place[1:])), materials[i])
        else:
            node = g.hang(body(), materials[i])
            g.animate(node, "translation", times, [(v[0] + x * (kind != "CUBICSPLINE" or k % 3 == 1), *v[1:])
                                                   for k, v in enumerate(values[kind])], kind)
    place = (1.0, 0.7, 0)
    if plain:
        g.hang(moved(body(), place, turned(2, 120 * t)[1]), materials[0])
    else:
        node = g.hang(body(), materials[0], translation=place)
        g.animate(node, "rotation", times, [turned(2, 90)[0], turned(2, 0)[0], turned(2, 120)[0]])
    return g


def sparse(plain):
    """Sparse accessors: over positions of another accessor, and over nothing, which are zeros."""
    g = Room("sparse accessors")
    flat = Part()
    for y in range(4):
        for x in range(4):
            flat.quad(*((-1.2 + 0.6 * (x + i), 0.3 + 0.4 * (y + j), 0) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))))
    raised = [i for i, p in enumerate(flat.positions) if abs(p[0]) < 0.1 and abs(p[1] - 1.1) < 0.1]
    values = [(flat.positions[i][0], flat.positions[i][1], 0.6) for i in raised]
    orange = g.material("orange", ORANGE)
    corners = [(0, 0, 0), (0.6, 0, 0), (0, 0.6, 0)]
    blue = g.material("blue", BLUE)

    def without_normals():
        del g.json["meshes"][-1]["primitives"][0]["attributes"]["NORMAL"]  # those of the flat one
    if plain:
        part = moved(flat, (0, 0, 0))
        for i, value in zip(raised, values):
            part.positions[i] = value
        g.hang(part, orange)
        without_normals()
        g.hang(moved(Part().triangle(*corners), (0.4, 0.1, 0.7)), blue)
        return g

    def make_sparse(primitive, indices, rows, drop_view):
        accessor = g.json["accessors"][g.json["meshes"][-1]["primitives"][0]["attributes"]["POSITION"]]
        accessor["sparse"] = {"count": len(indices),
                              "indices": {"bufferView": g._view(struct.pack("<%dH" % len(indices), *indices), None), "componentType": USHORT},
                              "values": {"bufferView": g._view(b"".join(struct.pack("<3f", *row) for row in rows), None)}}
        if drop_view:
            del accessor["bufferView"]
        every = list(primitive.positions)
        for i, row in zip(indices, rows):
            every[i] = row
        accessor["min"], accessor["max"] = ([f(column) for column in zip(*every)] for f in (min, max))
    g.hang(flat, orange)
    without_normals()
    make_sparse(flat, raised, values, False)
    triangle = Part().triangle(*corners)
    g.hang(triangle, blue, translation=(0.4, 0.1, 0.7))
    make_sparse(triangle, [1, 2], corners[1:], True)
    return g


def dented(steps=12):
    """A smooth bump over a square of 1 x 1 m with texture coordinates."""
    part = Part()
    for j in range(steps + 1):
        for i in range(steps + 1):
            x, y = i / steps, j / steps
            slope = [2 * math.pi * math.sin(2 * math.pi * a) * (1 - math.cos(2 * math.pi * b)) / 16 for a, b in ((x, y), (y, x))]
            part.positions.append((x, y, (1 - math.cos(2 * math.pi * x)) * (1 - math.cos(2 * math.pi * y)) / 16))
            part.normals.append(normalized((-slope[0], -slope[1], 1)))
            part.texcoords.append((x, 1 - y))
    for j in range(steps):
        for i in range(steps):
            a, b = j * (steps + 1) + i, (j + 1) * (steps + 1) + i
            part.indices += [a, a + 1, b + 1, a, b + 1, b]
    return part


def grown(part):
    return moved(part, (-0.8, 0.2, -0.2), lambda v: (1.6 * v[0], 1.6 * v[1], 1.6 * v[2]))


def quantised(plain):
    """KHR_mesh_quantization: positions in shorts below a scaled node, normals in bytes, texture coordinates in shorts."""
    g = Room("quantised")
    material = g.material("letter", (1, 1, 1), texture=g.texture("letter", 8, 8, letter, nearest=True))
    if plain:
        g.hang(grown(dented()), material)
        return g
    part, fine = dented(), 8192
    mesh = g.mesh("bump", (part, material))
    attributes = g.json["meshes"][mesh]["primitives"][0]["attributes"]
    rows = [[round(fine * x) for x in p] for p in part.positions]
    attributes["POSITION"] = g.accessor("<3h2x", rows, "VEC3", SHORT, min=[min(c) for c in zip(*rows)], max=[max(c) for c in zip(*rows)])
    attributes["NORMAL"] = g.accessor("<3bx", [[round(127 * x) for x in n] for n in part.normals], "VEC3", BYTE, normalized=True)
    g.json["bufferViews"][-1]["byteStride"] = 4
    attributes["TEXCOORD_0"] = g.accessor("<2H", [[round(4096 * x) for x in t] for t in part.texcoords], "VEC2", USHORT)
    g.json["materials"][material]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
        "KHR_texture_transform": {"scale": [1 / 4096, 1 / 4096]}}
    g.node("bump", mesh=mesh, translation=(-0.8, 0.2, -0.2), scale=[1.6 / fine] * 3)
    g.use("KHR_mesh_quantization", required=True)
    g.use("KHR_texture_transform", required=True)
    return g


def draco(plain):
    """KHR_draco_mesh_compression of positions, normals and texture coordinates."""
    g = Room("Draco")
    part = grown(dented())
    node = g.hang(part, g.material("letter", (1, 1, 1), texture=g.texture("letter", 8, 8, letter, nearest=True)))
    if plain:
        return g
    primitive = g.json["meshes"][g.json["nodes"][node]["mesh"]]["primitives"][0]
    for accessor in (*primitive["attributes"].values(), primitive["indices"]):
        del g.json["accessors"][accessor]["bufferView"]
    view = g._view(draco_mesh(part.indices, part.positions, part.normals, part.texcoords), None)
    primitive["extensions"] = {"KHR_draco_mesh_compression": {"bufferView": view,
                                                              "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}}}
    g.use("KHR_draco_mesh_compression", required=True)
    return g


def meshopt(plain):
    """EXT_meshopt_compression of vertices and indices."""
    g = Room("meshopt")
    part = grown(dented())
    node = g.hang(part, g.material("letter", (1, 1, 1), texture=g.texture("letter", 8, 8, letter, nearest=True)))
    if plain:
        return g
    primitive = g.json["meshes"][g.json["nodes"][node]["mesh"]]["primitives"][0]
    for accessor in (*primitive["attributes"].values(), primitive["indices"]):
        fields = g.json["accessors"][accessor]
        view = g.json["bufferViews"][fields["bufferView"]]
        data = bytes(g.binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]])
        stride = view["byteLength"] // fields["count"]
        attributes = fields["type"] != "SCALAR"
        coded = meshopt_vertices(data, stride) if attributes else meshopt_indices(part.indices)
        packed = g.json["bufferViews"].pop(g._view(coded, None))
        view["extensions"] = {"EXT_meshopt_compression": {
            "buffer": 0, "byteOffset": packed["byteOffset"], "byteLength": packed["byteLength"], "byteStride": stride,
            "count": fields["count"], "mode": "ATTRIBUTES" if attributes else "INDICES"}}
    g.use("EXT_meshopt_compression", required=True)
    return g


SITUATIONS = {f.__name__.replace("_", "-"): f for f in (
    alpha_modes, texture_transform, vertex_colors, negative_scale, multi_uv, orientation, instancing, interpolation, sparse,
    quantised, draco, meshopt)}
ANIMATED = "interpolation"


def write(folder, name, plain):
    """Returns the file's path."""
    path = os.path.join(folder, name + ("-plain" if plain else "") + ".glb")
    with open(path, "wb") as f:
        f.write(SITUATIONS[name](plain).to_bytes(True))
    return path


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    os.makedirs(sys.argv[1], exist_ok=True)
    for name in SITUATIONS:
        for plain in (False, True):
            print(write(sys.argv[1], name, plain))


if __name__ == "__main__":
    main()
