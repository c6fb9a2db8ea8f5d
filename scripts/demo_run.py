#!/usr/bin/env python3
"""Renders one scene with every technique and the path tracer, and prints a table of cost and error.

Called by scripts/demo after the build. Pictures go to demo/; true pictures are kept in build/truth and rendered again
only if the scene, the options or the sources of the path tracer change.
"""

import argparse
import hashlib
import os
import time

import cli

MAX_BOUNCES = 8
NOISE_PART = 4  # the second true picture, which only measures the first one's noise, has 1/4 of its samples


def sources_digest(digest):
    """Everything that a true picture depends on besides scene and options."""
    for folder in ("include", "src/core", "src/scene", "src/reference"):
        for path, folders, names in os.walk(os.path.join(cli.ROOT, folder)):
            folders.sort()
            for name in sorted(names):
                if not name.endswith("_test.cpp"):
                    with open(os.path.join(path, name), "rb") as f:
                        digest.update(name.encode() + b"\0" + f.read())


def truth(scene, size, samples, seed):
    """Path of the true picture (linear EXR), and the seconds that it took, or None if it was there."""
    options = ["--technique", "path-tracer", "--samples", samples, "--max-bounces", MAX_BOUNCES, "--size", size,
               "--seed", seed]
    digest = hashlib.sha256(repr(options).encode())
    with open(scene, "rb") as f:
        digest.update(f.read())
    sources_digest(digest)
    folder = os.path.join(cli.ROOT, "build", "truth")
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, digest.hexdigest()[:24] + ".exr")
    if os.path.exists(path):
        return path, None
    started = time.monotonic()
    # Rendered beside its place: a run that is interrupted leaves nothing that looks like the truth.
    partial = path[:-4] + ".partial.exr"
    cli.lightwell("render", scene, *options, "-o", partial)
    os.replace(partial, path)
    return path, time.monotonic() - started


def table(rows):
    """Columns as wide as their widest cell; the first is left-aligned."""
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    for row in rows:
        print("  ".join(c.ljust(w) if i == 0 else c.rjust(w) for i, (c, w) in enumerate(zip(row, widths))).rstrip())


def number(value, digits=4):
    return "%.*g" % (digits, value)


def print_errors(title, results):
    """One line a technique."""
    devices = sorted({stats["device"] for _, stats, _ in results})
    print("\n%s, on %s; error against the path tracer" % (title, ", ".join(devices)))
    rows = [["technique", "ms/frame", "frames", "MiB", "relMSE", "SSIM", "FLIP", "energy"]]
    for technique, stats, error in results:
        memory = sum(stats["memory_bytes"].values())
        rows.append([technique, number(stats["gpu_time_ms"]), str(stats["frames"]), "%.1f" % (memory / 2**20),
                     number(error["relMSE"], 3), number(error["ssim"], 3), number(error["flip"], 3),
                     number(error["energy"], 4)])
    table(rows)


def print_costs(results):
    """Time of each pass and memory of each technique."""
    for name, stats, _ in results:
        print("\n%s, milliseconds a frame by pass (mean)" % name)
        rows = [["  " + p["name"], "%.2f" % p["time_ms"]] for p in stats["passes"]]
        table(rows or [["  none reported", ""]])
        memory = sorted(stats["memory_bytes"].items(), key=lambda m: -m[1])[:5]
        print("  largest in memory: " + ", ".join("%s %.1f MiB" % (m, size / 2**20) for m, size in memory))


def main():
    parser = argparse.ArgumentParser(prog="scripts/demo", description="Sets up, builds, renders and compares.")
    parser.add_argument("--scene", default="cornell-spot", help="built-in name or file (default: %(default)s)")
    parser.add_argument("--size", default="384x384", help="of every picture (default: %(default)s)")
    parser.add_argument("--samples", type=int, default=256, help="paths a pixel of the truth (default: %(default)s)")
    parser.add_argument("--device", help="as lightwell render --device")
    arguments = parser.parse_args()

    scene = cli.scene_file(arguments.scene)
    name = os.path.splitext(os.path.basename(scene))[0]
    exposure = cli.scene_exposure(scene)
    out = os.path.join(cli.ROOT, "demo")
    os.makedirs(out, exist_ok=True)

    print("rendering the truth (path tracer, %d samples a pixel) ..." % arguments.samples, flush=True)
    reference, seconds = truth(scene, arguments.size, arguments.samples, 1)
    second, _ = truth(scene, arguments.size, max(1, arguments.samples // NOISE_PART), 2)
    # Two independent pictures of N and N/4 samples differ by the noise of the first times 1 + 4.
    between = cli.lightwell_json("compare", second, reference, "--exposure", exposure, "--json")
    own_noise = between["relMSE"] / (1 + NOISE_PART)
    print("  %s, its own noise: relMSE %s" % ("from build/truth" if seconds is None else "%.1f s" % seconds,
                                              number(own_noise, 2)), flush=True)

    results = []
    for technique in cli.technique_names():
        print("rendering with %s ..." % technique, flush=True)
        picture = os.path.join(out, "%s-%s.exr" % (name, technique))
        options = ["--technique", technique, "--size", arguments.size, "--stats", "json", "-o", picture]
        if arguments.device:
            options += ["--device", arguments.device]
        stats = cli.lightwell_json("render", scene, *options)
        error = cli.lightwell_json("compare", picture, reference, "--exposure", exposure, "--json")
        results.append((technique, stats, error))

    pictures = [(t, os.path.join(out, "%s-%s.exr" % (name, t))) for t, _, _ in results] + [("path-tracer", reference)]
    for label, picture in pictures:
        cli.lightwell("montage", picture, "--exposure", exposure, "-o", os.path.join(out, "%s-%s.png" % (name, label)))
    together = os.path.join(out, name + ".png")
    cli.lightwell("montage", *[p for _, p in pictures], "--labels", ",".join(l for l, _ in pictures), "--exposure",
                  exposure, "-o", together)

    if results:
        print_errors("%s, %s" % (name, arguments.size), results)
        print_costs(results)
    else:
        print("this build has no technique yet: only the path tracer's picture was made")
    print("\npictures: %s and %d beside it" % (os.path.relpath(together, cli.ROOT), len(pictures)))


if __name__ == "__main__":
    cli.main(main)
