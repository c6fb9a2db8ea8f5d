"""Figures about cost: time by pass, equal error, leaks, memory."""

import cli
from figures import (Missing, bench, fastest, milliseconds, number, output, part, render, shared, truth)

# The seed's four kinds of scene: (name, scene options, steps at 32^3, V, P, T of the seed in ms on a GTX 285).
SPONZA = ("--scale", "0.01", "--sun", "-0.3,-1,-0.2 10")
KINDS = (("boxes", 11, (10, 12, 22)), ("room", 64, (3, 61, 69)), ("sponza", 11, (10, 11, 28)), ("arena", 12, (3, 13, 21)))
# Passes by what they do.
VOXELS = {"paper": ("clear voxels", "voxelize", "inject"), "best": ("voxelize", "voxel faces: ")}
CACHE = tuple("light cache: " + name for name in ("clear", "carry", "resolve", "gather", "solve"))
LOOK_UP = ("light cache: smooth", "light cache: look-up")
PROPAGATION = {"paper": ("clear received", "propagate"), "best": CACHE}


def scene_of(name):
    if name == "sponza":
        return shared("scenes", "sponza-crytek", "sponza-crytek.gltf"), SPONZA
    return cli.scene_file(name), ()


def cost(section):
    """Voxelisation, propagation and total time on the four kinds of scene, and paper's time per voxel and step."""
    section.text("256 x 256, 32³, fastest of 3 frames in ms. V: voxelisation and injection, or voxelisation and "
                 "faces; P: propagation, or gathering and solution; T: the whole "
                 "frame. Every frame starts from nothing (`--cut every`), so that `best`, which voxelises only when "
                 "geometry changes and asks, gathers and solves four times in its first frame, pays all of both each "
                 "time; *P later* is a frame in which faces have all their links and go on gathering. Seed: GTX 285, "
                 "900 x 900.")
    rows = []
    for name, steps, seed in KINDS:
        try:
            scene, options = scene_of(name)
        except Missing as reason:
            section.skip(name, str(reason))
            continue
        for preset, more in (("paper", ("--steps", steps)), ("best", ())):
            base = (*options, "--technique", "light-volume", "--preset", preset, "--resolution", 32, *more, "--size",
                    "256x256")
            result = bench(section, scene, *base, "--frames", 3, "--warm-up", 1, "--cut", "every")
            later = None if preset == "paper" else bench(section, scene, *base, "--frames", 3, "--warm-up", 17)
            rows.append([name, str(result["triangles"]), "`%s`" % preset, str(steps) if preset == "paper" else "",
                         milliseconds(fastest(result, VOXELS[preset])),
                         milliseconds(fastest(result, PROPAGATION[preset])),
                         milliseconds(fastest(later, PROPAGATION[preset])) if later else "",
                         milliseconds(fastest(result)),
                         "%d / %d / %d" % seed if preset == "paper" else ""])
    section.table(["scene", "triangles", "preset", "steps", "V", "P", "P later", "T", "seed: V / P / T"], rows)
    voxel_steps(section)


def voxel_steps(section):
    """`paper`'s time per voxel and step at three resolutions, taken in turn: what else the machine does hits all alike."""
    rounds = 4
    kinds = ((32, 128), (64, 16), (128, 2))
    times = {resolution: [] for resolution, _ in kinds}
    for _ in range(rounds):
        for resolution, steps in kinds:
            result = bench(section, cli.scene_file("cornell-spot"), "--technique", "light-volume", "--preset", "paper",
                           "--resolution", resolution, "--steps", steps, "--size", "64x64", "--frames", 3, "--warm-up", 1)
            times[resolution].append(fastest(result, ("propagate",)))
    best = {resolution: min(times[resolution]) * 1e6 / (steps * resolution ** 3) for resolution, steps in kinds}
    rows = [["%d³" % resolution, str(steps), milliseconds(min(times[resolution])), "%.1f" % best[resolution]]
            for resolution, steps in kinds]
    section.text("`paper`: propagation time per voxel and step, `cornell-spot`, fastest of %d times 3 frames, the grids in "
                 "turn; as many steps as make all rows the same work." % rounds)
    section.table(["cells", "steps", "ms", "ns per voxel and step"], rows)
    spread = max(best.values()) / min(best.values())
    section.text("Largest over smallest: %s (demand: at most 1.2). The seed: 28 ns." % section.demand(
        spread <= 1.2, number(spread), "paper's time per voxel and step is constant within 20 %"))


