#!/usr/bin/env python3
"""Tests of the command line as a user meets it: exit codes, one-line errors, no partial files, values.

cli_test.py PROGRAM [unittest arguments]. Python's standard library only.
"""
import base64
import csv
import json
import math
import os
import struct
import xml.etree.ElementTree

from command_line import CommandLine, gray_png, main, tiny_scene


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


class Render(CommandLine):
    def test_files(self):
        self.render("a.exr", "1,1,1", "--aov", "direct,indirect,emission,albedo,normal,depth")
        self.render("b.png", "1,1,1", "--aov", "depth")
        names = {"tiny.gltf", "a.exr", "b.png", "b.depth.png"}
        names |= {"a.%s.exr" % aov for aov in ("direct", "indirect", "emission", "albedo", "normal", "depth")}
        self.assertEqual(set(os.listdir(self.folder)), names)

    def test_numbered_frames(self):
        steady = ["render", "tiny", "--technique", "none", "--size", "8x8"]
        self.succeed(*steady, "-o", "a.%03d.exr", "--frames", 2, "--debug-views", "depth")
        self.succeed(*steady, "-o", "b%d.exr", "--aov", "direct")  # without --frames: until nothing changes
        self.render("c.%d.png", "1")  # the path tracer has one frame
        names = {"tiny.gltf", "b0.exr", "b0.direct.exr", "c.0.png"}
        names |= {"a.%03d%s.exr" % (frame, view) for frame in (0, 1) for view in ("", ".depth")}
        self.assertEqual(set(os.listdir(self.folder)), names)

    def test_warnings_about_grids(self):
        technique = ["render", "tiny", "--technique", "ambient", "--size", "8x8", "--env", "1", "-o", "a.exr", "--grid-bounds"]
        self.assertIn("nothing of the scene", self.run_program(*technique, "100,0,0,101,1,1").stderr)
        self.assertEqual(self.run_program(*technique, "0,0,0,1,1,9.5").stderr, "")

    def test_a_warning_about_darkness(self):
        dark = ["render", "tiny", "--technique", "path-tracer", "--samples", 1, "--size", "8x8", "-o", "a.exr"]
        self.assertIn("warning: the picture is black", self.run_program(*dark).stderr)
        self.assertEqual(self.run_program(*dark, "--env", "0,0,0.1").stderr, "")

    def test_the_environment_is_emission(self):
        self.render("a.exr", "1,0.5,0.25", "--aov", "direct,emission")
        self.assertEqual(self.compare("a.exr", "a.emission.exr")["max_abs"], 0)
        self.assertEqual(self.compare("a.direct.exr", "a.exr")["mean_test"], 0)

    def test_environments_of_few_texels(self):
        for rows in ([[0.5]], [[0.25, 0.75]], [[0.25], [0.75]], [[0.5, 0, 0.75]]):
            (self.folder / "few.hdr").write_bytes(hdr(rows))
            for technique in ("none", "path-tracer"):
                self.succeed("render", "tiny", "--technique", technique, "--size", "8x8", "--samples", 64, "--env",
                             "few.hdr", "--eye", "0,0,0", "--target", "-1,0.5,-1", "-o", technique + ".exr")
            self.assertLess(self.compare("none.exr", "path-tracer.exr")["max_abs"], 0.02, rows)

    def test_photon_mapping(self):
        command = ["render", "cornell-spot", "--technique", "photon-mapping", "--photons", 2000, "--k", 10, "--size",
                   "16x16", "--samples", 1, "--progressive", 2, "--aov", "direct,indirect", "-o", "a.exr", "--stats"]
        statistics = json.loads(self.succeed(*command, "json"))
        self.assertEqual(statistics["emitted"], 4000)
        self.assertGreater(statistics["stored"], statistics["photons_kept"])
        self.assertGreater(statistics["bytes_per_photon"], 36)
        self.assertLess(statistics["bytes_per_photon"], 80)
        for time in ("emission_ms", "tree_ms", "camera_ms", "query_ms", "us_per_query"):
            self.assertGreater(statistics[time], 0)
        self.assertIn("4000 photons sent", self.succeed(*command, "text"))
        self.assertGreater(self.compare("a.indirect.exr", "a.indirect.exr")["mean_test"], 0)

    def test_png_is_exposed_and_tone_mapped(self):
        self.render("a.png", "1.5", "--exposure", "2")
        code = round(255 * srgb(3 / 4)) / 255
        linear = ((code + 0.055) / 1.055) ** 2.4
        self.assertAlmostEqual(self.compare("a.png", "a.png")["mean_test"], linear, places=6)

    def test_the_same_seed_gives_the_same_bytes(self):
        self.render("a.exr", "1,1,1", "--eye", "0,0.5,5", "--target", "0,0.3,9", "--fov", "30")
        self.render("b.exr", "1,1,1", "--eye", "0,0.5,5", "--target", "0,0.3,9", "--fov", "30", "--seed", "1")
        self.assertEqual((self.folder / "a.exr").read_bytes(), (self.folder / "b.exr").read_bytes())

    def test_nothing_reflects_more_light_than_it_gets(self):
        (self.folder / "white.mtl").write_text("newmtl white\nKd 2 0.5 2\n")
        (self.folder / "white.obj").write_text("mtllib white.mtl\nusemtl white\nv -9 -9 0\nv 9 -9 0\nv 0 9 0\nf 1 2 3\n")
        result = self.run_program("render", "white.obj", "--technique", "path-tracer", "--samples", 1, "--size", "8x8",
                                  "--eye", "0,0,1", "--target", "0,0,0", "--aov", "albedo", "-o", "a.exr")
        self.assertIn("white.obj: 1 materials reflect more", result.stderr)
        self.assertAlmostEqual(self.compare("a.albedo.exr", "a.albedo.exr")["mean_test"], 2.5 / 3, places=6)

    def test_coordinates_may_be_negative(self):
        self.render("a.exr", "1", "--eye", "-1,0.5,5", "--target", "-.5,0,9", "--light", "point pos=-1,2,3 intensity=1",
                    "--light", "sun dir=0,-1,0 irradiance=2,2,2", "--sun", "-1,-1,0 3")


