#!/usr/bin/env python3
"""Tests of what scripts/results stands on: scenes with their light, truths with their noise, scenes that move.

figures_test.py PROGRAM [unittest arguments]. Python's standard library only.
"""
import json
import math
import os
import random
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "scripts"))

import cli  # noqa: E402
import extent_scenes  # noqa: E402
import figures  # noqa: E402
import pixels  # noqa: E402
from moving_scene import MovingScene, cross, looking_along  # noqa: E402
from town_scene import town  # noqa: E402


class Figures(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        figures.OUT = temporary.name
        self.section = figures.Section("test")

    def file(self, name):
        return os.path.join(figures.OUT, name)


class LitScenes(Figures):
    def test_each_is_understood_by_the_program(self):
        left_out = []
        for name in figures.lit_scene_names():
            try:
                scene = figures.LitScene(name)
            except figures.Missing as reason:
                left_out.append(str(reason))
                continue
            options = [option for option in scene.options if not option.startswith("--time")]
            warnings = self.section.run_json("info", scene.path, *options, "--json")["warnings"]
            looks = [line for line in warnings if "are shown diffuse" in line or " is not shown" in line]
            self.assertEqual(warnings, looks)  # what surfaces look like is known not to be all of it; nothing else is lost
            for camera in scene.cameras if os.path.dirname(scene.path) == os.path.join(ROOT, "scenes") else ["own"]:
                self.section.run("render", scene.path, *scene.view(camera), "--technique", "path-tracer", "--size", "4x4",
                                 "--samples", 1, "-q", "-o", self.file("x.exr"))
        if left_out:
            self.skipTest("the others are understood; " + ", ".join(left_out))

    def test_words(self):
        self.assertEqual(figures.words({"light": ["a", "b"], "sun": "-1,0,0 2"}), ["--light=a", "--light=b", "--sun=-1,0,0 2"])


class Truths(Figures):
    def make(self, noise, most_samples):
        return figures.quiet_truth(self.section, cli.scene_file("cornell-spot"), "16x16", 2, [], noise, most_samples)

    def test_paths_are_added_until_noise_is_low(self):
        rough = self.make(1e9, 1024)
        self.assertEqual(rough.samples, 2 * figures.SAMPLES_AT_ONCE)
        fine = self.make(rough.noise / 3, 4096)
        self.assertLessEqual(fine.noise, rough.noise / 3)
        self.assertGreater(fine.samples, rough.samples)
        limited = self.make(1e-9, 4 * figures.SAMPLES_AT_ONCE)
        self.assertEqual(limited.samples, 4 * figures.SAMPLES_AT_ONCE)

    def test_what_is_there_is_kept(self):
        first = self.make(1e9, 1024)
        runs = [c for c in self.section.commands if c.startswith("build/lightwell render")]
        again = self.make(1e9, 1024)
        self.assertEqual([c for c in self.section.commands if c.startswith("build/lightwell render")], runs)
        self.assertEqual((again.path, again.noise, again.samples), (first.path, first.noise, first.samples))

    def test_mean_and_noise(self):
        """The noise that is estimated is that against a much longer truth, within a factor of two."""
        short, long = self.make(1e9, 1024), self.make(1e-9, 64 * figures.SAMPLES_AT_ONCE)
        error = self.section.compare(figures.part(short.path, "indirect"), figures.part(long.path, "indirect"), "--block", 4)
        self.assertLess(abs(math.log2(error["relMSE"] / (short.noise + long.noise))), 1.5)
        halves = [pixels.load_exr(figures.part(short.path, half)) for half in ("half0", "half1")]
        mean = pixels.load_exr(figures.part(short.path, "indirect"))
        for y, row in enumerate(mean):
            for x, pixel in enumerate(row):
                for c in range(3):
                    self.assertAlmostEqual(pixel[c], (halves[0][y][x][c] + halves[1][y][x][c]) / 2, places=5)


class MovingScenes(Figures):
    def test_looking_along(self):
        generator = random.Random(7)  # seed
        directions = [[generator.gauss(0, 1) for _ in range(3)] for _ in range(200)]
        for direction in directions + [(0, -1, 0), (0, 1, 0), (0, 0, 1), (0, 0, -1), (1, 0, 0)]:
            x, y, z, w = looking_along(direction)
            self.assertAlmostEqual(x * x + y * y + z * z + w * w, 1)
            forward = (0, 0, -1)
            t = [2 * v for v in cross((x, y, z), forward)]
            turned = [a + w * b + c for a, b, c in zip(forward, t, cross((x, y, z), t))]
            length = math.sqrt(sum(v * v for v in direction))
            for a, b in zip(turned, direction):
                self.assertAlmostEqual(a, b / length)

    def test_camera_and_light(self):
        scene = MovingScene(cli.scene_file("cornell-spot"))
        scene.move(scene.node("main"), (0, 1), [(0.278, 0.273, -0.8), (0.278, 0.273, -0.7)])
        scene.add_spot((0.1, 0.2, 0.3), (1, 0, -1), 5, 10, 20)
        path = scene.save(self.file("moving.gltf"))
        lights = self.section.run_json("info", path, "--json")["lights"]
        self.assertEqual(len(lights), 2)
        for a, b in zip(lights[1]["position"] + lights[1]["direction"], (0.1, 0.2, 0.3, math.sqrt(0.5), 0, -math.sqrt(0.5))):
            self.assertAlmostEqual(a, b, places=5)
        depths = []
        for time in (0, 1):
            self.section.run("render", path, "--time", time, "--technique", "path-tracer", "--size", "1x1", "--fov", 1, "--samples",
                             1, "--aov", "depth", "-o", self.file("x.exr"))
            depths.append(pixels.load_exr(self.file("x.depth.exr"))[0][0][0])
        self.assertAlmostEqual(depths[0] - depths[1], 0.1, places=3)

    def test_files_that_a_scene_names_stay_where_they_are(self):
        os.mkdir(self.file("source"))
        with open(cli.scene_file("cornell-spot"), encoding="utf-8") as f:
            gltf = json.load(f)
        with open(self.file("source/data.bin"), "wb") as f:
            f.write(bytes(gltf["buffers"][0]["byteLength"]))
        gltf["buffers"][0]["uri"] = "data.bin"
        with open(self.file("source/scene.gltf"), "w", encoding="utf-8") as f:
            json.dump(gltf, f)
        MovingScene(self.file("source/scene.gltf")).save(self.file("copy.gltf"))
        with open(self.file("copy.gltf"), encoding="utf-8") as f:
            self.assertEqual([b["uri"] for b in json.load(f)["buffers"]], ["source/data.bin"])

    def test_wall_without_thickness(self):
        scene = MovingScene(cli.scene_file("two-rooms"))
        before = self.section.run_json("info", cli.scene_file("two-rooms"), "--json")["counts"]["triangles"]
        scene.replace_by_rectangle(scene.node("wall between"), [(0, 0, -2), (0, 0, 2), (0, 3, 2), (0, 3, -2)])
        path = scene.save(self.file("plane.gltf"))
        self.assertEqual(self.section.run_json("info", path, "--json")["counts"]["triangles"], before - 12 + 2)


class ExtentScenes(Figures):
    def mean(self, path, *options, aov="combined"):
        """Of the path tracer's picture."""
        self.section.run("render", path, *options, "--technique", "path-tracer", "--size", "32x32", "--samples", 16, "-q", "--aov",
                         "direct", "-o", self.file("x.exr"))
        return figures.mean_of(self.section, figures.part(self.file("x.exr"), aov))

    def scene(self, name):
        return extent_scenes.write(figures.OUT, name)

    def test_each_is_understood_by_the_program(self):
        for name in extent_scenes.scenes():
            self.assertEqual(self.section.run_json("info", self.scene(name), "--json")["warnings"], [], name)

    def test_the_same_bytes_each_time(self):
        for name in ("town.glb", "door-80.gltf"):
            maker = extent_scenes.scenes()[name]
            self.assertEqual(maker().to_bytes(True), maker().to_bytes(True), name)

    def test_sealed_rooms_are_dark(self):
        sky = "--env=1,1,1"
        for ground in extent_scenes.GROUNDS:
            path = self.scene("sealed-%d.gltf" % ground)
            self.assertEqual(self.mean(path, sky, "--camera=inside"), 0, ground)
            self.assertGreater(self.mean(path, sky, "--camera=outside"), 0.1, ground)
        for degrees in (0, 30):
            path = self.scene("thin-wall-%d.gltf" % degrees)
            self.assertEqual(self.mean(path, "--camera=sealed"), 0, degrees)
            self.assertGreater(self.mean(path, "--camera=lit"), 0.1, degrees)

    def test_doors_and_lamps_give_light(self):
        narrow, wide = (self.mean(self.scene(name), "--env=0.5,0.6,0.8", "--camera=inside", "--max-bounces", 0)
                        for name in ("narrow-door.gltf", "door-10.gltf"))
        self.assertGreater(narrow, 0)
        self.assertGreater(wide, 1.5 * narrow)
        self.assertGreater(self.mean(self.scene("lamp-20.gltf"), "--camera=inside"), 0.1)

    def test_emitters_of_all_sizes_have_one_power(self):
        lights = [self.mean(self.scene("emitter-%g.gltf" % size), "--max-bounces", 0, "--eye=-1.9,2.5,1.9", "--target=2,0.1,-2", aov="direct")
                  for size in (10, 2, 0.2)]
        for light in lights[1:]:
            self.assertAlmostEqual(light / lights[0], 1, delta=0.1)

    def test_town(self):
        """Some hundred houses, few triangles, and a flight that goes from the sun through a house to the sun."""
        path = self.scene("town.glb")
        counts = self.section.run_json("info", path, "--json")["counts"]
        self.assertLess(counts["triangles"], 200000)
        self.assertGreater(counts["instances"], 100)
        self.assertLess(counts["meshes"], 20)
        whole = self.file("whole.glb")
        with open(whole, "wb") as f:
            f.write(town(instanced=False).to_bytes(True))
        self.assertEqual(self.section.run_json("info", whole, "--json")["counts"]["triangles"], counts["triangles"])
        sky = [self.mean(path, "--env=1,1,1", "--no-lights", "--max-bounces", 0, "--time", frame / 24) for frame in range(0, 120, 10)]
        self.assertGreater(min(sky[0], sky[-1]), 0.3)
        self.assertLess(min(sky), 0.1 * sky[0])

    def test_the_flight_meets_no_wall(self):
        """Nothing is nearer than 20 cm ahead."""
        path = self.scene("town.glb")
        for frame in range(0, 120, 3):
            self.section.run("render", path, "--time", frame / 24, "--technique", "path-tracer", "--size", "8x8", "--samples", 1,
                             "--max-bounces", 0, "-q", "--aov", "depth", "-o", self.file("x.exr"))
            depths = [pixel[0] for row in pixels.load_exr(self.file("x.depth.exr")) for pixel in row if pixel[0] > 0]
            self.assertGreater(min(depths, default=1), 0.2, frame)


def main():
    cli.PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()


if __name__ == "__main__":
    main()
