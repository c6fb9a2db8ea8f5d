#!/usr/bin/env python3
"""Renders the same frames on every driver and checks that the pictures agree.

usage: scripts/compare_drivers.py LIST      LIST: what scripts/drivers printed

What may differ, and does (128x128, against Mesa 22.3):
  Corners   Vulkan lets a rasteriser round them to 1/16 of a pixel, and SwiftShader does; Mesa rounds to 1/256. Edges of
            objects and shadows move by as much: single pixels there change altogether. The `paper` presets voxelise with
            the rasteriser, so that there whole cells change hands.
  Textures  Mesa 22.3 and 25.0 filter with other last bits: where an alpha mask's edge meets the cut-off, 0.4 % of the
            pixels flip. SwiftShader converts sRGB with an error of up to 2.5 % in dark texels (0.0109 for 0.0112).
  Halves    Mesa truncates when it writes 16-bit floats, SwiftShader rounds: albedo differs by up to 1/1024 of itself.
Without textures Mesa 22.3 and 25.0 make the same bytes.

So two things are asked for:
  Everywhere, after averaging 8x8 pixels: relMSE at most 5e-4 (measured: 2.3e-4), energy within 1.5 % (1.1 %).
  Away from edges of depth, normal and albedo, pixel by pixel: 99 % of the values within 5 % of the picture's mean (1.1 %),
  energy within 0.3 % (0.05 %).
  `paper` presets, for their cells' sake: relMSE at most 1e-3 (6.4e-4); away from edges only energy, within 2 % (0.9 %).
  many-light `best`: the same but for single pixels: it chooses at random, and last bits decide what is chosen, so every
  driver has noise of its own (Mesa 25.0: relMSE 1.6e-5, energy 1e-4; single pixels 13 %).
Ray queries and our own hierarchy find the same surfaces: on one driver their pictures are equal.
That is below the error of any technique, and a wrong cell, light or pass shows.
"""

import functools
import os
import sys

import cli
import pixels

SCENES = ["cornell-spot", "textured", "room"]
# Scene and arguments of the frame without a technique, for light and motion that those scenes lack.
SAMPLED_FRAMES = ["--frames", 8]
DIRECT = {
    "sampled light of emitters": ("cornell-box", SAMPLED_FRAMES),
    "sampled light of the environment": ("arena", ["--no-lights", "--env", "1,1,1", *SAMPLED_FRAMES]),
    "shadow rays": ("room", ["--shadows", "rays", "--light-samples", 0]),
    "a moment of an animation": ("cornell-dynamic", ["--time", 0.75]),
    "an animation after five frames": ("cornell-dynamic", ["--time", 0.75, "--frames", 5]),
}
TRACED = ["sampled light of emitters", "shadow rays"]  # of those, what ray queries make too
SIZE = "128x128"
SAMPLES = 4
BLOCK, BLOCK_REL_MSE, BLOCK_ENERGY, PAPER_BLOCK_REL_MSE = 8, 5e-4, 0.015, 1e-3
INNER_P99, INNER_ENERGY, PAPER_INNER_ENERGY = 0.05, 0.003, 0.02
EDGES = {"depth": 0.05, "normal": 0.05, "albedo": 0.02}  # differences to a neighbour; of depth relative


def read_drivers(path):
    """[(name, variables)] of the drivers that can be had."""
    drivers = []
    with open(path, encoding="utf-8") as f:
        for line in f:
            fields = line.rstrip("\n").split("\t")
            if len(fields) == 3 and fields[0] != "SKIPPED":
                drivers.append((fields[0], dict(v.split("=", 1) for v in fields[2].split())))
    return drivers


def frames():
    """[(name, scene, arguments)] of all that is compared."""
    return ([("%s, %s" % (scene, method.name), scene, method.arguments) for scene in SCENES
             for method in cli.methods()] +
            [("%s, %s" % (scene, name), scene, ["--technique", "none", *arguments])
             for name, (scene, arguments) in DIRECT.items()])


def render(name, scene, arguments, driver, variables, folder):
    picture = os.path.join(folder, "%s-%s.exr" % (name.replace(",", "").replace(" ", "-"), driver))
    cli.lightwell("render", cli.scene_file(scene), *arguments, "--size", SIZE, "--samples", SAMPLES,
                  "--validation", "--aov", ",".join(EDGES), "-o", picture, environment=variables)
    return picture


