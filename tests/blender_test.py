#!/usr/bin/env python3
"""What Blender exports looks the same, whichever way it was exported, and what is lost is said.

blender_test.py PROGRAM [unittest arguments]. SKIPPED where there is no Blender. Python's standard library only.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from command_line import CommandLine, main

SCRIPT = pathlib.Path(__file__).with_name("blender_scene.py")
CAMERA = ["--eye", "0.5,3.2,6", "--target", "0,0.5,0", "--fov", "45"]
NO_GLOSS = "surfaces are shown diffuse: no gloss"
NO_HIGHLIGHTS = "'ks' is not shown"
NO_TEXCOORDS = "no texture coordinates"


def expected_warnings(variant):
    """Parts of the warnings, one each: Blender's materials are a little glossy."""
    kind, lost = variant["file"].split(".")[-1], variant["lost"]
    warnings = []
    if kind != "ply" and "materials" not in lost:
        warnings.append(NO_HIGHLIGHTS if kind == "obj" else NO_GLOSS)
    if kind == "obj" and variant["normals"] == "flat":
        warnings.append("smoothing groups are not read")
    if "uvs" in lost:
        warnings.append(NO_TEXCOORDS)
    if variant["name"] != "glb-lamp-camera":
        warnings.append("nothing in the scene gives light")
    return warnings


class Blender(CommandLine):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.files = pathlib.Path(temporary.name)
        # Blender looks for its Python modules beside the first Python of PATH.
        blender = shutil.which("blender")
        environment = dict(os.environ, PATH=os.path.dirname(blender) + ":/usr/bin:/bin")
        result = subprocess.run([blender, "-b", "--factory-startup", "--python-exit-code", "1", "--python", str(SCRIPT), "--",
                                 temporary.name], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, timeout=120, env=environment)
        if "ModuleNotFoundError" in result.stdout:
            print("SKIPPED: Blender lacks a Python module that its exporters need")
            raise unittest.SkipTest("no module")
        found = re.search("^variants: (.*)$", result.stdout, re.MULTILINE)
        assert result.returncode == 0 and found, result.stdout
        cls.variants = json.loads(found.group(1))

    def render_variant(self, variant):
        file = self.files / variant["file"]
        self.succeed("render", file, "--up", variant["up"], "--no-lights", "--env", "1,1,1", *CAMERA, "--size", "64x64",
                     "--samples", 16, "--technique", "path-tracer", "--aov", "albedo,normal,depth", "-o", variant["name"] + ".exr")

    def assert_same(self, variant, other, view, tolerance):
        result = self.compare(f"{variant['name']}{view}.exr", f"{other}{view}.exr")
        self.assertLess(result["relMSE"], tolerance, (variant["name"], view, result))
        self.assertGreater(result["ssim"], 0.99, (variant["name"], view, result))

    def test_exports_look_the_same(self):
        for variant in self.variants:
            self.render_variant(variant)
        for variant in self.variants:
            # The loss of JPEG is seen in colours.
            tolerance = 0.01 if variant["name"] == "glb-jpeg" else 1e-4
            self.assert_same(variant, "glb", ".depth", 1e-6)
            if variant["normals"] != "other":
                reference = "glb" if variant["normals"] == "smooth" else "glb-no-normals"
                self.assert_same(variant, reference, ".normal", 1e-4)
                if not variant["lost"]:
                    self.assert_same(variant, reference, "", tolerance)
            if not variant["lost"]:
                self.assert_same(variant, "glb", ".albedo", tolerance)

    def test_what_is_lost_is_said(self):
        for variant in self.variants:
            result = json.loads(self.succeed("info", self.files / variant["file"], "--up", variant["up"], "--json"))
            expected = expected_warnings(variant)
            self.assertEqual(len(result["warnings"]), len(expected), (variant, result["warnings"]))
            for part in expected:
                self.assertEqual(sum(part in warning for warning in result["warnings"]), 1, (variant, result["warnings"]))
            self.assertEqual(result["counts"]["cameras"] + result["counts"]["lights"],
                             2 if variant["name"] == "glb-lamp-camera" else 0)


if __name__ == "__main__":
    if shutil.which("blender"):
        main()
    else:
        print("SKIPPED: no blender")
