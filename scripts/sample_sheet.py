#!/usr/bin/env python3
"""Draws docs/images/gltf-samples.png: every file of scripts/sample_scenes.py by the path tracer and by light-volume.

usage: scripts/sample_sheet.py

The program must be built. Takes about three minutes on two cores.
"""

import os

import cli
import sample_scenes

OUT = os.path.join(cli.ROOT, "build", "results", "gltf-samples")
SHEET = os.path.join(cli.ROOT, "docs", "images", "gltf-samples.png")
SIZE, EXPOSURE = "192x144", 2
WAYS = (("path tracing", ["--technique", "path-tracer", "--samples", 256]), ("light volume", ["--technique", "light-volume"]))


def main():
    os.makedirs(OUT, exist_ok=True)
    pictures, labels = [], []
    for name in sample_scenes.SITUATIONS:
        path = sample_scenes.write(OUT, name, False)
        moment = ["--time", sample_scenes.MOMENT] if name == sample_scenes.ANIMATED else []
        for way, options in WAYS:
            # Animations start with settled light.
            frames = ["--frames", 1 if moment else 64] if way == "light volume" else []
            pictures.append(os.path.join(OUT, "%s %s.exr" % (name, way)))
            labels.append("%s: %s" % (name, way))
            cli.lightwell("render", path, "--size", SIZE, *options, *frames, *moment, "-o", pictures[-1])
    cli.lightwell("montage", *pictures, "--labels", ",".join(labels), "--exposure", EXPOSURE, "--columns", 6, "-o", SHEET)
    print(os.path.relpath(SHEET, cli.ROOT))
    return 0


if __name__ == "__main__":
    cli.main(main)