@functools.lru_cache(maxsize=4)
def smooth(picture):
    """Rows of booleans: no edge in the pixel or beside it."""
    result = None
    for aov, most in EDGES.items():
        rows = pixels.load_exr("%s.%s.exr" % (picture[:-4], aov))
        for c in range(1 if aov == "depth" else 3):
            low, high = pixels.spread([[p[c] for p in row] for row in rows], 1)
            here = [[h - l <= most * (h if aov == "depth" else 1) for l, h in zip(*both)] for both in zip(low, high)]
            result = here if result is None else [[a and b for a, b in zip(*both)] for both in zip(result, here)]
    return result


def compare(picture, other, is_paper, is_noisy):
    """(agree, figures) of two pictures."""
    mask = other[:-4] + ".smooth.png"
    pixels.save_mask(mask, [[a and b for a, b in zip(*rows)] for rows in zip(smooth(picture), smooth(other))])
    whole = cli.lightwell_json("compare", picture, other, "--block", BLOCK, "--json")
    inner = cli.lightwell_json("compare", picture, other, "--mask", mask, "--json")
    p99 = inner["p99_abs"] / inner["mean_ref"]
    agree = (whole["bad_pixels"] == 0 and whole["relMSE"] <= (PAPER_BLOCK_REL_MSE if is_paper else BLOCK_REL_MSE) and
             abs(whole["energy"] - 1) <= BLOCK_ENERGY and
             abs(inner["energy"] - 1) <= (PAPER_INNER_ENERGY if is_paper else INNER_ENERGY) and
             (is_paper or is_noisy or p99 <= INNER_P99))
    return agree, "relMSE %.1e, energy %.4f; away from edges p99 %.1e, energy %.4f" % (
        whole["relMSE"], whole["energy"], p99, inner["energy"])


def compare_all(drivers, folder):
    """Number of failures."""
    bad = 0
    for name, scene, arguments in frames():
        pictures = []
        for driver, variables in drivers:
            try:
                pictures.append((driver, render(name, scene, arguments, driver, variables, folder)))
            except cli.Failed as reason:
                print("FAILED %s on %s: %s" % (name, driver, reason))
                bad += 1
        for driver, picture in pictures[1:]:
            agree, figures = compare(picture, pictures[0][1], "paper" in name, "many-light" in name)
            bad += not agree
            print("%s %s: %s against %s: %s" % ("ok" if agree else "FAILED", name, driver, pictures[0][0], figures),
                  flush=True)
    return bad


def compare_tracing(driver, variables, folder):
    """Number of pictures that ray queries and our own hierarchy make differently on one driver."""
    if not cli.lightwell_json("info", "--json", environment=variables)[0]["ray_queries"]:
        print("SKIPPED ray queries against our own hierarchy: %s has none" % driver)
        return 0
    bad = 0
    for name in TRACED:
        scene, arguments = DIRECT[name]
        pictures = [render(name, scene, ["--technique", "none", *arguments, "--tracing", tracing],
                           "%s-%s" % (driver, tracing), variables, folder) for tracing in ("bvh", "ray-query")]
        figures = cli.lightwell_json("compare", *pictures, "--json")
        agree = figures["bad_pixels"] == 0 and figures["max_abs"] == 0
        bad += not agree
        print("%s %s, %s: ray queries against our own hierarchy on %s: max %.1e, relMSE %.1e" % (
            "ok" if agree else "FAILED", scene, name, driver, figures["max_abs"], figures["relMSE"]), flush=True)
    return bad


def main():
    if len(sys.argv) != 2:
        raise cli.Failed("usage: scripts/compare_drivers.py LIST")
    drivers = read_drivers(sys.argv[1])
    if len(drivers) < 2:
        print("SKIPPED pictures across drivers: only %d driver here" % len(drivers))
        return 0
    folder = os.path.join(cli.ROOT, "build", "driver-pictures")
    os.makedirs(folder, exist_ok=True)
    bad = compare_all(drivers, folder)
    for driver, variables in drivers:
        bad += compare_tracing(driver, variables, folder)
    return 1 if bad else 0


if __name__ == "__main__":
    cli.main(main)
