#!/usr/bin/env python3
"""Tests of the command line as a user meets it: what lightwell info prints, and --strict.

cli_info_test.py PROGRAM [unittest arguments]. Python's standard library only.
"""
import json

from command_line import CommandLine, main


class Info(CommandLine):
    def test_scene(self):
        result = json.loads(self.succeed("info", "tiny.gltf", "--json", "--env", "1,2,3", "--light",
                                         "point pos=1,2,3 intensity=4"))
        self.assertEqual(result["counts"]["triangles"], 1)
        self.assertEqual(result["counts"]["lights"], 1)
        self.assertEqual(result["lights"][0]["position"], [1, 2, 3])
        self.assertEqual(result["bounds"], {"minimum": [-1, 0, 9], "maximum": [1, 1, 9]})
        self.assertEqual([camera["name"] for camera in result["cameras"]], ["front"])
        self.assertEqual(result["environment"]["radiance"], [1, 2, 3])
        self.assertEqual(result["warnings"], [])

    def test_warnings(self):
        self.assertEqual(json.loads(self.succeed("info", "tiny", "--json"))["warnings"],
                         ["nothing in the scene gives light"])
        self.assertIn("warning  nothing", self.succeed("info", "tiny"))

    def test_strict(self):
        square = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
        (self.folder / "whole.obj").write_text(square + "f 1 2 3\n")
        (self.folder / "torn.obj").write_text(square + "f 1 2 3\nf 1 2 9\nusemtl \033[31mred\n")
        self.succeed("info", "whole.obj", "--strict")
        self.succeed("render", "whole.obj", "--technique", "path-tracer", "--size", "4x4", "--samples", 1, "--strict",
                     "-o", "x.exr")
        self.succeed("info", "torn.obj")
        listed = self.run_program("info", "torn.obj", "--strict", "--json")
        self.assertEqual(listed.returncode, 2)
        self.assertEqual(listed.stderr.count("\n"), 1)
        warnings = json.loads(listed.stdout)["warnings"]
        self.assertEqual(len(warnings), 3)  # the face, the material, no light
        self.assertTrue(warnings[0].startswith("torn.obj: line 5: "))
        shown = self.run_program("render", "torn.obj", "--strict", "-o", "never.exr")
        self.assertEqual(shown.returncode, 2)
        self.assertEqual(shown.stderr.count("\n"), 3)  # one for each warning, one that says why it ends
        self.assertIn("--strict: 2 warnings", shown.stderr)
        for text in (shown.stderr, listed.stdout, listed.stderr, self.succeed("info", "torn.obj")):
            self.assertNotIn("\033", text)
        self.assertFalse((self.folder / "never.exr").exists())

    def test_devices(self):
        for device in json.loads(self.succeed("info", "--json")):
            self.assertTrue(device["name"])
        self.assertIn("device", self.succeed("info"))

    def test_techniques(self):
        techniques = json.loads(self.succeed("info", "--techniques", "--json"))
        path_tracer = next(technique for technique in techniques if technique["name"] == "path-tracer")
        self.assertIn("samples", [option["name"] for option in path_tracer["presets"][0]["options"]])
        for technique in techniques:
            self.assertTrue(technique["help"])
        self.assertIn("| `--samples` |", self.succeed("info", "--techniques"))


if __name__ == "__main__":
    main()
