"""Figures about ray_traced_voxels' light: quality, leak, taps, an emitter's light, writers. Times:
figures_ray_traced_voxels_time.py."""

import cli
import pixels
from figures import (MOST_SAMPLES, QUIET, LitScene, Missing, bench, each_lit_scene, fastest, mean_of, method, milliseconds,
                     montage, number, output, part, quiet_truth, reference, truth, within)
from moving_scene import MovingScene

SIZE = "256x256"
NOISE = 0.002  # relMSE of a truth's own noise that is allowed, 4 x 4 averages
FRAMES = 64      # of history: light has bounced as often as it can be seen
SAMPLES = 16     # the last of them, averaged
PAPER_FRAMES = 4  # all averaged: each is made anew


def preset(name, **options):
    return method("ray-traced-voxels", name, **options)


def draw(section, scene, view, name, technique, frames):
    """Renders `frames` frames, the last SAMPLES averaged, to build/results/NAME.exr, direct and indirect light beside it.

    Returns (path, statistics).
    """
    picture = output(name + ".exr")
    return picture, section.run_json("render", scene, *view, *technique, "--size", SIZE, "--frames", frames, "--samples",
                                     min(frames, SAMPLES), "--aov", "direct,indirect", "--stats", "json", "-o", picture)


def true_light(section, scene, camera, noise=QUIET):
    return quiet_truth(section, scene.path, SIZE, None, scene.view(camera), noise, MOST_SAMPLES)


# ---- quality ----

# Cameras, and the SSIM that is demanded; energy of indirect light 0.95 to 1.05 everywhere. The truth's noise is a hundredth
# of what SSIM may lack.
ENERGY = (0.95, 1.05)
QUALITY = {"sponza-crytek": (("nave", "arches"), 0.93), "sibenik": (("own", "choir", "entrance"), 0.93),
           "cornell-spot": (("own",), 0.97), "room": (("own",), 0.97), "conference": (("own",), 0.93)}
JUDGED = ("sponza-crytek", "sibenik")
PUBLISHED_SSIM = (0.43, 0.54, 0.59, 0.37, 0.49)


def quality(section):
    """Both presets against the truth: two views of Sponza, three of Sibenik, and three more scenes; as a picture, too."""
    rows, shown, labels, exposures = [], [], [], []
    for scene in each_lit_scene(section, QUALITY):
        cameras, _ = QUALITY[scene.name]
        for camera in cameras:
            found, pictures = quality_rows(section, scene, camera)
            rows += found
            if scene.name in JUDGED:
                shown += pictures
                labels += [text % (scene.name, camera) for text in ("%s %s: paper", "%s %s: best", "%s %s: path tracer")]
                exposures += [scene.exposure] * 3
    section.text("%s, 4 x 4 averages, all bounces. `best`: %d frames, the last %d averaged; `paper` as it is by default. "
                 "Energy and relMSE of indirect light, which `paper` cannot tell from direct light; SSIM of the whole "
                 "picture, and of indirect light alone. *Noise*: relMSE that the truth's own noise makes (demand: at most %g). Demands on "
                 "`best` in the five views of Sponza and Sibenik: energy %g to %g, SSIM at least %g. Published, of five "
                 "pictures of the two buildings against another renderer, places of light and camera fitted by hand: SSIM "
                 "%s." % (SIZE, FRAMES, SAMPLES, NOISE, *ENERGY, QUALITY["sibenik"][1],
                          ", ".join("%.2f" % value for value in PUBLISHED_SSIM)))
    section.table(["scene", "camera", "preset", "energy", "energy, whole", "relMSE", "SSIM", "SSIM, indirect", "noise",
                   "paths", "seconds"], rows)
    if shown:
        section.picture(montage(section, "ray-traced-voxels-quality", shown, labels, exposures, columns=3),
                        "Sponza and Sibenik: paper, best and the path tracer")