class Animations(CommandLine):
    def setUp(self):
        super().setUp()
        (self.folder / "moving.gltf").write_text(json.dumps(moving_scene()))
        self.on_cpu = ["render", "moving", "--technique", "path-tracer", "--size", "8x8", "--samples", 1]
        self.on_gpu = ["render", "moving", "--technique", "none", "--size", "8x8", "--samples", 2]

    def mean(self, file):
        return self.compare(file, file)["mean_test"]

    def means(self, names):
        return [round(self.mean(name), 5) for name in names]

    def test_moments(self):
        photons = ["photon-mapping" if part == "path-tracer" else part for part in self.on_cpu]
        for method, command in (("cpu", self.on_cpu), ("photons", photons), ("gpu", self.on_gpu)):
            with self.subTest(method=method):
                self.succeed(*command, "--frames", 4, "--fps", 4, "--time", 0.25, "-o", method + ".%02d.exr")
                self.assertEqual(self.means("%s.%02d.exr" % (method, k) for k in range(4)), [0.75, 0.5, 0.25, 0])
                self.assertFalse((self.folder / (method + ".04.exr")).exists())
                self.succeed(*command, "--frames", 2, "--fps", 4, "--time", 0.25, "-o", method + ".exr")
                self.assertEqual(self.means([method + ".exr"]), [0.5])

    def test_a_moment_is_the_same_alone_and_in_a_row(self):
        self.succeed(*self.on_cpu, "--frames", 2, "--fps", 2, "-o", "row.%d.exr")
        self.succeed(*self.on_cpu, "--time", 0.5, "-o", "alone.exr")
        self.assertEqual((self.folder / "row.1.exr").read_bytes(), (self.folder / "alone.exr").read_bytes())

    def test_each_moment_takes_its_samples(self):
        statistics = json.loads(self.succeed(*self.on_gpu, "--frames", 3, "-o", "a.exr", "--stats", "json"))
        self.assertEqual(statistics["frames"], 2)

    def test_the_first_frames_time_is_divided(self):
        statistics = json.loads(self.succeed(*self.on_gpu, "--time", 0, "-o", "a.exr", "--stats", "json"))
        first = statistics["first_frame"]
        self.assertGreater(first.pop("pipelines"), 0)
        self.assertGreaterEqual(min(first.values()), 0)
        self.assertLess(sum(first.values()) - first["setup_ms"], statistics["wall_time_ms"])

    def test_times_of_frames_add_up(self):
        statistics = json.loads(self.succeed(*self.on_gpu, "--time", 0, "-o", "a.exr", "--stats", "json"))
        frames = [p["frames"] for p in statistics["passes"]]
        self.assertEqual((min(frames), max(frames)), (1, statistics["frames"]))  # a hierarchy is built once
        self.assertLess(statistics["gpu_time_ms"] * (statistics["frames"] - 1), statistics["wall_time_ms"])

    def test_standing_still(self):
        for time, mean in ((0, 1), (0.75, 0.25), (1, 0), (99999, 0)):
            for command in (self.on_cpu, self.on_gpu):
                self.succeed(*command, "--time", time, "-o", "a.exr")
                self.assertEqual(self.means(["a.exr"]), [mean], (time, command))

    def test_choice(self):
        for chosen, means in (("slide", [0.5, 0]), ("jump", [1, 0]), ("1", [1, 0]), ("2", [0.5, 0])):
            self.succeed(*self.on_cpu, "--animation", chosen, "--fps", 2, "--time", 0.5, "--frames", 2, "-o", "a%d.exr")
            self.assertEqual(self.means(["a0.exr", "a1.exr"]), means, chosen)
        # What is moved by no animation before it comes along: square and camera, but not the jump.
        scene = moving_scene()
        del scene["animations"][2]["channels"][1]
        (self.folder / "both.gltf").write_text(json.dumps(scene))
        self.on_cpu[1] = "both"
        for more, mean in (([], 1), (["--animation", "slide"], 0.5), (["--animation", "look"], 0.5)):
            self.succeed(*self.on_cpu, *more, "--time", 0.5, "-o", "a.exr")
            self.assertEqual(self.means(["a.exr"]), [mean], more)

    def test_cameras(self):
        # A camera of the scene moves with its node, one of the command line does not.
        look = [*self.on_cpu, "--animation", "look", "--time", 0.5, "-o", "a.exr"]
        self.succeed(*look, "--camera", "front")
        self.assertEqual(self.means(["a.exr"]), [0.5])
        self.succeed(*look, "--eye", "0,0,0", "--target", "0,0,-1", "--fov", 90)
        self.assertEqual(self.means(["a.exr"]), [1])
        # Without any, the view holds the whole animation, and is static: the square crosses it from side to side.
        scene = moving_scene()
        del scene["cameras"], scene["nodes"][1]["camera"]
        (self.folder / "blind.gltf").write_text(json.dumps(scene))
        self.succeed("render", "blind", "--technique", "path-tracer", "--size", "8x8", "--samples", 256, "--frames", 3,
                     "--fps", 2, "-o", "b%d.exr")
        first, middle, last = self.means(["b%d.exr" % k for k in range(3)])
        self.assertGreater(min(first, middle, last), 0.1)
        self.assertLess(max(first, middle, last) / min(first, middle, last), 1.1)

    def test_values(self):
        for option, value in (("--time", "nan"), ("--time", "-1"), ("--time", "1e30"), ("--time", "soon"),
                              ("--fps", "0"), ("--fps", "-24"), ("--fps", "nan"), ("--fps", "inf"), ("--fps", "1e30"),
                              ("--frames", "-1"), ("--frames", "1.5"), ("--frames", "99999999999")):
            for command in (self.on_cpu, self.on_gpu):
                with self.subTest(option=option, value=value):
                    self.fail_with(option, *command, "-o", "x.exr", option, value)
        self.fail_with("no animation 'walk' in the scene (there are: 0 slide, 1 jump, 2 look)", *self.on_cpu, "-o", "x.exr",
                       "--animation", "walk")
        self.fail_with("--animation", *self.on_cpu, "-o", "x.exr", "--animation", "3")
        self.fail_with("--animation", *self.on_cpu, "-o", "x.exr", "--animation", "-1")
        self.succeed(*self.on_cpu, "-o", "a.exr", "--frames", 0)  # a static moment
        self.assertEqual(self.means(["a.exr"]), [1])

    def test_scenes_without_animation(self):
        for option, value in (("--time", "0"), ("--fps", "24"), ("--animation", "0")):
            self.fail_with(option + ": the scene tiny has no animation", "render", "tiny", "--technique", "path-tracer",
                           "-o", "x.exr", option, value)
            self.fail_with(option, "bench", "tiny", "--technique", "none", option, value)
        self.fail_with("--frames: --technique path-tracer", "render", "tiny", "--technique", "path-tracer",
                       "-o", "x.%d.exr", "--frames", 3)
        self.fail_with("--animate: the scene tiny has no animation", "bench", "tiny", "--technique", "none", "--animate")

    def test_what_leaves_the_world(self):
        scene = moving_scene()
        scene["nodes"].append({"children": [0], "scale": [1e9, 1, 1]})
        (self.folder / "far.gltf").write_text(json.dumps(scene))
        self.on_cpu[1] = "far"
        self.fail_with("far: at 1 s of the animation", *self.on_cpu, "--time", 1, "-o", "x.exr")

    def test_info(self):
        result = json.loads(self.succeed("info", "moving", "--json"))
        self.assertEqual(result["animations"],
                         [{"name": name, "seconds": 1, "channels": channels}
                          for name, channels in (("slide", 1), ("jump", 1), ("look", 2))])
        self.assertEqual((result["skins"], result["morph_targets"]), ([], []))
        self.assertIn("animation  name jump  seconds 1  channels 1", self.succeed("info", "moving"))
        scene = moving_scene()
        scene["skins"] = [{"joints": [0, 1]}]
        scene["meshes"][0].update({"name": "face", "weights": [0, 0]})
        scene["meshes"][0]["primitives"][0]["targets"] = [{}, {}]
        (self.folder / "person.gltf").write_text(json.dumps(scene))
        result = json.loads(self.succeed("info", "person", "--json"))
        self.assertEqual(result["skins"], [{"joints": 2}])
        self.assertEqual(result["morph_targets"], [{"mesh": "face", "targets": 2}])

    def test_bench_flight(self):
        flight = ["bench", "flight", "cornell-dynamic", "--frames", 3, "--warm-up", 2, "--points", 20, "--rays", 4, "--size", "8x8"]
        result = json.loads(self.succeed(*flight, "--json"))
        self.assertEqual((result["frames"], result["points"], len(result["each"])), (3, 20, 3))
        self.assertGreater(result["true_irradiance"], 0)
        self.assertGreater(result["changes"]["max"], 0)  # its lights move
        self.assertNotIn("largest_change", result["each"][0])
        self.assertIn("3 frames, 20 points", self.succeed(*flight))
        self.fail_with("--technique", *flight, "--technique", "many-light")
        self.fail_with("--technique", *flight, "--technique", "none")
        self.fail_with("--technique", *flight, "--technique", "path-tracer")
        self.fail_with("--points", *flight[:3], "--points", 0)

    def test_bench(self):
        bench = ["bench", "moving", "--technique", "none", "--size", "8x8", "--frames", 5, "--warm-up", 1, "--json"]
        for more in (["--animate", "--fps", 3], ["--animate", "--move-lights", "--animation", "look"], ["--time", 0.5]):
            self.assertEqual(json.loads(self.succeed(*bench, *more))["frames"], 5)


