#!/usr/bin/env python3
"""Tests of the command line as a user meets it: files and values of lightwell render.

cli_render_test.py PROGRAM [unittest arguments]. Python's standard library only.
"""
import json
import os

from command_line import CommandLine, hdr, main, srgb


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


if __name__ == "__main__":
    main()