def moving_light(section):
    """cornell-spot at 512 x 512, 32 cells, best, light moving: mean of 30 frames."""
    result = bench(section, cli.scene_file("cornell-spot"), "--technique", "light-volume", "--preset", "best",
                   "--resolution", 32, "--size", "512x512", "--frames", 30, "--move-lights")
    wall = result["wall_ms"]
    section.text("Wall time of a frame: mean %s (demand: at most 200 ms), median %s, fastest %s, slowest %s ms. Frames 4 to "
                 "33 after the start; faces gather in all of them." % (
                     section.demand(wall["mean"] <= 200, milliseconds(wall["mean"]) + " ms", "moving light, mean frame"),
                     milliseconds(wall["median"]), milliseconds(wall["min"]), milliseconds(wall["max"])))
    section.table(["pass", "count", "frames", "min", "median", "mean", "max"],
                  [[p["name"], str(p["count"]), str(p["frames"]),
                    *("%.2f" % p["ms"][k] for k in ("min", "median", "mean", "max"))]
                   for p in result["passes"] if p["ms"]["mean"] >= 0.05])


EQUAL_SETTINGS = (1, 2, 4, 8)  # --links-per-frame of best, cheapest first; 8 is its default


def equal_error(section):
    """Propagation time that best needs for paper's error of indirect light."""
    rows = []
    for name in ("room", "cornell-spot"):
        scene = cli.scene_file(name)
        true, _ = truth(section, scene, "256x256", 128, None)
        base = ("--technique", "light-volume", "--resolution", 32, "--size", "256x256")
        paper = (*base, "--preset", "paper", "--steps", 64)
        picture = render(section, scene, "equal-%s-paper" % name, *paper)
        target = section.compare(part(picture, "indirect"), part(true, "indirect"))["relMSE"]
        for links in EQUAL_SETTINGS:
            best = (*base, "--preset", "best", "--links-per-frame", links)
            picture = render(section, scene, "equal-%s-best" % name, *best, "--frames", 1)
            error = section.compare(part(picture, "indirect"), part(true, "indirect"))["relMSE"]
            if error <= target:
                break
        timing = ("--frames", 9, "--warm-up", 1, "--cut", "every")
        paper_time, best_time = bench(section, scene, *paper, *timing), bench(section, scene, *best, *timing)
        paper_ms = fastest(paper_time, PROPAGATION["paper"])
        best_ms = fastest(best_time, PROPAGATION["best"])
        share = best_ms / paper_ms
        rows.append([name, number(target), milliseconds(paper_ms), str(links), number(error), milliseconds(best_ms),
                     section.demand(error <= target and share <= 0.5, number(share),
                                    "%s: best's time over paper's at equal error" % name)])
    section.text("relMSE of indirect light, 256 x 256, 32³; `paper` with 64 steps; `best` in its first frame from nothing, "
                 "with the fewest links a frame that reach `paper`'s error. Times are propagation, fastest of 9 frames "
                 "that all start from nothing: all steps of `paper`; gathering and solution of `best`, four times in its "
                 "first frame. Demand: a share of at most 0.5.")
    section.table(["scene", "paper: relMSE", "ms", "best: links", "relMSE", "ms", "share"], rows)


