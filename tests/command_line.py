"""What tests of the command line share: a scene, a picture, and how the program is run.

Python's standard library only.
"""
import base64
import json
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
