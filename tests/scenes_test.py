#!/usr/bin/env python3
"""The committed scenes are what scenes/generate.py writes now, and hold what their users count on.

usage: tests/scenes_test.py     (from anywhere; Python 3 standard library only)
"""

import base64
import json
import math
import os
import struct
import sys
import tempfile
import unittest

SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scenes")
sys.path.insert(0, SCENES)
sys.dont_write_bytecode = True

import generate  # noqa: E402

TRIANGLES = {"arena": 10408, "boxes": 48, "cornell-box": 38, "cornell-dynamic": 150142, "cornell-spot": 30,
             "corridor": 56, "furnace": 12, "room": 704, "sphere": 5120, "textured": 42, "two-rooms": 108}
COMPONENTS = {5121: ("B", 1), 5123: ("H", 2), 5125: ("I", 4), 5126: ("f", 4)}
WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def path_of(name):
    return next(p for p in (os.path.join(SCENES, name + e) for e in (".gltf", ".glb")) if os.path.exists(p))


def load(name):
    """JSON and binary part of a committed scene."""
    with open(path_of(name), "rb") as f:
        data = f.read()
    if data[:4] != b"glTF":
        document = json.loads(data)
        return document, base64.b64decode(document["buffers"][0]["uri"].split(",", 1)[1], validate=True)
    version, total = struct.unpack_from("<II", data, 4)
    assert version == 2 and total == len(data)
    size, kind = struct.unpack_from("<I4s", data, 12)
    assert kind == b"JSON" and size % 4 == 0
    document = json.loads(data[20:20 + size])
    body, kind = struct.unpack_from("<I4s", data, 20 + size)
    assert kind == b"BIN\0" and 28 + size + body == len(data)
    return document, data[28 + size:]


def rows(document, binary, index):
    a = document["accessors"][index]
    view = document["bufferViews"][a["bufferView"]]
    letter, size = COMPONENTS[a["componentType"]]
    width = WIDTH[a["type"]]
    assert view["byteLength"] == width * size * a["count"] and view["byteOffset"] % size == 0
    assert view["byteOffset"] + view["byteLength"] <= len(binary)
    flat = struct.unpack_from("<%d%s" % (width * a["count"], letter), binary, view["byteOffset"])
    return [flat[i:i + width] for i in range(0, len(flat), width)]


def drawn_primitives(document):
    for node in document["nodes"]:
        if "mesh" in node:
            for primitive in document["meshes"][node["mesh"]]["primitives"]:
                yield node, primitive


