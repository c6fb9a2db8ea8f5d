"""Figures about light: the path tracer, direct light, and the light volume, each against the truth."""

import math
import time

import cli
import pixels
from figures import Missing, number, output, part, reference, render, shared, truth

REFERENCES = ("cornell_original", "cornell_spot", "room_windows")
REFERENCE_BOUNCES = 32  # that they were made with
SIZE = "256x256"  # of the shared references


def ratio(section, value, low, high, what):
    return section.demand(low <= value <= high, "%.4f" % value, "%s within %g to %g" % (what, low, high))


# ---- the path tracer ----

def path_tracer(section):
    """Path tracer against the shared reference images: energy ratios and time."""
    rows = []
    for name in REFERENCES:
        try:
            scene, folder, exposure = reference(name)
        except Missing as reason:
            section.skip(name, str(reason))
            continue
        picture, _ = truth(section, scene, SIZE, 64, REFERENCE_BOUNCES)
        for aov, file in (("direct", "cam0_direct.exr"), ("indirect", "cam0_indirect.exr"),
                          ("combined", "cam0_combined.exr")):
            rows.append(energy_row(section, name, aov + ", all bounces",
                                   picture if aov == "combined" else part(picture, aov), folder + "/" + file, exposure))
        for bounces in (1, 2):
            file = "%s/cam0_combined_b%d.exr" % (folder, bounces)
            if name == "cornell_original":
                continue
            limited, _ = truth(section, scene, SIZE, 64, bounces)
            rows.append(energy_row(section, name, "combined, %d bounce%s" % (bounces, "s" * (bounces > 1)), limited, file,
                                   exposure))
    section.text("Energy ratio to the reference (demand: 0.99 to 1.01) and relMSE of 4 x 4 averages; 64 paths a pixel.")
    section.table(["reference", "light", "energy", "relMSE, 4 x 4"], rows)
    _, seconds = truth(section, cli.scene_file("cornell-box"), SIZE, 256, 8)
    section.text("Cornell box, 256 x 256, 256 paths a pixel, 8 bounces: %s (demand: under 60 s)." % section.demand(
        seconds < 60, "%.1f s" % seconds, "Cornell box in under 60 s"))


def energy_row(section, name, light, picture, wanted, exposure):
    error = section.compare(picture, wanted, "--exposure", exposure)
    blocks = section.compare(picture, wanted, "--exposure", exposure, "--block", 4)
    return [name, light, ratio(section, error["energy"], 0.99, 1.01, "energy of %s, %s" % (name, light)),
            number(blocks["relMSE"])]


# ---- direct light ----

DIRECT_SCENES = ("cornell-spot", "boxes", "room", "arena")


def direct(section):
    """Direct light of points and suns in the GPU frame, by shadow maps and by rays, against the path tracer."""
    rows = []
    for name in DIRECT_SCENES + REFERENCES[1:]:
        try:
            scene = reference(name)[0] if name in REFERENCES else cli.scene_file(name)
        except Missing as reason:
            section.skip(name, str(reason))
            continue
        rows += [direct_row(section, scene, name, shadows) for shadows in ("maps", "rays")]
    section.text("256 x 256, 16 samples a pixel against 64 paths. *Within 1 %*: share of the lit pixels away from edges "
                 "and shadow borders (next column: their share of the picture). Demands: 0.995 to 1.005, 95 %, 0.97.")
    section.table(["scene", "shadows", "mean ratio", "within 1 %", "of the picture", "SSIM"], rows)


def direct_row(section, scene, name, shadows):
    exposure = reference(name)[2] if name in REFERENCES else cli.scene_exposure(scene)
    true = part(truth(section, scene, SIZE, 64, 0)[0], "direct")
    picture = render(section, scene, "direct-%s-%s" % (name, shadows), "--technique", "none", "--size", SIZE, "--samples",
                     16, "--shadows", shadows)
    error = section.compare(part(picture, "direct"), true, "--exposure", exposure)
    share, counted = share_within(part(picture, "direct"), true, picture, 0.01)
    what = "direct light of %s by %s, " % (name, shadows)
    return [name, shadows, ratio(section, error["energy"], 0.995, 1.005, what + "mean ratio"),
            section.demand(share >= 0.95, "%.1f %%" % (100 * share), what + "within 1 %"), "%.0f %%" % (100 * counted),
            section.demand(error["ssim"] >= 0.97, "%.4f" % error["ssim"], what + "SSIM")]


