#!/usr/bin/env python3
"""Tests of the command line as a user meets it: exit codes, one-line errors, no partial files.

cli_errors_test.py PROGRAM [unittest arguments]. Python's standard library only.
"""
import json
import os

from command_line import CommandLine, gray_png, main


class Help(CommandLine):
    def test_every_command_has_help(self):
        for command in ([], ["render"], ["compare"], ["bench"], ["bench", "flight"], ["bench", "many-light"], ["bench", "photon-splatting"], ["bench", "ray-traced-voxels"],
                        ["info"]):
            self.assertIn("--help", self.succeed(*command, "--help"))
        for option in ("--samples", "--max-bounces", "--seed"):
            self.assertIn(option, self.succeed("render", "--help"))

    def test_version(self):
        self.assertRegex(self.succeed("--version"), r"^lightwell \d+\.\d+\.\d+\n$")


class Errors(CommandLine):
    def test_commands(self):
        self.fail_with("subcommand is required")
        self.fail_with("'frobnicate' is not a command", "frobnicate")
        self.fail_with("SCENE", "render")
        self.fail_with("--output", "render", "tiny")
        self.fail_with("--frob", "render", "tiny", "-o", "x.exr", "--frob")
        self.fail_with("extra", "render", "tiny", "extra", "-o", "x.exr")
        self.fail_with("REFERENCE", "compare", "a.exr")
        self.fail_with("montage", "frobnicate")
        self.fail_with("--size: given more than once", "render", "tiny", "-o", "x.exr", "--size", "8x8", "--size", "9x9")
        self.fail_with("--samples: given more than once", "render", "tiny", "-o", "x.exr", "--samples", 1, "--samples", 2)
        self.fail_with("--frames: needs a value", "render", "tiny", "-o", "x.exr", "--frames")
        self.fail_with("--shadows: needs a value", "render", "tiny", "--shadows", "-o", "x.exr")
        self.fail_with("--size: needs a value", "render", "tiny", "-o", "x.exr", "--size", "--samples", 1)
        self.fail_with("lightwell montage --help", "montage")
        self.fail_with("--columns", "montage", "a.exr", "-o", "x.png", "--columns", "1.5")

    def test_options_of_another_method(self):
        path_tracer = ["render", "tiny", "-o", "x.exr", "--technique", "path-tracer"]
        self.fail_with("--light-samples: not an option of --technique path-tracer, which has --samples", *path_tracer,
                       "--light-samples", 3)
        self.fail_with("--technique light-volume --preset paper, which has", "render", "tiny", "-o", "x.exr",
                       "--preset", "paper", "--links", 3)
        self.fail_with("--photons: not an option of --technique path-tracer", *path_tracer, "--photons", 3)
        self.fail_with("--stats", *path_tracer, "--stats", "json")
        self.fail_with("--debug-views", *path_tracer, "--debug-views", "depth")
        photon_mapper = ["render", "tiny", "-o", "x.exr", "--technique", "photon-mapping"]
        self.fail_with("--k", *photon_mapper, "--k", 1)
        self.fail_with("--debug-views", *photon_mapper, "--debug-views", "depth")

    def test_debug_views(self):
        none = ["render", "tiny", "-o", "x.exr", "--technique", "none", "--size", "8x8", "--debug-views"]
        self.fail_with("there are: position", *none, "frob")
        self.fail_with("x.depth.exr", *none, "depth", "--aov", "depth")
        os.mkdir(self.folder / "x.albedo.exr")
        self.fail_with("x.albedo.exr", *none, "albedo")

    def test_values(self):
        cases = [
            ("--size", "0x0"), ("--size", "100000x100000"), ("--size", "7"), ("--size", "8x8x8"), ("--size", "-1x4"),
            ("--samples", "0"), ("--samples", "many"), ("--samples", "99999999999999"), ("--max-bounces", "-1"),
            ("--seed", "1.5"), ("--technique", "radiosity"), ("--set", "samples"), ("--set", "frob=1"),
            ("--camera", "back"), ("--fov", "180"), ("--scale", "0"), ("--scale", "nan"), ("--up", "x"),
            ("--exposure", "-1"), ("--aov", "direct,frob"), ("--light", "torch"), ("--sun", "1,2"),
            ("--env", "1,2"), ("--env", "none.hdr"),
            ("--grid-bounds", "0,0,0,1,1,0"), ("--grid-bounds", "0,0,0,1,1,nan"), ("--grid-bounds", "0,0,0,3e38,1,1"),
            ("--light", "point pos=0,0,0 intensity=1e30"), ("--light", "point pos=1e30,0,0 intensity=1"),
            ("--sun", "0,-1,0 1e30"),
        ]
        for option, value in cases:
            with self.subTest(option=option, value=value):
                name = value if option == "--env" else "--frob" if value == "frob=1" else option
                self.fail_with(name, "render", "tiny", "-o", "x.exr", option, value)
        self.fail_with("--target", "render", "tiny", "-o", "x.exr", "--eye", "1,2,3")
        self.fail_with("--target", "render", "tiny", "-o", "x.exr", "--eye", "1,2,3", "--target", "1,2,3")
        self.fail_with("--eye", "render", "tiny", "-o", "x.exr", "--eye", "1,2", "--target", "1,2,3")

    def test_scenes(self):
        self.fail_with("tiny", "render", "huge", "-o", "x.exr")  # lists the built-in ones
        self.fail_with("nowhere.glb", "info", "nowhere.glb")
        (self.folder / "broken.gltf").write_text("{")
        self.fail_with("broken.gltf", "info", "broken.gltf")
        self.fail_with("broken.gltf", "render", "broken.gltf", "-o", "x.exr")

    def test_outputs(self):
        self.fail_with("none/x.exr", "render", "tiny", "-o", "none/x.exr")
        self.fail_with("x.jpg", "render", "tiny", "-o", "x.jpg")
        self.fail_with("/proc/x.exr", "render", "tiny", "-o", "/proc/x.exr")
        os.mkdir(self.folder / "taken.exr")
        self.fail_with("taken.exr", "render", "tiny", "-o", "taken.exr")
        os.mkdir(self.folder / "x.indirect.exr")
        self.fail_with("x.indirect.exr", "render", "tiny", "-o", "x.exr", "--aov", "indirect")

    def test_read_only_folder(self):
        if os.geteuid() == 0:
            self.skipTest("root may write everywhere")
        os.mkdir(self.folder / "locked", 0o500)
        self.fail_with("locked", "render", "tiny", "-o", "locked/x.exr")

    def test_full_standard_output(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full")
        with open("/dev/full", "w") as full:
            result = self.run_program("info", "tiny", stdout=full)
        self.assertEqual(result.returncode, 2)
        self.assertIn("standard output", result.stderr)

    def test_compare(self):
        self.render("a.exr", "1,1,1")
        self.succeed("render", "tiny", "--size", "8x8", "--samples", 1, "--env", "1", "-o", "small.exr")
        self.fail_with("none.exr", "compare", "a.exr", "none.exr")
        self.fail_with("24x16 and 8x8", "compare", "a.exr", "small.exr")
        self.fail_with("tiny.gltf", "compare", "a.exr", "tiny.gltf")
        self.fail_with("--block", "compare", "a.exr", "a.exr", "--block", "0")
        self.fail_with("blocks of 17", "compare", "a.exr", "a.exr", "--block", "17")
        self.fail_with("d.exr", "compare", "a.exr", "a.exr", "--diff", "d.exr")
        self.fail_with("none/d.png", "compare", "a.exr", "a.exr", "--diff", "none/d.png")
        self.fail_with("a.exr", "compare", "a.exr", "a.exr", "--scene", "a.exr")
        (self.folder / "black.png").write_bytes(gray_png([[0] * 24] * 16))
        self.fail_with("mask leaves no pixel", "compare", "a.exr", "a.exr", "--mask", "black.png")
        (self.folder / "cut.exr").write_bytes((self.folder / "a.exr").read_bytes()[:-40])
        self.fail_with("cut.exr", "compare", "cut.exr", "a.exr")

    def test_compare_with_the_variance_of_the_reference(self):
        box = ["render", "cornell-spot", "--technique", "path-tracer", "--size", "24x24", "-o"]
        self.succeed(*box, "noisy.exr", "--samples", 32, "--aov", "variance", "--seed", 2)
        self.succeed(*box, "quiet.exr", "--samples", 512)
        self.succeed(*box, "dark.exr", "--samples", 512, "--max-bounces", 0)
        noise = ["noisy.exr", "--variance", "noisy.variance.exr"]
        quiet = json.loads(self.succeed("compare", "quiet.exr", *noise, "--json"))
        self.assertGreater(quiet["noise_part"], 0.7)
        self.assertFalse(quiet["significant"])
        self.assertTrue(json.loads(self.succeed("compare", "dark.exr", *noise, "--json"))["significant"])
        self.assertIn("not significant", self.succeed("compare", "quiet.exr", *noise))
        self.assertIn("is significant", self.succeed("compare", "dark.exr", *noise))
        self.fail_with("variance", *box, "one.exr", "--samples", 1, "--aov", "variance")
        self.fail_with("no variance", "render", "cornell-spot", "--technique", "none", "-o", "a.exr", "--aov", "variance")


if __name__ == "__main__":
    main()
