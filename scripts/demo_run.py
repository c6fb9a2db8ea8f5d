#!/usr/bin/env python3
"""Renders one scene with every technique and the path tracer, and prints a table of cost and error.

Called by scripts/demo after the build. Pictures go to demo/; true pictures are kept in build/truth and rendered again
only if the scene, the options or the sources of the path tracer change.
"""

import argparse
import hashlib
import os
import shutil
import time

import cli

FRAME_SAMPLES = 4  # anti-aliasing of the techniques' pictures: the truth is anti-aliased too
BENCH_FRAMES = 10
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


def truth(scene, size, samples, seed, bounces):
    """Path of the true picture (linear EXR), and the seconds that it took, or None if it was there."""
    options = ["--technique", "path-tracer", "--samples", samples, *cli.bounce_options(bounces), "--size", size, "--seed", seed]
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


def total_ms(cost):
    """Sum of the passes: what the device spends on a frame."""
    return sum(p["ms"]["mean"] for p in cost["passes"])


def print_errors(title, results):
    """One line a technique."""
    rows = [["technique", "ms/frame", "MiB", "frames", "seconds", "relMSE", "SSIM", "FLIP", "energy", "bounces"]]
    for r in results:
        rows.append([r.name, number(total_ms(r.cost), 3), "%.1f" % (r.cost["memory_bytes"] / 2**20),
                     str(r.stats["frames"]), "%.1f" % (r.stats["wall_time_ms"] / 1000), number(r.error["relMSE"], 3),
                     number(r.error["ssim"], 3), number(r.error["flip"], 3), number(r.error["energy"], 4),
                     "all" if r.bounces is None else str(r.bounces)])
    print("\n%s, on %s" % (title, ", ".join(sorted({r.stats["device"] for r in results}))))
    print("ms/frame and MiB: of a frame while the lights move. frames, seconds: until the picture was steady. "
          "Errors: against the path tracer at as many bounces as the technique shows.\n")
    table(rows)


def print_costs(results):
    """Time by pass, techniques side by side, and what takes the memory."""
    names = []
    for r in results:
        # In the order of the frame: what only this technique has goes where it stands in its own list.
        place = 0
        for p in r.cost["passes"]:
            if p["name"] in names:
                place = names.index(p["name"]) + 1
            else:
                names.insert(place, p["name"])
                place += 1
    times = [{p["name"]: p["ms"]["mean"] for p in r.cost["passes"]} for r in results]
    rows = [["ms/frame by pass"] + [r.name for r in results]]
    for name in names:
        rows.append([name] + ["%.2f" % t[name] if name in t else "-" for t in times])
    rows.append(["sum"] + ["%.2f" % total_ms(r.cost) for r in results])
    print()
    table(rows)
    print("\nlargest in memory")
    for r in results:
        memory = sorted(r.cost["memory"], key=lambda m: -m["bytes"])[:4]
        print("  %s: %s" % (r.name, ", ".join("%s %.1f MiB" % (m["name"], m["bytes"] / 2**20) for m in memory)))


class Result:
    """What one technique did."""

    def __init__(self, method, picture, stats, error, cost):
        self.name, self.picture, self.stats, self.error, self.cost = method.name, picture, stats, error, cost
        self.bounces = method.bounces


def run_method(method, scene, exposure, reference, arguments, picture):
    options = method.arguments + ["--size", arguments.size]
    if arguments.device:
        options += ["--device", arguments.device]
    stats = cli.lightwell_json("render", scene, *options, "--set", "samples=%d" % FRAME_SAMPLES, "--stats", "json",
                               "-o", picture)
    error = cli.lightwell_json("compare", picture, reference, "--exposure", exposure, "--json")
    cost = cli.lightwell_json("bench", scene, *options, "--move-lights", "--frames", BENCH_FRAMES, "--json")
    return Result(method, picture, stats, error, cost)


def main():
    parser = argparse.ArgumentParser(prog="scripts/demo", description="Sets up, builds, renders and compares.")
    parser.add_argument("--scene", default="cornell-spot", help="built-in name or file (default: %(default)s)")
    parser.add_argument("--size", default="320x320", help="of every picture (default: %(default)s)")
    parser.add_argument("--samples", type=int, default=1024, help="paths a pixel of the truth (default: %(default)s)")
    parser.add_argument("--device", help="as lightwell render --device")
    arguments = parser.parse_args()

    scene = cli.scene_file(arguments.scene)
    name = os.path.splitext(os.path.basename(scene))[0]
    exposure = cli.scene_exposure(scene)
    out = os.path.join(cli.ROOT, "demo")
    os.makedirs(out, exist_ok=True)

    print("rendering the truth (path tracer, %d samples a pixel) ..." % arguments.samples, flush=True)
    methods = cli.methods()
    references = {bounces: truth(scene, arguments.size, arguments.samples, 1, bounces)
                  for bounces in {None, *(method.bounces for method in methods)}}
    reference, seconds = references[None]
    second, _ = truth(scene, arguments.size, max(1, arguments.samples // NOISE_PART), 2, None)
    # Two independent pictures of N and N/4 samples differ by the noise of the first times 1 + 4.
    between = cli.lightwell_json("compare", second, reference, "--exposure", exposure, "--json")
    own_noise = between["relMSE"] / (1 + NOISE_PART)
    print("  %s, its own noise: relMSE %s" % ("from build/truth" if seconds is None else "%.1f s" % seconds,
                                              number(own_noise, 2)), flush=True)

    results = []
    for method in methods:
        print("rendering with %s ..." % method.name, flush=True)
        picture = os.path.join(out, "%s-%s.exr" % (name, method.name.replace(" ", "-")))
        results.append(run_method(method, scene, exposure, references[method.bounces][0], arguments, picture))

    kept = os.path.join(out, name + "-path-tracer.exr")
    shutil.copyfile(reference, kept)
    pictures = [(r.name, r.picture) for r in results] + [("path tracer", kept)]
    for _, picture in pictures:
        cli.lightwell("montage", picture, "--exposure", exposure, "-o", picture[:-4] + ".png")
    together = os.path.join(out, name + ".png")
    cli.lightwell("montage", *[p for _, p in pictures], "--labels", ",".join(l for l, _ in pictures), "--exposure",
                  exposure, "-o", together)

    print_errors("%s, %s" % (name, arguments.size), results)
    print_costs(results)
    print("\nside by side: %s; each alone, as .png and .exr, beside it" % os.path.relpath(together, cli.ROOT))


if __name__ == "__main__":
    cli.main(main)
