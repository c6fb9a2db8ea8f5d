"""Copies of glTF files with moving nodes, more lights or another wall. Standard library only."""

import base64
import json
import math
import os
import struct


class MovingScene:
    """A .gltf file that is changed and written elsewhere; what it names stays where it is."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as f:
            self.gltf = json.load(f)
        self.folder = os.path.dirname(os.path.abspath(path))
        self.data = b""
        self.buffer = len(self.gltf.setdefault("buffers", []))
        self.gltf["buffers"].append({})
        self.channels, self.samplers = [], []

    def node(self, name):
        """Index of a node."""
        return [n.get("name") for n in self.gltf["nodes"]].index(name)

    def accessor(self, kind, rows):
        """Index of a new one of float32 tuples; kind: SCALAR, VEC3 or VEC4."""
        flat = [value for row in rows for value in row]
        self.gltf["bufferViews"].append({"buffer": self.buffer, "byteOffset": len(self.data), "byteLength": 4 * len(flat)})
        self.gltf["accessors"].append({
            "bufferView": len(self.gltf["bufferViews"]) - 1, "componentType": 5126, "type": kind, "count": len(rows),
            "min": [min(column) for column in zip(*rows)], "max": [max(column) for column in zip(*rows)]})
        self.data += struct.pack("<%df" % len(flat), *flat)
        return len(self.gltf["accessors"]) - 1

    def place(self, index, translation, direction=None):
        """Puts a node there; `direction` is what its -Z axis, a light's or a camera's, points along."""
        node = self.gltf["nodes"][index]
        node.pop("matrix", None)
        node["translation"] = list(translation)
        if direction is not None:
            node["rotation"] = looking_along(direction)

    def add_spot(self, translation, direction, intensity, inner, outer):
        """A spot light (W/sr, half angles in degrees); returns its node."""
        used = self.gltf.setdefault("extensionsUsed", [])
        if "KHR_lights_punctual" not in used:
            used.append("KHR_lights_punctual")
        lights = self.gltf.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {}).setdefault("lights", [])
        lights.append({"type": "spot", "intensity": intensity, "spot": {
            "innerConeAngle": math.radians(inner), "outerConeAngle": math.radians(outer)}})
        self.gltf["nodes"].append({"name": "added spot",
                                   "extensions": {"KHR_lights_punctual": {"light": len(lights) - 1}}})
        index = len(self.gltf["nodes"]) - 1
        self.gltf["scenes"][self.gltf.get("scene", 0)]["nodes"].append(index)
        self.place(index, translation, direction)
        return index

    def move(self, index, times, places, interpolation="LINEAR"):
        """Translates a node: `places` at `times` (s)."""
        sampler = {"input": self.accessor("SCALAR", [(t,) for t in times]), "output": self.accessor("VEC3", places),
                   "interpolation": interpolation}
        self.samplers.append(sampler)
        self.channels.append({"sampler": len(self.samplers) - 1, "target": {"node": index, "path": "translation"}})

    def replace_by_rectangle(self, index, corners):
        """Gives a node's mesh these four corners, in order round it, instead of its shape: a plane without thickness."""
        mesh = self.gltf["meshes"][self.gltf["nodes"][index]["mesh"]]
        a, b, c, d = corners
        mesh["primitives"] = [{"attributes": {"POSITION": self.accessor("VEC3", [a, b, c, a, c, d])},
                               "material": mesh["primitives"][0]["material"]}]

    def save(self, path):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        self.gltf["buffers"][self.buffer] = {"uri": uri, "byteLength": len(self.data)}
        if not self.data:
            self.gltf["buffers"].pop(self.buffer)
        if self.channels:
            self.gltf["animations"] = [{"name": "move", "samplers": self.samplers, "channels": self.channels}]
        for named in self.gltf["buffers"] + self.gltf.get("images", []):
            if "uri" in named and not named["uri"].startswith("data:"):
                full = os.path.join(self.folder, named["uri"])
                named["uri"] = os.path.relpath(full, os.path.dirname(os.path.abspath(path)))
        with open(path, "w", encoding="utf-8") as f:
            json.dump(self.gltf, f)
        return path


def looking_along(direction):
    """Quaternion x, y, z, w that turns -Z to `direction`, upright where it can be."""
    length = math.sqrt(sum(x * x for x in direction))
    z = [-x / length for x in direction]
    up = (0.0, 1.0, 0.0) if abs(z[1]) < 0.9999 else (0.0, 0.0, -1.0)
    x = cross(up, z)
    norm = math.sqrt(sum(v * v for v in x))
    x = [v / norm for v in x]
    y = cross(z, x)
    # The rotation matrix's columns are x, y, z; its largest diagonal sum keeps the root away from zero.
    m = [[x[i], y[i], z[i]] for i in range(3)]
    candidates = (m[0][0] - m[1][1] - m[2][2], m[1][1] - m[0][0] - m[2][2], m[2][2] - m[0][0] - m[1][1],
                  m[0][0] + m[1][1] + m[2][2])
    largest = max(range(4), key=lambda i: candidates[i])
    s = 2 * math.sqrt(1 + candidates[largest])
    skew = (m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1])
    if largest == 3:
        return [skew[0] / s, skew[1] / s, skew[2] / s, s / 4]
    q = [0.0] * 4
    q[largest], q[3] = s / 4, skew[largest] / s
    for other in range(3):
        if other != largest:
            q[other] = (m[largest][other] + m[other][largest]) / s
    return q


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