# ---- light of emitters and of the environment ----

SOURCE_FRAMES = (4, 16, 64)


def source_scenes(section):
    """(name, scene, options, exposure, true direct light, true picture) of scenes lit by emitters or from outside."""
    try:
        scene, folder, exposure = reference("cornell_original")
        yield "cornell_original", scene, (), exposure, folder + "/cam0_direct.exr", folder + "/cam0_combined.exr"
    except Missing as reason:
        section.skip("cornell_original", str(reason))
    outside = [("arena, constant sky", "arena", ("--no-lights", "--env", "1,1,1"))]
    try:
        outside.append(("arena, HDR sky", "arena", ("--no-lights", "--env", shared("scenes", "envmaps",
                                                                                "venice_sunset_1k.hdr"))))
    except Missing as reason:
        section.skip("arena, HDR sky", str(reason))
    outside.append(("textured, its emitter alone", "textured", ("--no-lights",)))
    for name, built_in, options in outside:
        scene = cli.scene_file(built_in)
        true, _ = truth(section, scene, SIZE, 1024, 0, *options)
        all_bounces, _ = truth(section, scene, SIZE, 256, None, *options)
        yield name, scene, options, cli.scene_exposure(scene), part(true, "direct"), all_bounces


def sources(section):
    """Direct light of emitters and of the environment by traced samples, and the whole picture with light_volume."""
    rows, combined = [], []
    for name, scene, options, exposure, true, all_bounces in source_scenes(section):
        for frames in SOURCE_FRAMES:
            path = "sources-%s-%d" % (name.replace(", ", "-").replace(" ", "-"), frames)
            samples = min(frames, 16)
            started = time.monotonic()
            picture = render(section, scene, path, "--technique", "none", "--size", SIZE, "--frames", frames, "--samples",
                             samples, *options)
            seconds = time.monotonic() - started
            error = section.compare(part(picture, "direct"), true, "--exposure", exposure)
            last, what = frames == SOURCE_FRAMES[-1], "sources, %s, " % name
            rows.append([name, str(frames),
                         section.demand(not last or 0.99 <= error["energy"] <= 1.01, "%.4f" % error["energy"],
                                        what + "mean ratio"),
                         section.demand(not last or error["ssim"] >= 0.97, "%.4f" % error["ssim"], what + "SSIM"),
                         number(error["relMSE"]), "%.1f" % seconds])
        picture = render(section, scene, "sources-all-" + path, "--size", SIZE, "--samples", 16, *options)
        error = section.compare(picture, all_bounces, "--exposure", exposure)
        combined.append([name, "%.4f" % error["energy"], "%.4f" % error["ssim"], number(error["relMSE"])])
    section.text("256 x 256, one ray a pixel and frame to emitters and one to the environment, the last 16 frames (or as "
                 "many as there are) jittered and averaged; direct light against the reference or 1024 paths. Demands on 64 "
                 "frames: mean ratio 0.99 to 1.01, SSIM at least 0.97. Seconds are those of the whole command.")
    section.table(["scene", "frames", "mean ratio", "SSIM", "relMSE", "seconds"], rows)
    section.text("Together with `light-volume` (`best`, 32³, until steady): the whole picture against the reference, or 256 "
                 "paths with all bounces.")
    section.table(["scene", "energy", "SSIM", "relMSE"], combined)


