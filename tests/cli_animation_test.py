#!/usr/bin/env python3
"""Tests of the command line as a user meets it: moments of animated scenes.

cli_animation_test.py PROGRAM [unittest arguments]. Python's standard library only.
"""
import json

from command_line import CommandLine, main, moving_scene


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


if __name__ == "__main__":
    main()