def quality_rows(section, scene, camera):
    """(rows of the table, pictures of paper, best and the truth)"""
    ssim = QUALITY[scene.name][1]
    true = true_light(section, scene, camera, (1 - ssim) / 100)
    rows, pictures = [], []
    for name, frames in (("paper", PAPER_FRAMES), ("best", FRAMES)):
        picture, stats = draw(section, scene.path, scene.view(camera),
                              "ray-traced-voxels-quality-%s-%s-%s" % (scene.name, camera, name), preset(name), frames)
        pictures.append(picture)
        light, whole = (section.compare(part(picture, aov), part(true.path, aov), "--block", 4, "--exposure",
                                        scene.exposure) for aov in ("indirect", "combined"))
        judged = name == "best" and scene.name in JUDGED
        what = "%s, %s, " % (scene.name, camera)
        best = name == "best"
        rows.append([scene.name, camera, "`%s`" % name,
                     within(section, light["energy"], *ENERGY, what + "energy", judged) if best else "",
                     "%.4f" % whole["energy"], number(light["relMSE"]) if best else "",
                     section.demand(not judged or whole["ssim"] >= ssim, "%.4f" % whole["ssim"], what + "SSIM"),
                     "%.4f" % light["ssim"] if best else "",
                     section.demand(true.noise <= NOISE, number(true.noise, 2), what + "noise"), str(true.samples),
                     "%.1f" % (stats["wall_time_ms"] / 1000)])
    return rows, [*pictures, true.path]


# ---- leak ----

CELL = 0.25  # m: the wall of two-rooms as it is
WALLS = (4, 2, 1, 0.5, 0.25)  # cells
LEAK_CELLS = 64
OFFSETS = 8
LEAK_FRAMES = 16
LEAK_SETTINGS = (("best", {}), ("best", {"inject": "light"}), ("best", {"rays": 0}), ("paper", {"ambient": 0, "taps": 1}),
                 ("paper", {"ambient": 0, "taps": 7}))


def leak(section):
    """Light in the sealed room against the wall's thickness in cells, over 8 offsets of the grid."""
    scenes = {cells: walled(cells) for cells in WALLS}
    rows = []
    for name, options in LEAK_SETTINGS:
        row = ["`%s`" % " ".join([name, *("--%s %s" % option for option in options.items())])]
        for cells in WALLS:
            share, worst = leak_through(section, scenes[cells], preset(name, resolution=LEAK_CELLS, **options),
                                        LEAK_FRAMES if name == "best" else 1)
            judged = name == "best" and cells >= 1
            row.append(section.demand(not judged or share <= 0.01, "%.3f %%" % (100 * share),
                                      "leak of %s through a wall of %g cells" % (row[0], cells)))
            if cells == 1:
                row.append("%.3f %%" % (100 * worst))
        rows.append(row)
    section.text("`two-rooms` with walls of other thickness between the rooms; cells of %g m. Mean radiance of the view "
                 "`sealed` over that of the view `lit`, combined, 64 x 64, %d frames of `best`; mean of %d offsets of the "
                 "grid along the wall's normal, an eighth of a cell apart. Demand on `best`: at most 1 %% with walls of one "
                 "cell and more. *1, worst*: of the eight." % (CELL, LEAK_FRAMES, OFFSETS))
    head = ["wall, cells"]
    for cells in WALLS:
        head += ["1", "1, worst"] if cells == 1 else ["%g" % cells]
    section.table(head, rows)


def walled(cells):
    """two-rooms with a wall of so many cells between its rooms."""
    scene = MovingScene(cli.scene_file("two-rooms"))
    scene.gltf["nodes"][scene.node("wall between")]["scale"] = [cells, 1, 1]
    return scene.save(output("two-rooms-%g.gltf" % cells))


def leak_through(section, scene, technique, frames):
    """(mean of the offsets, worst offset)"""
    half = CELL * (LEAK_CELLS - 1 / 128) / 2  # the fit leaves 1/256 of a cell free on both sides
    sums, worst = {"sealed": 0.0, "lit": 0.0}, 0.0
    for step in range(OFFSETS):
        shift = CELL * (step - OFFSETS / 2) / OFFSETS
        bounds = ",".join("%.6f" % v for v in (shift - half, -half, -half, shift + half, half, half))
        means = {}
        for camera in sums:
            picture = output("ray-traced-voxels-leak.exr")
            section.run("render", scene, *technique, "--grid-bounds=" + bounds, "--camera", camera, "--size", "64x64",
                        "--frames", frames, "--samples", min(frames, 4), "--shadows", "rays", "-o", picture)
            means[camera] = mean_of(section, picture)
            sums[camera] += means[camera]
        worst = max(worst, means["sealed"] / means["lit"])
    return sums["sealed"] / sums["lit"], worst


