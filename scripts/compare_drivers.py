#!/usr/bin/env python3
"""Renders the same frames on every driver and checks that the pictures agree.

usage: scripts/compare_drivers.py LIST      LIST: what scripts/drivers printed

Tolerance: drivers may order float sums and filter textures in their own way, so bytes differ; light does not. Pictures
agree if relMSE between them is at most 1e-4 and their energies differ by at most 0.2 %: far below any technique's
error, far above rounding.
"""

import os
import sys

import cli

SCENES = ["cornell-spot", "textured"]
SIZE = "128x128"
MAX_REL_MSE = 1e-4
MAX_ENERGY = 0.002


def read_drivers(path):
    """[(name, variables)] of the drivers that can be had."""
    drivers = []
    with open(path, encoding="utf-8") as f:
        for line in f:
            fields = line.rstrip("\n").split("\t")
            if len(fields) == 3 and fields[0] != "SKIPPED":
                drivers.append((fields[0], dict(v.split("=", 1) for v in fields[2].split())))
    return drivers


def render(scene, technique, driver, variables, folder):
    picture = os.path.join(folder, "%s-%s-%s.exr" % (scene, technique, driver))
    cli.lightwell("render", cli.scene_file(scene), "--technique", technique, "--size", SIZE, "-o", picture,
                  environment=variables)
    return picture


def main():
    if len(sys.argv) != 2:
        raise cli.Failed("usage: scripts/compare_drivers.py LIST")
    drivers = read_drivers(sys.argv[1])
    if len(drivers) < 2:
        print("SKIPPED pictures across drivers: only %d driver here" % len(drivers))
        return 0
    folder = os.path.join(cli.ROOT, "build", "driver-pictures")
    os.makedirs(folder, exist_ok=True)
    bad = 0
    for scene in SCENES:
        for technique in cli.technique_names():
            pictures = []
            for driver, variables in drivers:
                try:
                    pictures.append((driver, render(scene, technique, driver, variables, folder)))
                except cli.Failed as reason:
                    print("FAILED %s, %s on %s: %s" % (scene, technique, driver, reason))
                    bad += 1
            for driver, picture in pictures[1:]:
                m = cli.lightwell_json("compare", picture, pictures[0][1], "--json")
                good = m["relMSE"] <= MAX_REL_MSE and abs(m["energy"] - 1) <= MAX_ENERGY and m["bad_pixels"] == 0
                bad += not good
                print("%s %s, %s: %s against %s: relMSE %.2g, energy %.4f" % (
                    "ok" if good else "FAILED", scene, technique, driver, pictures[0][0], m["relMSE"], m["energy"]))
    return 1 if bad else 0


if __name__ == "__main__":
    cli.main(main)
