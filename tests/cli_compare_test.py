#!/usr/bin/env python3
"""Tests of the command line as a user meets it: measures and masks of lightwell compare.

cli_compare_test.py PROGRAM [unittest arguments]. Python's standard library only.
"""
import json
import math

from command_line import CommandLine, gray_png, main, srgb


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


if __name__ == "__main__":
    main()