# Groups of passes of an animated frame: heading, prefixes of their names.
ANIMATED_PASSES = (
    ("vertices", ("world vertices",)),
    ("shadow maps", ("shadow maps",)),
    ("G-buffer", ("g-buffer", "background")),
    ("hierarchy", ("bvh:",)),
    ("direct", ("direct light",)),
    ("voxels, faces", ("voxelize", "slicing", "voxel faces: ", "clear", "inject")),
    ("gathering, solution, propagation", (*CACHE, "propagate")),
    ("look-up", ("lookup", *LOOK_UP)),
)
ANIMATED_SETTINGS = (
    ("direct light alone, shadow maps", ("--technique", "none")),
    ("direct light alone, shadow rays", ("--technique", "none", "--shadows", "rays")),
    ("`light-volume`, `best`", ("--technique", "light-volume")),
    ("`light-volume`, `paper`", ("--technique", "light-volume", "--preset", "paper")),
)


def animation(section):
    """cornell-dynamic while it plays: what a frame costs when 150,000 triangles and both lights move."""
    scene = cli.scene_file("cornell-dynamic")
    rows = []
    for name, options in ANIMATED_SETTINGS:
        result = bench(section, scene, *options, "--animate", "--size", "256x256", "--frames", 24)
        groups = [median_of(result, prefixes) for _, prefixes in ANIMATED_PASSES]
        rows.append([name, *(milliseconds(ms) if ms else "" for ms in groups), milliseconds(result["gpu_ms"]["median"]),
                     milliseconds(result["wall_ms"]["median"])])
    section.text("`cornell-dynamic`, %d triangles, 256 x 256, 24 frames of the animation; medians in ms. The last two columns "
                 "are the whole frame on the device and by the clock." % result["triangles"])
    section.table(["", *(name for name, _ in ANIMATED_PASSES), "device", "wall"], rows)