class Compare(CommandLine):
    def setUp(self):
        super().setUp()
        self.render("test.exr", "2,1,0.5")
        self.render("truth.exr", "1,1,1")

    def test_values(self):
        result = self.compare("test.exr", "truth.exr")
        self.assertEqual(result["pixels"], 24 * 16)
        self.assertEqual(result["bad_pixels"], 0)
        self.assertAlmostEqual(result["relMSE"], (1 + 0.25) / 1.01 / 3, places=9)
        self.assertAlmostEqual(result["energy"], 3.5 / 3, places=9)
        self.assertEqual(result["energy_rgb"], [2, 1, 0.5])
        self.assertEqual(result["rmse8"], 255 - round(255 * srgb(0.5)))
        code = lambda x: round(255 * srgb(x / (1 + x)))
        self.assertEqual(result["rmse8_tm"], code(2) - code(1) + code(1) - code(0.5))
        self.assertEqual(result["max_abs"], 1)
        self.assertTrue(0 < result["flip"] < 1)
        self.assertTrue(math.isclose(result["exposure"], 1))

    def test_mask_by_codes(self):
        (self.folder / "mask.png").write_bytes(gray_png([[128] * 12 + [127] * 12] * 16))
        self.assertEqual(self.compare("test.exr", "truth.exr", "--mask", "mask.png")["pixels"], 12 * 16)

    def test_block_and_scene_file(self):
        scene = {"exposure": 0.5, "references": [{"combined": "truth.exr", "noise_relMSE": 0.125}]}
        (self.folder / "scene.json").write_text(json.dumps(scene))
        result = self.compare("test.exr", "truth.exr", "--scene", "scene.json")
        self.assertEqual((result["exposure"], result["relMSE_floor"]), (0.5, 0.125))
        result = self.compare("test.exr", "truth.exr", "--scene", "scene.json", "--exposure", "2", "--block", "4")
        self.assertEqual((result["exposure"], result["pixels"]), (2, 6 * 4))
        self.assertNotIn("relMSE_floor", result)

    def test_heat_map_and_table(self):
        table = self.succeed("compare", "test.exr", "truth.exr", "--diff", "heat.png")
        self.assertIn("relMSE", table)
        self.assertTrue((self.folder / "heat.png").read_bytes().startswith(b"\x89PNG"))


