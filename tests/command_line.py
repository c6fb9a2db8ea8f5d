"""What tests of the command line share: scenes, pictures, and how the program is run.

Python's standard library only.
"""
import base64
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib


def tiny_scene():
    """One triangle far behind the camera: the camera sees the environment only."""
    vertices = struct.pack("<9f", -1, 0, 9, 1, 0, 9, 0, 1, 9)
    uri = "data:application/octet-stream;base64," + base64.b64encode(vertices).decode()
    return {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(vertices), "uri": uri}],
        "bufferViews": [{"buffer": 0, "byteLength": len(vertices)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, 0, 9],
                       "max": [1, 1, 9]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
        "nodes": [{"mesh": 0}, {"camera": 0, "name": "front"}],
        "scenes": [{"nodes": [0, 1]}],
        "scene": 0,
    }


def png(width, height, bits, lines):
    """PNG file of gray pixels of so many bits; `lines` are the bytes of each row."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", width, height, bits, 0, 0, 0, 0)
    pixels = zlib.compress(b"".join(b"\0" + line for line in lines), 9)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")


def gray_png(rows):
    """PNG file of 8-bit gray rows."""
    return png(len(rows[0]), len(rows), 8, [bytes(row) for row in rows])


def moving_scene():
    """A camera that sees a shining square exactly, and animations that move one of the two by its side in a second.

    "slide": the square, evenly. "jump": the square, at once at the end, upwards. "look": the camera, evenly, while the
    square is held.
    """
    data, views, accessors = b"", [], []

    def accessor(kind, width, values):
        nonlocal data
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": 4 * len(values)})
        accessors.append({"bufferView": len(views) - 1, "componentType": 5126, "type": kind,
                          "count": len(values) // width})
        data += struct.pack("<%df" % len(values), *values)
        return len(accessors) - 1

    def animation(name, node, interpolation, end):
        sampler = {"input": times, "output": accessor("VEC3", 3, [0, 0, 0, *end]), "interpolation": interpolation}
        return {"name": name, "samplers": [sampler],
                "channels": [{"sampler": 0, "target": {"node": node, "path": "translation"}}]}

    square = accessor("VEC3", 3, [-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1])
    times = accessor("SCALAR", 1, [0, 1])
    animations = [animation("slide", 0, "LINEAR", [2, 0, 0]), animation("jump", 0, "STEP", [0, 2, 0]),
                  animation("look", 1, "LINEAR", [2, 0, 0])]
    hold = animation("", 0, "STEP", [0, 0, 0])
    animations[2]["samplers"] += hold["samplers"]
    animations[2]["channels"].append({"sampler": 1, "target": {"node": 0, "path": "translation"}})
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(data), "uri": uri}], "bufferViews": views, "accessors": accessors,
        "materials": [{"emissiveFactor": [1, 1, 1], "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": square}, "mode": 5, "material": 0}]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": math.pi / 2, "znear": 0.1}}],
        "nodes": [{"mesh": 0}, {"camera": 0, "name": "front"}],
        "animations": animations,
    }


def hdr(rows):
    """Radiance file of rows of numbers 0, or 1/256 to 255/256."""
    header = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (len(rows), len(rows[0]))
    return header + b"".join(bytes([round(256 * x)] * 3 + [128]) for row in rows for x in row)


def srgb(x):
    return 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055


class CommandLine(unittest.TestCase):
    """A folder of its own for each test, with the scene "tiny" in it."""

    program = None

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        (self.folder / "tiny.gltf").write_text(json.dumps(tiny_scene()))

    def run_program(self, *arguments, **more):
        """`more`: variables of the environment, and what subprocess.run() takes."""
        environment = dict(os.environ, LIGHTWELL_SCENES=str(self.folder))
        environment.update(more.pop("environment", {}))
        options = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "timeout": 120, **more}
        return subprocess.run([self.program, *map(str, arguments)], cwd=self.folder, env=environment, text=True, **options)

    def succeed(self, *arguments):
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def fail_with(self, part, *arguments, **more):
        """Exit code 2, one line on stderr that holds `part`, nothing on stdout, no new file."""
        before = sorted(os.listdir(self.folder))
        result = self.run_program(*arguments, **more)
        self.assertEqual(result.returncode, 2, (arguments, result))
        self.assertEqual(result.stdout, "", arguments)
        self.assertTrue(result.stderr.startswith("lightwell: error: "), result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertIn(part, result.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), before, arguments)

    def render(self, output, environment, *more):
        self.succeed("render", "tiny", "--technique", "path-tracer", "--size", "24x16", "--samples", 1, "--env", environment,
                     "-o", output, *more)

    def compare(self, *arguments):
        return json.loads(self.succeed("compare", *arguments, "--json"))


def main():
    """SCRIPT PROGRAM [unittest arguments]"""
    CommandLine.program = os.path.abspath(sys.argv.pop(1))
    unittest.main()