class ScenesTest(unittest.TestCase):
    def test_committed_files_are_what_the_generator_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            names = generate.generate(folder)
            committed = sorted(f for f in os.listdir(SCENES) if f.endswith((".gltf", ".glb")))
            self.assertEqual(sorted(names), committed)
            for name in names:
                with open(os.path.join(folder, name), "rb") as a, open(os.path.join(SCENES, name), "rb") as b:
                    self.assertEqual(a.read(), b.read(), name + ": run scenes/generate.py and commit its output")

    def test_total_size_stays_small(self):
        total = sum(os.path.getsize(path_of(name)) for name in TRIANGLES)
        self.assertLess(total, 1_500_000)

    def test_triangle_counts(self):
        self.assertEqual(set(TRIANGLES), set(generate.SCENES))
        for name, expected in TRIANGLES.items():
            document, _ = load(name)
            count = sum(document["accessors"][p["indices"]]["count"] // 3 for _, p in drawn_primitives(document))
            self.assertEqual(count, expected, name)

    def test_buffers_indices_and_bounds(self):
        for name in TRIANGLES:
            document, binary = load(name)
            padding = len(binary) - document["buffers"][0]["byteLength"]  # .glb fills up to a multiple of four
            self.assertIn(padding, range(4), name)
            for _, p in drawn_primitives(document):
                positions = rows(document, binary, p["attributes"]["POSITION"])
                accessor = document["accessors"][p["attributes"]["POSITION"]]
                for axis in range(3):
                    self.assertAlmostEqual(accessor["min"][axis], min(q[axis] for q in positions), delta=1e-7)
                    self.assertAlmostEqual(accessor["max"][axis], max(q[axis] for q in positions), delta=1e-7)
                indices = [i for (i,) in rows(document, binary, p["indices"])]
                self.assertEqual(len(indices) % 3, 0)
                self.assertLess(max(indices), len(positions))

    def test_normals_are_unit_and_agree_with_winding(self):
        for name in TRIANGLES:
            document, binary = load(name)
            for _, p in drawn_primitives(document):
                positions = rows(document, binary, p["attributes"]["POSITION"])
                normals = rows(document, binary, p["attributes"]["NORMAL"])
                indices = [i for (i,) in rows(document, binary, p["indices"])]
                for n in normals:
                    self.assertAlmostEqual(sum(x * x for x in n), 1, delta=1e-5)
                for k in range(0, len(indices), 3):
                    a, b, c = (positions[i] for i in indices[k:k + 3])
                    u = [y - x for x, y in zip(a, b)]
                    v = [y - x for x, y in zip(a, c)]
                    face = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
                    self.assertGreater(sum(x * x for x in face), 0, "%s: degenerate triangle" % name)
                    self.assertGreater(sum(x * y for x, y in zip(face, normals[indices[k]])), 0, name)

    def test_every_scene_has_a_main_camera_and_two_sided_diffuse_materials(self):
        for name in TRIANGLES:
            document, _ = load(name)
            cameras = [n["name"] for n in document["nodes"] if "camera" in n]
            self.assertIn("main", cameras, name)
            self.assertEqual(len(cameras), len(set(cameras)), name)
            for m in document["materials"]:
                self.assertTrue(m["doubleSided"], name)
                self.assertEqual(m["pbrMetallicRoughness"]["metallicFactor"], 0, name)
            self.assertGreater(document["scenes"][0]["extras"]["exposure"], 0, name)

    def test_images_are_png(self):
        document, binary = load("textured")
        self.assertEqual(len(document["images"]), 3)
        for image in document["images"]:
            start = document["bufferViews"][image["bufferView"]]["byteOffset"]
            self.assertEqual(binary[start:start + 8], b"\x89PNG\r\n\x1a\n")

    def test_two_rooms_are_mirror_images(self):
        document, binary = load("two-rooms")
        corners = set()
        for _, p in drawn_primitives(document):
            points = rows(document, binary, p["attributes"]["POSITION"])
            corners |= {tuple(round(x, 5) + 0.0 for x in q) for q in points}
        self.assertEqual(corners, {(-x + 0.0, y, z) for x, y, z in corners})
        cameras = {n["name"]: n for n in document["nodes"] if "camera" in n}
        lit, sealed = cameras["lit"], cameras["sealed"]
        self.assertEqual(lit["translation"], [-sealed["translation"][0], *sealed["translation"][1:]])
        # A mirror in x turns the quaternion (x, y, z, w) into (x, -y, -z, w), up to its sign.
        x, y, z, w = sealed["rotation"]
        agreement = sum(a * b for a, b in zip(lit["rotation"], (x, -y, -z, w)))
        self.assertAlmostEqual(abs(agreement), 1, delta=1e-6)

    def test_skins_fit_their_meshes(self):
        document, binary = load("cornell-dynamic")
        skinned = [(n, p) for n, p in drawn_primitives(document) if "skin" in n]
        self.assertEqual(len(skinned), 18)  # six arms of three materials
        for node, p in skinned[:3]:
            joints = rows(document, binary, p["attributes"]["JOINTS_0"])
            weights = rows(document, binary, p["attributes"]["WEIGHTS_0"])
            self.assertLess(max(max(row) for row in joints), len(document["skins"][node["skin"]]["joints"]))
            self.assertEqual({sum(row) for row in weights}, {255})

    def test_animation_is_a_loop_of_two_seconds(self):
        document, binary = load("cornell-dynamic")
        animation, = document["animations"]
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            times = [t for (t,) in rows(document, binary, sampler["input"])]
            self.assertEqual(times, sorted(set(times)))
            self.assertEqual((times[0], times[-1]), (0, 2))
            values = rows(document, binary, sampler["output"])
            key = len(values) // len(times)  # rows of a key: three of a spline, one of each morph weight
            self.assertEqual(values[:key], values[-key:])
        self.assertEqual({s["interpolation"] for s in animation["samplers"]}, {"LINEAR", "STEP", "CUBICSPLINE"})

    def test_sphere_is_a_unit_sphere_with_a_light_of_pi(self):
        document, binary = load("sphere")
        primitive = document["meshes"][0]["primitives"][0]
        for p in rows(document, binary, primitive["attributes"]["POSITION"]):
            self.assertAlmostEqual(math.sqrt(sum(x * x for x in p)), 1, delta=1e-6)
        self.assertAlmostEqual(document["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"], math.pi)


if __name__ == "__main__":
    unittest.main()
