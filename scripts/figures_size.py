"""Figures about large scenes: time and memory from 0.1 to 6 million triangles, and agreement with the path tracer."""

import json
import os

import large_scene
from figures import milliseconds, number, output, part, render, truth

COUNTS = (100000, 1000000, 6000000)
SIZE = "128x128"
# Memory by the beginnings of its names; each name belongs to the first kind that lists it.
KINDS = (("scene", ("world vertices", "object vertices", "vertex sources", "previous positions", "indices")),
         ("hierarchy", ("bvh nodes", "bvh triangles")),
         ("builder", ("bvh ",)),
         ("others", ("",)))


def generated(count):
    """(path, triangles) of the scene, written once."""
    path = output("large-%d.glb" % count)
    note = path[:-4] + ".json"
    if not os.path.exists(note):
        triangles = large_scene.write_large_scene(path, count)
        with open(note, "w", encoding="utf-8") as f:
            json.dump(triangles, f)
    with open(note, encoding="utf-8") as f:
        return path, json.load(f)


def sort_memory(memory):
    """Bytes by kind."""
    sums = {kind: 0 for kind, _ in KINDS}
    for name, count in memory.items():
        for kind, beginnings in KINDS:
            if name.startswith(beginnings):
                sums[kind] += count
                break
    return sums


def mebibytes(sums):
    return "%.0f" % (sum(sums.values()) / 2 ** 20)


def size(section):
    """Scenes of 0.1, 1 and 6 million triangles: time, memory a triangle, agreement with the path tracer."""
    section.text("Hills and two boxes in a room (`scripts/large_scene.py`), %s, shadows by rays, `light-volume` at 32³, on "
                 "the CPU driver. *Setup*: geometry prepared on the host; *first frame*: until it is done, pipelines and "
                 "the hierarchy's build included; *frame*: device time of those after it." % SIZE)
    times, memories, agreement = [], [], []
    for count in COUNTS:
        scene, triangles = generated(count)
        name = "size-%d" % count
        statistics = json.loads(section.run("render", scene, "--technique", "light-volume", "--size", SIZE, "--shadows",
                                            "rays", "--samples", 16, "--device", "cpu", "--aov", "direct,indirect",
                                            "--stats", "json", "-o", output(name + ".exr")))
        first = statistics["first_frame"]
        build = sum(p["time_ms"] for p in statistics["passes"] if p["name"].startswith("bvh"))
        times.append([str(triangles), milliseconds(first["setup_ms"]), milliseconds(first["wait_ms"]), milliseconds(build),
                      milliseconds(statistics["gpu_time_ms"])])
        alone = json.loads(section.run("render", scene, "--technique", "light-volume", "--size", SIZE, "--shadows", "rays",
                                       "--samples", 1, "--frames", 1, "--device", "cpu", "--stats", "json", "-o",
                                       output("first-frame.exr")))
        at_first, later = sort_memory(alone["memory_bytes"]), sort_memory(statistics["memory_bytes"])
        memories.append([str(triangles), *("%.0f" % (later[kind] / triangles) for kind in ("scene", "hierarchy")),
                         "%.0f" % (at_first["builder"] / triangles), mebibytes(later), mebibytes(at_first)])
        true = truth(section, scene, SIZE, 256, None)[0]
        for aov, least in (("direct", 0.97), ("indirect", 0.9)):
            error = section.compare(part(output(name + ".exr"), aov), part(true, aov), "--eps", "0.001")
            agreement.append([str(triangles), aov,
                              section.demand(0.9 <= error["energy"] <= 1.1, "%.4f" % error["energy"], name + " energy"),
                              number(error["relMSE"]),
                              section.demand(error["ssim"] >= least, "%.4f" % error["ssim"], name + " SSIM")])
    section.table(["triangles", "setup, ms", "first frame, ms", "of it the hierarchy, ms", "frame, ms"], times)
    section.text("GPU memory in bytes a triangle: the scene, its hierarchy, and what building that needs in the first frame "
                 "and gives back; then all of it, in MiB.")
    section.table(["triangles", "scene", "hierarchy", "builder", "later frames, MiB", "first frame, MiB"], memories)
    section.text("Against the path tracer (256 paths a pixel):")
    section.table(["triangles", "light", "mean ratio", "relMSE", "SSIM"], agreement)


FIGURES = {"size": size}