def share_within(test, true, picture, tolerance):
    """Of lit pixels whose 5 x 5 neighbours have about the same normal, depth, albedo and irradiance: the share within
    `tolerance`; and how much of the picture they are."""
    albedo = pixels.load_exr(part(picture, "albedo"))
    t, r = pixels.load_exr(test), pixels.load_exr(true)
    light = [[sum(q) / max(sum(a), 1e-6) for q, a in zip(*rows)] for rows in zip(r, albedo)]
    quiet = smooth(light, lambda low, high: low > 0 and high <= 1.2 * low)
    for c in range(3):
        quiet = both(quiet, smooth([[a[c] for a in row] for row in albedo], lambda low, high: high - low <= 0.02))
        normal = pixels.load_exr(part(picture, "normal"))
        quiet = both(quiet, smooth([[n[c] for n in row] for row in normal], lambda low, high: high - low <= 0.05))
    depth = [[d[0] for d in row] for row in pixels.load_exr(part(picture, "depth"))]
    quiet = both(quiet, smooth(depth, lambda low, high: low > 0 and high <= 1.2 * low))
    good = count = 0
    for y, row in enumerate(quiet):
        for x, use in enumerate(row):
            if use:
                count += 1
                good += abs(sum(t[y][x]) - sum(r[y][x])) <= tolerance * sum(r[y][x])
    return good / max(count, 1), count / (len(t) * len(t[0]))


def smooth(values, test):
    low, high = pixels.spread(values, 2)
    return [[test(a, b) for a, b in zip(*rows)] for rows in zip(low, high)]


def both(a, b):
    return [[p and q for p, q in zip(*rows)] for rows in zip(a, b)]


# ---- light volume ----

# Planes as (axis, place in metres, direction of the normal along the axis).
PLANES = {
    "cornell_original": {"ceiling": (1, 0.5488, -1), "back wall": (2, 0.5592, -1)},
    "cornell_spot": {"ceiling": (1, 0.5488, -1), "back wall": (2, 0.5592, -1)},
    "room_windows": {"ceiling": (1, 5.0, -1), "back wall": (0, 8.0, -1)},
}
STAIRS = (76, 130, 130, 200)  # left, top, right, bottom in pixels of room_windows: wall and floor under the stairs
SETTINGS = (("best", 32, ()), ("best", 64, ()), ("paper", 32, ("--steps", 64)), ("paper", 64, ("--steps", 128)),
            ("paper-lpv", 32, ("--steps", 64)))


def light_volume(section):
    """Light volume, all presets, against the shared references."""
    section.text("256 x 256, 4 samples a pixel; `best` runs until it is steady, `paper` and `paper-lpv` do 2 steps a cell "
                 "along the grid. `paper` cannot tell an emitter's direct light from its indirect light, so `cornell_original` is "
                 "judged by direct + indirect, the others by indirect alone. Demands on `best` (`cornell_spot`, "
                 "`room_windows`): energies 0.85 to 1.15, SSIM (combined) at least 0.85, relMSE lower at 64³.")
    for name in REFERENCES:
        try:
            light_volume_scene(section, name)
        except Missing as reason:
            section.skip(name, str(reason))


def light_volume_scene(section, name):
    scene, folder, exposure = reference(name)
    aovs = ["direct", "indirect"] if name == "cornell_original" else ["indirect"]
    wanted = add([pixels.load_exr("%s/cam0_%s.exr" % (folder, aov)) for aov in aovs])
    camera = section.run_json("info", scene, "--json")["cameras"][0]
    rows, stairs, regions = [], {}, None
    for preset, resolution, more in SETTINGS:
        picture = output("volume-%s-%s-%d.exr" % (name, preset, resolution))
        stats = section.run_json("render", scene, "--technique", "light-volume", "--preset", preset, "--resolution",
                                 resolution, *more, "--size", SIZE, "--samples", 4, "--stats", "json", "--aov",
                                 "direct,indirect,albedo,normal,depth", "-o", picture)
        regions = regions or find_regions(picture, camera, PLANES[name])
        found = add([pixels.load_exr(part(picture, aov)) for aov in aovs])
        energies = {region: energy(found, wanted, mask) for region, mask in regions.items()}
        error = rel_mse(found, wanted, None)
        ssim = section.compare(picture, folder + "/cam0_combined.exr", "--exposure", exposure)["ssim"]
        stairs[preset, resolution] = rel_mse(found, wanted, STAIRS) if name == "room_windows" else None
        rows.append(volume_row(section, name, preset, resolution, energies, error, ssim, stats))
        if preset == "best" and resolution == 32:
            coarse = error
        if preset == "best" and resolution == 64 and name != "cornell_original":
            rows[-1][2] = section.demand(error < coarse, rows[-1][2], "relMSE of %s, best, lower at 64" % name)
    section.text("**%s**" % name)
    section.table(["preset", "cells", "relMSE", "SSIM", *("energy, " + r for r in regions), "frames", "seconds in all"], rows)
    if name == "room_windows":
        part_of = stairs["best", 32] / stairs["paper-lpv", 32]
        section.text("Under the stairs (pixels %d to %d across, %d to %d down): relMSE of `best` %s, of `paper` %s, of "
                     "`paper-lpv` %s; best / paper-lpv = %s (demand: at most 0.5)." % (
                         STAIRS[0], STAIRS[2], STAIRS[1], STAIRS[3], number(stairs["best", 32]),
                         number(stairs["paper", 32]), number(stairs["paper-lpv", 32]),
                         section.demand(part_of <= 0.5, number(part_of), "under the stairs")))


