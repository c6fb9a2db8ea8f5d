#!/usr/bin/env python3
"""Small glTF files, one for each thing that the format can say about a picture: each shows what a plain file shows, on both sides.

cli_samples_test.py PROGRAM [unittest arguments]. Python's standard library only.
"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "scripts"))

import sample_scenes  # noqa: E402
from command_line import CommandLine, main  # noqa: E402

SIZE = "64x64"
FRAMES = 12  # light is not settled then, but for what is left to the bounds below


class Samples(CommandLine):
    def draw(self, path, output, *more):
        self.succeed("render", path, "--size", SIZE, "-q", "-o", output, *more)
        return output

    def check(self, name):
        path, plain = (sample_scenes.write(self.folder, name, is_plain) for is_plain in (False, True))
        result = self.run_program("info", path)
        if result.returncode == 2 and "this build of Lightwell has no" in result.stderr:
            self.skipTest(name + ": " + result.stderr.strip())
        moment = ["--time", sample_scenes.MOMENT] if name == sample_scenes.ANIMATED else []
        traced = self.draw(path, "traced.exr", "--technique", "path-tracer", "--samples", 64, *moment)
        expected = self.draw(plain, "plain.exr", "--technique", "path-tracer", "--samples", 64)
        # The same random numbers: what differs is the file's doing. Strips of colours and rounded vertices are not exact.
        alike = self.compare(traced, expected, "--exposure", 2)
        self.assertAlmostEqual(alike["energy"], 1, delta=0.001)
        self.assertGreater(alike["ssim"], 0.998)
        frames = 1 if moment else FRAMES  # an animation starts with settled light
        lit = self.draw(path, "lit.exr", "--technique", "light-volume", "--frames", frames, *moment)
        close = self.compare(lit, traced, "--exposure", 2, "--block", 2)
        self.assertAlmostEqual(close["energy"], 1, delta=0.05, msg=close)
        self.assertGreater(close["ssim"], 0.96, close)
        self.assertLess(close["relMSE"], 0.02)


for situation in sample_scenes.SITUATIONS:
    setattr(Samples, "test_" + situation.replace("-", "_"), lambda self, name=situation: self.check(name))


if __name__ == "__main__":
    main()