def median_of(result, prefixes):
    """Median over frames of the milliseconds of all passes whose names start so; 0 without any."""
    times = [p["each_ms"] for p in result["passes"] if p["name"].startswith(prefixes)]
    frames = sorted(map(sum, zip(*times))) if times else [0.0]
    return frames[len(frames) // 2]


LEAK_CELLS = 40   # along the longest axis: a multiple of 8 that holds the scene at every offset
WALL = 0.25       # m: one cell


def leak(section):
    """Light in the sealed room, through a wall of one cell, over 8 offsets of the grid."""
    scene = cli.scene_file("two-rooms")
    half = WALL * (LEAK_CELLS - 1 / 128) / 2  # the fit leaves 1/256 of a cell free on both sides
    rows = []
    for preset, more in (("best", ()), ("paper", ("--steps", 80))):
        sums = {"sealed": 0.0, "lit": 0.0}
        worst = 0.0
        for step in range(8):
            shift = WALL * (step - 4) / 8
            bounds = ",".join("%.6f" % v for v in (shift - half, -half, -half, shift + half, half, half))
            means = {}
            for camera in sums:
                picture = output("leak-%s.exr" % camera)
                section.run("render", scene, "--technique", "light-volume", "--preset", preset, "--resolution", LEAK_CELLS,
                            *more, "--grid-bounds=" + bounds, "--camera", camera, "--size", "64x64", "-o", picture)
                means[camera] = section.compare(picture, picture)["mean_test"]
                sums[camera] += means[camera]
            worst = max(worst, means["sealed"] / means["lit"])
        share = sums["sealed"] / sums["lit"]
        text = "%.3f %%" % (100 * share)
        rows.append(["`%s`" % preset, section.demand(share <= 0.01, text, "leak of best") if preset == "best" else text,
                     "%.3f %%" % (100 * worst)])
    section.text("`two-rooms`: mean radiance of the view `sealed` over that of the view `lit`, combined, 64 x 64; the wall "
                 "is exactly one cell (0.25 m); 8 offsets of the grid along the wall's normal, an eighth of a cell apart. "
                 "Demand on `best`: at most 1 %.")
    section.table(["preset", "mean of 8 offsets", "worst offset"], rows)


def memory(section):
    """Device memory by name for Crytek Sponza."""
    scene, options = scene_of("sponza")
    result = bench(section, scene, *options, "--technique", "light-volume", "--preset", "best", "--resolution", 32, "--size",
                   "1280x720", "--frames", 6, "--warm-up", 1)
    megabytes = 2 ** 20
    large = sorted((m for m in result["memory"] if m["bytes"] >= 0.01 * megabytes), key=lambda m: -m["bytes"])
    section.text("Crytek Sponza, %d triangles, 1280 x 720, `best` at 32³: %.1f MiB in all; names of 0.01 MiB and more." % (
        result["triangles"], result["memory_bytes"] / megabytes))
    section.table(["name", "MiB"], [[m["name"], "%.2f" % (m["bytes"] / megabytes)] for m in large])


def first_frame(section):
    """Where the time of the first frame goes."""
    rows = []
    for name in ("boxes", "room", "sponza"):
        scene, options = scene_of(name)
        stats = section.run_json("render", scene, *options, "--size", "256x256", "--frames", 1, "--samples", 1, "--stats",
                                 "json", "-o", output("first-frame.exr"))
        times = stats["first_frame"]
        rows.append([name, *(milliseconds(times[k]) for k in ("setup_ms", "declare_ms", "pipelines_ms")),
                     str(times["pipelines"]), *(milliseconds(times[k]) for k in ("record_ms", "wait_ms"))])
    section.text("256 x 256, `light-volume`, ms on the host: making the renderer (textures, staging), declaring the frame, "
                 "making its pipelines on all cores, recording, and waiting for the device, whose driver compiles what it "
                 "runs for the first time.")
    section.table(["scene", "set-up", "declare", "pipelines", "of them", "record", "wait"], rows)


def culling(section):
    """What frames leave out because nobody reads it."""
    rows = []
    for name in ("cornell-spot", "room"):
        stats = section.run_json("render", cli.scene_file(name), "--size", "512x512", "--stats", "json", "-o",
                                 output("culling.exr"))
        frames = {p["name"]: p["frames"] for p in stats["passes"]}
        spared = sum(p["time_ms"] * (stats["frames"] - p["frames"]) for p in stats["passes"]
                     if p["name"] in ("g-buffer", "direct light", *LOOK_UP))
        rows.append([name, str(stats["frames"]), str(frames["light cache: gather"]), str(frames["light cache: look-up"]),
                     "%.1f s" % (spared / 1e3), "%.1f s" % (stats["wall_time_ms"] / 1e3)])
    section.text("A picture rendered until it is steady, 512 x 512, 4 samples, `light-volume`: G-buffer, direct light and "
                 "look-up run in the frames that the film keeps; the world part runs as long as it changes.")
    section.table(["scene", "frames", "with gathering", "with look-up", "spared", "wall"], rows)
    rows = []
    for shadows in ("maps", "rays"):
        result = bench(section, cli.scene_file("cornell-dynamic"), "--technique", "ambient", "--set", "shadows=" + shadows,
                       "--animate", "--size", "128x128", "--frames", 8)
        maps = [p["ms"]["median"] for p in result["passes"] if p["name"].startswith("shadow maps")]
        rows.append([shadows, milliseconds(sum(maps)) if maps else "not drawn", milliseconds(result["gpu_ms"]["median"]),
                     "%.1f" % (result["memory_bytes"] / 2 ** 20)])
    section.text("`cornell-dynamic` while it plays, `ambient`, 128 x 128: shadow maps are drawn for who reads them; medians in "
                 "ms.")
    section.table(["`--shadows`", "shadow maps", "frame", "MiB"], rows)


FIGURES = {"cost": cost, "first-frame": first_frame, "culling": culling, "moving-light": moving_light, "equal-error": equal_error,
           "animation": animation, "leak": leak, "memory": memory}