# ---- taps ----

TAPS = (("paper, 1 tap", "paper", {"taps": 1, "ambient": 0}, PAPER_FRAMES),
        ("paper, 7 taps", "paper", {"taps": 7, "ambient": 0}, PAPER_FRAMES),
        ("best, 1 look-up", "best", {"rays": 0}, FRAMES), ("best", "best", {}, FRAMES))
STREAK_RADIUS = 3  # pixels
STREAK = 0.5       # of the light around


def taps(section):
    """Arches of Sponza: streaks with 1 and 7 taps of `paper`, with one look-up of `best`, and with its rays."""
    scene = LitScene("sponza-crytek")
    view = scene.view("arches")
    true = true_light(section, scene, "arches")
    surface, smooth = smooth_surface(section, scene, view)
    found = [(label, draw(section, scene.path, view, "ray-traced-voxels-taps-" + label.replace(",", "").replace(" ", "-"),
                          preset(name, **options), frames)[0]) for label, name, options, frames in TAPS]
    found.append(("path tracer", true.path))
    shares = {label: streaks(irradiance(picture, surface), smooth) for label, picture in found}
    rows = []
    for label, picture in found:
        error = section.compare(picture, true.path, "--exposure", scene.exposure)
        rows.append([label, number(error["relMSE"]), "%.4f" % error["ssim"],
                     section.demand(not label.startswith("best") or shares[label] <= shares["path tracer"],
                                    "%.2f %%" % (100 * shares[label]), "streaks of " + label)])
    section.text("`sponza-crytek`, camera `arches`, %s, pixel by pixel, the whole picture; `paper` without ambient light, "
                 "which would lighten its streaks. *Streaks*: of the pixels away from edges, those whose irradiance is less "
                 "than half of the median of the %d x %d around them (demand on `best`: no more than of the path tracer's, "
                 "which are noise and the edges of shadows)." % (SIZE, 2 * STREAK_RADIUS + 1, 2 * STREAK_RADIUS + 1))
    section.table(["", "relMSE", "SSIM", "streaks"], rows)
    section.picture(montage(section, "ray-traced-voxels-taps", [picture for _, picture in found],
                            [label.replace(",", "") for label, _ in found], scene.exposure),
                    "Arches of Sponza: paper with 1 and 7 taps, best with one look-up and with rays, the path tracer")


def smooth_surface(section, scene, view):
    """(albedo, rows of booleans: all around is at about the same distance and has about the same normal)"""
    picture = output("ray-traced-voxels-surface.exr")
    section.run("render", scene.path, *view, "--technique", "none", "--size", SIZE, "--frames", SAMPLES, "--samples",
                SAMPLES, "--aov", "normal,depth,albedo", "-o", picture)
    kept = None
    for aov, channels, alike in (("depth", 1, lambda low, high: 0 < high <= 1.2 * low),
                                 ("normal", 3, lambda low, high: high - low <= 0.3)):
        image = pixels.load_exr(part(picture, aov))
        for c in range(channels):
            low, high = pixels.spread([[p[c] for p in row] for row in image], STREAK_RADIUS)
            found = [[alike(*pair) for pair in zip(*rows)] for rows in zip(low, high)]
            kept = found if kept is None else [[x and y for x, y in zip(*rows)] for rows in zip(kept, found)]
    return pixels.load_exr(part(picture, "albedo")), kept


def irradiance(picture, albedo):
    """What a picture's pixels get, in parts: light over albedo, both summed over the channels."""
    return [[sum(p) / max(sum(a), 1e-3) for p, a in zip(*rows)] for rows in zip(pixels.load_exr(picture), albedo)]