class Bench(CommandLine):
    def test_frames(self):
        devices = json.loads(self.succeed("info", "--json"))
        if not any(not device["missing"] for device in devices):
            self.skipTest("no Vulkan device")
        result = json.loads(self.succeed("bench", "tiny", "--light", "point pos=0,0,8 intensity=1", "--technique", "none",
                                         "--size", "24x16", "--frames", 4, "--warm-up", 1, "--move-lights", "--json"))
        self.assertEqual(result["frames"], 4)
        self.assertEqual(result["lights"], 1)
        for times in (result["wall_ms"], result["gpu_ms"], *(p["ms"] for p in result["passes"])):
            self.assertTrue(0 <= times["min"] <= times["median"] <= times["max"])
        self.assertLessEqual(result["gpu_ms"]["mean"], result["wall_ms"]["mean"])
        self.assertAlmostEqual(sum(p["ms"]["mean"] for p in result["passes"]), result["gpu_ms"]["mean"], places=6)
        self.assertEqual(result["memory_bytes"], sum(m["bytes"] for m in result["memory"]))
        self.assertNotIn("read back", [p["name"] for p in result["passes"]])

    def test_rays(self):
        devices = json.loads(self.succeed("info", "--json"))
        if not any(not device["missing"] for device in devices):
            self.skipTest("no Vulkan device")
        result = json.loads(self.succeed("rays", "tiny", "--rays", 1000, "--repeat", 1, "--json"))
        self.assertEqual(result["structures"][0]["tracing"], "bvh")
        self.assertGreater(result["structures"][0]["build_ms"], 0)
        for row in result["rates"]:
            self.assertEqual(row["count"], 1000)
            self.assertGreater(row["rays_per_s"], 0)
            self.assertLessEqual(abs(row["hits"] - row["embree_hits"]), 1)

    def test_many_light(self):
        if "many-light" not in [t["name"] for t in json.loads(self.succeed("info", "--techniques", "--json"))]:
            self.skipTest("no technique many-light in this build")
        if not any(not device["missing"] for device in json.loads(self.succeed("info", "--json"))):
            self.skipTest("no Vulkan device")
        tiny = ["bench", "many-light", "--vpls", "64,512", "--size", "32x32", "--resolution", 32, "--frames", 2]
        result = json.loads(self.succeed(*tiny, "--json"))
        self.assertEqual(result["left_out"], ["sponza-crytek"])
        self.assertEqual([(t["scene"], t["preset"]) for t in result["tables"]],
                         [("cornell-dynamic", "paper"), ("cornell-dynamic", "best")])
        for table in result["tables"]:
            self.assertEqual((table["size"], table["resolution"]), ("32x32", "32"))
            self.assertEqual([column["vpls"] for column in table["columns"]], [64, 512])
            self.assertEqual(["published" in column for column in table["columns"]], [False, True])
            for column in table["columns"]:
                self.check_many_light_column(column, table["preset"])
            self.assertEqual(table["columns"][0]["indirect_to_first"], 1)
            self.assertEqual(table["columns"][1]["published"]["stages"][4]["ms"], 16)
        text = self.succeed(*tiny, "--preset", "paper")
        for stage in ("voxels and octree", "RSM", "VPLs", "direct light", "indirect light", "all other"):
            self.assertEqual(text.count("\n" + stage), 1)

    def check_many_light_column(self, column, preset):
        """Stages add up to their sum, and with all other passes to the fastest frame; none took no time, but for those that
        the preset does without."""
        times = [stage["ms"] for stage in column["stages"]]
        made_by_none = ("voxels and octree", "RSM") if preset == "best" else ()
        for stage in column["stages"]:
            self.assertTrue(stage["ms"] > 0 or stage["name"] in made_by_none, stage)
        self.assertAlmostEqual(sum(times[:-1]), column["sum_ms"], places=6)
        self.assertAlmostEqual(sum(times), column["bench"]["gpu_ms"]["min"], places=6)
        self.assertAlmostEqual(sum(stage.get("share", 0) for stage in column["stages"]), 1, places=6)

    def test_many_light_errors(self):
        many_light = ["bench", "many-light"]
        self.fail_with("SCENE is required", "bench")
        self.fail_with("--technique", *many_light, "--technique", "none")
        self.fail_with("SCENE", *many_light, "tiny")
        self.fail_with("--scenes", *many_light, "--scenes", "tiny")
        self.fail_with("--vpls", *many_light, "--vpls", "512,")
        self.fail_with("--size-scale", *many_light, "--size", "8x8", "--size-scale", "2")

    def test_ray_traced_voxels(self):
        techniques = {t["name"]: t for t in json.loads(self.succeed("info", "--techniques", "--json"))}
        if "ray-traced-voxels" not in techniques:
            self.skipTest("no technique ray-traced-voxels in this build")
        if not any(not device["missing"] for device in json.loads(self.succeed("info", "--json"))):
            self.skipTest("no Vulkan device")
        small = ["bench", "ray-traced-voxels", "--grids", 64, "--rays", "256,512", "--size-scale", 0.05, "--rays-scale", 0.1,
                 "--frames", 1]
        result = json.loads(self.succeed(*small, "--rounds", 2, "--table", "7.2", "--table", "7.3", "--table", "7.7", "--json"))
        self.assertEqual([table["table"] for table in result["tables"]], ["7.2", "7.3", "7.7"])
        for table in result["tables"]:
            for row in table["rows"]:
                self.check_voxels_row(row)
        plain, average, taps = (table["rows"] for table in result["tables"])
        self.assertEqual([(row["settings"]["light"], row["settings"]["rays"]) for row in average],
                         [(light, rays) for light in ("far", "near") for rays in ("26", "51")])
        self.assertEqual(average[3]["base"], plain[3]["settings"])
        self.assertAlmostEqual(average[3]["ratio"]["inject"], average[3]["ms"]["inject"] / plain[3]["ms"]["inject"])
        self.assertEqual(average[3]["published"]["ms"], {"voxelise": 0.331098, "inject": 7.32731, "final": 0.156015})
        self.assertAlmostEqual(average[3]["published"]["ratio"]["inject"], 7.32731 / 0.0824932)
        self.assertEqual([(row["settings"]["taps"], row["settings"]["size"]) for row in taps],
                         [(n, size) for n in "17" for size in ("32x24", "64x36", "96x54")])
        self.assertEqual(taps[4]["base"], taps[1]["settings"])
        self.assertEqual(taps[0]["ratio"], {"voxelise": 1, "inject": 1, "final": 1})
        self.assertEqual((average[1]["settings"], average[1]["rounds"]), (taps[5]["settings"], taps[5]["rounds"]))

        text = self.succeed(*small, "--table", "5.1", "--table", "presets")
        self.assertIn("5.1  Two scenes; ratios to the first row", text)
        self.assertEqual(text.count("\nroom "), 1 + 2 * len(techniques["ray-traced-voxels"]["presets"]))

    def check_voxels_row(self, row):
        """Stages take no more than the one frame of each round, after one from nothing; parts of the injection add up."""
        self.assertEqual(row["settings"]["scene"], "cornell-spot")
        self.assertTrue(all(row["ms"][stage] > 0 for stage in ("voxelise", "inject", "final")), row)
        self.assertEqual([result["frames"] for result in row["rounds"]], [2, 2])
        fastest = min(sum(p["each_ms"][1] for p in result["passes"]) for result in row["rounds"])
        self.assertLessEqual(sum(row["ms"].values()) + row["other_ms"], fastest + 1e-6)
        parts = row["inject_parts"]
        self.assertAlmostEqual(parts["trace_ms"] + parts["write_ms"] + parts["clear_ms"], row["ms"]["inject"], places=6)
        for ratios in (row["ratio"], row["published"]["ratio"]):
            self.assertEqual(list(ratios), ["voxelise", "inject", "final"])

    def test_ray_traced_voxels_errors(self):
        if "ray-traced-voxels" not in [t["name"] for t in json.loads(self.succeed("info", "--techniques", "--json"))]:
            self.skipTest("no technique ray-traced-voxels in this build")
        voxels = ["bench", "ray-traced-voxels"]
        self.fail_with("--table: '7.9' (there are: 5.1, 7.1", *voxels, "--table", "7.9")
        self.fail_with("--preset", *voxels, "--preset", "quick")
        self.fail_with("nowhere.gltf", *voxels, "--table", "7.1", "--table", "7.3", "--sibenik", "nowhere.gltf", "-q")
        self.fail_with("--grids", *voxels, "--grids", "64,")
        self.fail_with("--size-scale", *voxels, "--size-scale", 0)
        self.fail_with("--technique", *voxels, "--technique", "none")

    def test_photon_splatting(self):
        if "photon-splatting" not in [t["name"] for t in json.loads(self.succeed("info", "--techniques", "--json"))]:
            self.skipTest("no technique photon-splatting in this build")
        if not any(not device["missing"] for device in json.loads(self.succeed("info", "--json"))):
            self.skipTest("no Vulkan device")
        settings = ["photon-mapping", "small-maps", "stratified-256", "best"]
        small = ["bench", "photon-splatting", "--size", "48x48", "--frames", 3, "--samples", 16, "--photons-scale", 0.02]
        result = json.loads(self.succeed(*small, *(word for name in settings for word in ("--setting", name)),
                                         "--csv", "x.csv", "--svg", "x.svg", "--json"))
        self.assertEqual(result["left_out"], ["conference"])
        [scene] = result["scenes"]
        self.assertEqual(scene["scene"], "cornell-spot")
        self.assertTrue(0 < scene["pixels"] < 48 * 48)
        self.assertAlmostEqual(scene["exposure"] * scene["truth"]["mean"], 0.18, places=6)
        self.assertEqual(scene["truth"]["samples"], 16)
        self.assertGreater(scene["truth"]["noise_rmse8"], 0)

        mapper, maps, stratified, best = scene["curves"]
        self.assertEqual([curve["setting"] for curve in scene["curves"]], settings)
        self.assertEqual([point["photons"] for point in mapper["points"]], [63, 250, 1000, 4000])
        self.assertEqual([point["photons"] for point in maps["points"]], [31, 125, 500, 2000])
        self.assertEqual([point["frames"] for point in best["points"]], [1, 2, 3])
        for curve in scene["curves"]:
            for point in curve["points"]:
                self.assertEqual("k" in point, curve is mapper)
                self.assertEqual(point["factor"] != 1, curve in (maps, stratified))
                self.assertTrue(point["time_ms"] > 0 and point["rmse8"] >= 0 and point["relMSE"] >= 0, point)
        self.assertLess(mapper["points"][-1]["rmse8"], mapper["points"][0]["rmse8"])
        self.assertAlmostEqual(best["points"][2]["time_ms"], 3 * best["points"][0]["time_ms"])
        self.check_equal_error(scene["equal_error"], best["points"])

        memory = {row["setting"]: row for row in scene["memory"]}
        self.assertEqual(list(memory), settings)
        self.assertEqual(memory["stratified-256"]["published"], {"photons": 25000, "bytes": 576 * 2**20})
        self.assertNotIn("published", memory["best"])
        for row in memory.values():
            self.assertAlmostEqual(row["bytes_a_photon"] * row["photons"], row["photon_bytes"], places=3)
            self.assertLessEqual(row["splat_bytes"], row["photon_bytes"])
        self.assertGreaterEqual(memory["small-maps"]["map_bytes"], 500 * 4 * 4 * 4)
        self.check_files_of_curves(scene)

    def check_equal_error(self, rows, best):
        """`best` has the mapper's error at a time that its own errors put it to."""
        self.assertEqual([row["mapper"]["photons"] for row in rows], [63, 250, 1000, 4000])
        for row in rows:
            wanted = row["mapper"]["rmse8"]
            reached = [point for point in best if point["rmse8"] <= wanted]
            self.assertEqual(row["best_ms"] is not None, bool(reached))
            if not reached:
                continue
            self.assertEqual(row["at_most"], reached[0] is best[0])
            before = best[max(best.index(reached[0]) - 1, 0)]
            self.assertTrue(before["time_ms"] - 1e-9 <= row["best_ms"] <= reached[0]["time_ms"] + 1e-9)
            self.assertAlmostEqual(row["ratio"], row["best_ms"] / row["mapper"]["time_ms"])

    def check_files_of_curves(self, scene):
        points = [(curve["setting"], point) for curve in scene["curves"] for point in curve["points"]]
        with open(self.folder / "x.csv", encoding="utf-8") as f:
            head, *lines = csv.reader(f)
        self.assertEqual(head, ["scene", "setting", "photons", "frames", "k", "time_ms", "rmse8", "relMSE", "energy", "factor"])
        self.assertEqual(len(lines), len(points))
        for line, (setting, point) in zip(lines, points):
            self.assertEqual(line[:4], ["cornell-spot", setting, str(point["photons"]), str(point["frames"])])
            for name, text in zip(head[5:], line[5:]):
                self.assertAlmostEqual(float(text), point[name], delta=1e-5 * abs(point[name]))
        svg = "{http://www.w3.org/2000/svg}"
        picture = xml.etree.ElementTree.parse(self.folder / "x.svg").getroot()
        self.assertEqual(picture.tag, svg + "svg")
        shown = sum(point[error] > 0 for _, point in points for error in ("rmse8", "relMSE"))
        self.assertEqual(len(picture.findall(svg + "circle")), shown)
        texts = [text.text for text in picture.findall(svg + "text")]
        for curve in scene["curves"]:
            self.assertEqual(texts.count(curve["setting"]), 1)
        self.assertEqual(texts.count("cornell-spot"), 2)

    def test_photon_splatting_text(self):
        if "photon-splatting" not in [t["name"] for t in json.loads(self.succeed("info", "--techniques", "--json"))]:
            self.skipTest("no technique photon-splatting in this build")
        if not any(not device["missing"] for device in json.loads(self.succeed("info", "--json"))):
            self.skipTest("no Vulkan device")
        text = self.succeed("bench", "photon-splatting", "--scenes", "cornell-spot", "--setting", "photon-mapping", "--size",
                            "32x32", "--samples", 4, "--photons-scale", 0.01)
        self.assertEqual(text.count("\nphoton-mapping"), 5)
        self.assertNotIn("equal RMSE", text)

    def test_photon_splatting_errors(self):
        if "photon-splatting" not in [t["name"] for t in json.loads(self.succeed("info", "--techniques", "--json"))]:
            self.skipTest("no technique photon-splatting in this build")
        splatting = ["bench", "photon-splatting"]
        self.fail_with("--setting: 'tiny-maps' (there are: photon-mapping, small-maps", *splatting, "--setting", "tiny-maps")
        self.fail_with("--scenes: 'tiny' (there are: cornell-spot, conference)", *splatting, "--scenes", "tiny")
        self.fail_with("nowhere.gltf", *splatting, "--scenes", "conference", "--conference", "nowhere.gltf")
        self.fail_with("nowhere", *splatting, "--scenes", "conference", "--svg", "nowhere/x.svg", "-q")
        self.fail_with("--bounces", *splatting, "--bounces", 0)
        self.fail_with("--samples", *splatting, "--samples", 1)
        self.fail_with("--technique", *splatting, "--technique", "none")

    def test_errors(self):
        self.fail_with("--frames", "bench", "tiny", "--technique", "none", "--frames", "0")
        self.fail_with("--rays", "rays", "tiny", "--rays", "0")
        self.fail_with("--technique", "bench", "tiny", "--technique", "path-tracer")


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
