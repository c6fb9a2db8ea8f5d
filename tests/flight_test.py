#!/usr/bin/env python3
"""Light stays as it is while a camera flies through a town of 1 km and one of its houses.

flight_test.py PROGRAM [unittest arguments]. Python's standard library only. Times are measured by scripts/results --only
flight: they say nothing on a busy machine.
"""
import os
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "scripts"))

import cli  # noqa: E402
import extent_scenes  # noqa: E402


class Flight(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not cli.lightwell_json("info", "--json"):
            raise unittest.SkipTest("no Vulkan device on this machine")
        with tempfile.TemporaryDirectory() as folder:
            path = extent_scenes.write(folder, "town.glb")
            cls.result = cli.lightwell_json("bench", "flight", path, "--env=%g,%g,%g" % extent_scenes.SKY, "--frames", 120, "--points",
                                            1000, "--rays", 16, "--size", "32x32", "--json")
        print({name: cls.result[name] for name in ("changes", "energy", "error", "memory_bytes")}, file=sys.stderr)

    def test_little_pops(self):
        """Cells of the coarse levels are as large as houses: what they say of a wall is another light than its own. The wish is 0.03."""
        self.assertLessEqual(self.result["changes"]["p99"], 0.045)
        self.assertLessEqual(self.result["changes"]["p999"], 0.11)

    def test_energy_is_the_truths_and_stays(self):
        for frame in self.result["each"]:
            self.assertAlmostEqual(frame["energy"], 1, delta=0.07)

    def test_memory_does_not_grow(self):
        self.assertLessEqual(self.result["memory_bytes"]["last"], 1.03 * self.result["memory_bytes"]["first"])


def main():
    cli.PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()


if __name__ == "__main__":
    main()