def streaks(light, smooth):
    """Share of the smooth pixels that are much darker than most around."""
    r, dark, count = STREAK_RADIUS, 0, 0
    for y, row in enumerate(smooth):
        for x, counts in enumerate(row):
            if counts:
                around = sorted(value for line in light[max(0, y - r):y + r + 1] for value in line[max(0, x - r):x + r + 1])
                count += 1
                dark += light[y][x] < STREAK * around[len(around) // 2]
    return dark / max(count, 1)


# ---- an emitter's light ----

def cornell_original(section):
    """The measured Cornell box under its emitter, whole pictures of three techniques against the shared reference."""
    scene, folder, exposure = reference("cornell_original")
    rows = []
    for technique in ("light-volume", "many-light", "ray-traced-voxels"):
        picture, stats = draw(section, scene, (), "ray-traced-voxels-cornell-original-" + technique,
                              method(technique, "best"), FRAMES)
        errors = {aov: section.compare(part(picture, aov), "%s/cam0_%s.exr" % (folder, aov), "--exposure", exposure)
                  for aov in ("combined", "direct", "indirect")}
        whole = errors["combined"]
        rows.append([technique, within(section, whole["energy"], 0.98, 1.02, technique + ", energy"),
                     section.demand(whole["ssim"] >= 0.97, "%.4f" % whole["ssim"], technique + ", SSIM"), number(whole["relMSE"]),
                     *("%.4f" % errors[aov]["energy"] for aov in ("direct", "indirect")),
                     "%.1f" % (stats["wall_time_ms"] / 1000)])
    section.text("%s, `best` of each, %d frames, the last %d averaged, against the reference by another renderer (Cycles), "
                 "pixel by pixel. Demands on the whole picture: energy 0.98 to 1.02, SSIM at least 0.97." % (
                     SIZE, FRAMES, SAMPLES))
    section.table(["technique", "energy", "SSIM", "relMSE", "energy, direct", "energy, indirect", "seconds"], rows)


# ---- writers ----

WRITER_SCENES = {"cornell-spot": "own", "sponza-crytek": "nave"}
WRITERS = ("exact", "average", "maximum", "none")
STAGES = ("voxelise", "inject", "final")


def writers(section):
    """What each writer of `paper` costs the picture, and tracing voxels instead of triangles."""
    rows = []
    for scene in each_lit_scene(section, WRITER_SCENES):
        rows += writer_rows(section, scene, WRITER_SCENES[scene.name])
    section.text("`paper`, %s, 128³, 512 x 512 rays a light, no ambient light, no sky: light straight from lights, which is "
                 "all that it puts into voxels without `--secondaries`. *Exact* is the average of all that reaches a voxel. "
                 "*To the truth*: against the path tracer without bounces, 4 x 4 averages; *to exact*: against the same "
                 "picture with `--writer exact`, pixel by pixel. Times: device, ms, fastest of 4 frames that all begin from "
                 "nothing." % SIZE)
    section.table(["scene", "writer", "rays meet", "energy", "relMSE, to the truth", "SSIM, to the truth", "relMSE, to exact",
                   "SSIM, to exact", *("%s, ms" % stage for stage in STAGES)], rows)


def writer_rows(section, scene, camera):
    view = [option for option in scene.view(camera) if not option.startswith("--env")]
    true, _ = truth(section, scene.path, SIZE, 64, 0, *view)
    exact, rows = None, []
    for writer, traced in [(writer, "triangles") for writer in WRITERS] + [("exact", "voxels"), ("average", "voxels")]:
        technique = preset("paper", writer=writer, trace=traced, ambient=0)
        picture, _ = draw(section, scene.path, view, "ray-traced-voxels-writers-%s-%s-%s" % (scene.name, writer, traced),
                          technique, PAPER_FRAMES)
        exact = exact or picture
        error = section.compare(picture, true, "--block", 4, "--exposure", scene.exposure)
        degraded = section.compare(picture, exact, "--exposure", scene.exposure)
        times = bench(section, scene.path, *view, *technique, "--size", SIZE, "--frames", 4, "--warm-up", 1, "--cut",
                      "every")
        rows.append([scene.name, writer, traced, "%.4f" % error["energy"], number(error["relMSE"]), "%.4f" % error["ssim"],
                     number(degraded["relMSE"]), "%.4f" % degraded["ssim"],
                     *(milliseconds(fastest(times, ("ray-traced voxels: " + stage,))) for stage in STAGES)])
    return rows


FIGURES = {"ray-traced-voxels-quality": quality, "ray-traced-voxels-leak": leak, "ray-traced-voxels-taps": taps,
           "ray-traced-voxels-cornell-original": cornell_original, "ray-traced-voxels-writers": writers}