def volume_row(section, name, preset, resolution, energies, error, ssim, stats):
    judged = preset == "best" and name != "cornell_original"
    what = "%s, %s %d³, " % (name, preset, resolution)
    cells = [section.demand(not judged or 0.85 <= e <= 1.15, "%.3f" % e, what + "energy, " + r) for r, e in energies.items()]
    return ["`%s`" % preset, "%d³" % resolution, number(error),
            section.demand(not judged or resolution != 32 or ssim >= 0.85, "%.3f" % ssim, what + "SSIM"), *cells,
            str(stats["frames"]), "%.1f" % (stats["wall_time_ms"] / 1000)]


def add(pictures):
    return [[tuple(map(sum, zip(*p))) for p in zip(*rows)] for rows in zip(*pictures)]


def energy(test, true, mask):
    sums = [0.0, 0.0]
    for rows in zip(test, true, mask):
        for t, r, use in zip(*rows):
            if use:
                sums[0] += sum(t)
                sums[1] += sum(r)
    return sums[0] / sums[1]


def rel_mse(test, true, window):
    left, top, right, bottom = window or (0, 0, len(true[0]), len(true))
    errors = [(a - b) ** 2 / (b * b + 0.01) for t, r in zip(test[top:bottom], true[top:bottom])
              for p, q in zip(t[left:right], r[left:right]) for a, b in zip(p, q)]
    return sum(errors) / len(errors)


def find_regions(picture, camera, planes):
    """Masks: the whole picture, and the pixels that lie on each plane, by normal, depth and camera; emitters left out."""
    normal, depth, albedo = (pixels.load_exr(part(picture, aov)) for aov in ("normal", "depth", "albedo"))
    height, width = len(depth), len(depth[0])
    forward, eye = camera["forward"], camera["position"]
    length = math.hypot(forward[0], forward[2])
    right = (-forward[2] / length, 0.0, forward[0] / length)
    up = (right[1] * forward[2] - right[2] * forward[1], right[2] * forward[0] - right[0] * forward[2],
          right[0] * forward[1] - right[1] * forward[0])
    scale = math.tan(math.radians(camera["yfov_degrees"]) / 2)
    masks = {"whole": [[True] * width for _ in range(height)]}
    masks.update({name: [[False] * width for _ in range(height)] for name in planes})
    for y in range(height):
        for x in range(width):
            u, v = scale * (2 * (x + 0.5) - width) / height, scale * (1 - 2 * (y + 0.5) / height)
            for name, (axis, place, direction) in planes.items():
                at = eye[axis] + depth[y][x][0] * (forward[axis] + u * right[axis] + v * up[axis])
                masks[name][y][x] = (direction * normal[y][x][axis] > 0.99 and abs(at - place) < 0.02 * place and
                                     max(albedo[y][x]) > 0.01)
    return masks


FIGURES = {"path-tracer": path_tracer, "direct": direct, "sources": sources, "light-volume": light_volume}
