"""A generated scene of any number of triangles: hills and boxes in a room with one open side."""

import json
import math
import struct
from array import array


def add_grid(positions, normals, indices, side, height_at):
    """A floor of side x side quads over [-1,1] x [-1,1], indexed."""
    first = len(positions) // 3
    for z in range(side + 1):
        v = 2.0 * z / side - 1.0
        for x in range(side + 1):
            u = 2.0 * x / side - 1.0
            height, du, dv = height_at(u, v)
            length = math.sqrt(du * du + dv * dv + 1.0)
            positions.extend((u, height, v))
            normals.extend((-du / length, 1.0 / length, -dv / length))
    for z in range(side):
        row = first + z * (side + 1)
        for a in range(row, row + side):
            c = a + side + 1
            indices.extend((a, c, a + 1, a + 1, c, c + 1))


def add_quad(positions, normals, indices, corner, a, b):
    first = len(positions) // 3
    normal = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    length = math.sqrt(sum(n * n for n in normal))
    for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
        positions.extend(c + s * x + t * y for c, x, y in zip(corner, a, b))
        normals.extend(n / length for n in normal)
    indices.extend((first, first + 1, first + 2, first, first + 2, first + 3))


def hills(u, v):
    """Height and its derivatives: two waves of 0.2 and 0.02 m."""
    height = -0.7 + 0.1 * math.sin(5 * u) * math.cos(4 * v) + 0.01 * math.sin(60 * u) * math.sin(70 * v)
    du = 0.5 * math.cos(5 * u) * math.cos(4 * v) + 0.6 * math.cos(60 * u) * math.sin(70 * v)
    dv = -0.4 * math.sin(5 * u) * math.sin(4 * v) + 0.7 * math.sin(60 * u) * math.cos(70 * v)
    return height, du, dv


def room():
    """Walls and two boxes: (colour, corner, a, b) of quads, front where a x b points."""
    quads = [((0.7, 0.2, 0.15), (-1, -1, 1), (0, 0, -2), (0, 2, 0)), ((0.2, 0.3, 0.7), (1, -1, -1), (0, 0, 2), (0, 2, 0)),
             ((0.7, 0.7, 0.7), (-1, -1, -1), (2, 0, 0), (0, 2, 0))]
    for x, z, size, top in ((-0.45, -0.3, 0.35, 0.1), (0.4, 0.1, 0.3, -0.3)):
        low, high = (x - size / 2, -1, z - size / 2), (x + size / 2, 0, z + size / 2)
        w, h = size, top + 1
        color = (0.7, 0.65, 0.5)
        quads += [(color, (low[0], -1, high[2]), (w, 0, 0), (0, h, 0)), (color, (high[0], -1, low[2]), (-w, 0, 0), (0, h, 0)),
                  (color, low, (0, 0, w), (0, h, 0)), (color, (high[0], -1, high[2]), (0, 0, -w), (0, h, 0)),
                  (color, (low[0], top, high[2]), (w, 0, 0), (0, 0, -w))]
    return quads


def write_large_scene(path, triangles):
    """Writes a .glb of about so many triangles; returns how many."""
    meshes = [((0.55, 0.6, 0.45), array("f"), array("f"), array("I"))]
    add_grid(*meshes[0][1:], math.isqrt(triangles // 2), hills)
    for color, corner, a, b in room():
        meshes.append((color, array("f"), array("f"), array("I")))
        add_quad(*meshes[-1][1:], corner, a, b)
    views, accessors, chunks, offset = [], [], [], 0
    for _, positions, normals, indices in meshes:
        for data, kind, component, target in ((positions, "VEC3", 5126, 34962), (normals, "VEC3", 5126, 34962),
                                              (indices, "SCALAR", 5125, 34963)):
            accessor = {"bufferView": len(views), "componentType": component, "type": kind,
                        "count": len(data) // (3 if kind == "VEC3" else 1)}
            if data is positions:
                accessor["min"] = [min(data[i::3]) for i in range(3)]
                accessor["max"] = [max(data[i::3]) for i in range(3)]
            views.append({"buffer": 0, "byteOffset": offset, "byteLength": 4 * len(data), "target": target})
            accessors.append(accessor)
            chunks.append(data)
            offset += 4 * len(data)
    document = {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 3.0}]}},
        "buffers": [{"byteLength": offset}], "bufferViews": views, "accessors": accessors,
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [*m[0], 1], "metallicFactor": 0}} for m in meshes],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 3 * i, "NORMAL": 3 * i + 1}, "indices": 3 * i + 2,
                                    "material": i}]} for i in range(len(meshes))],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
        "nodes": [*({"mesh": i} for i in range(len(meshes))), {"camera": 0, "translation": [0, 0, 3.2]},
                  {"translation": [0.1, 0.7, 0.3], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "scenes": [{"nodes": list(range(len(meshes) + 2))}], "scene": 0}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as f:
        f.write(struct.pack("<III", 0x46546C67, 2, 12 + 8 + len(text) + 8 + offset))
        f.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
        f.write(struct.pack("<II", offset, 0x004E4942))
        for data in chunks:
            data.tofile(f)
    return sum(len(m[3]) // 3 for m in meshes)
