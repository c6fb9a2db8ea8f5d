"""All techniques and presets on the same scenes, in one run: time, memory, error, leak, flicker, beside the path tracer."""

import json

import cli
from figures import (MOST_SAMPLES, LitScene, Missing, mean_of, method, milliseconds, montage, number, output, part,
                     quiet_truth, truth)
from figures_many_light_time import changes, difference, gray, mean_over, mean_product, root, static_pixels
from moving_scene import MovingScene

SIZE = "128x128"
QUIET = 0.002      # relMSE of a truth's noise, 4 x 4 averages; it is subtracted
PATHS = 16         # a pixel, of the path tracer that is compared
FRAMES = 32        # of presets that settle over frames; the last half of them is averaged
PAPER_FRAMES = 4
PRESETS = (("light-volume", "best"), ("light-volume", "paper"), ("light-volume", "paper-lpv"), ("many-light", "best"),
           ("many-light", "paper"), ("ray-traced-voxels", "best"), ("ray-traced-voxels", "paper"),
           ("photon-splatting", "best"), ("photon-splatting", "paper"))
WITH_DIRECT = {("ray-traced-voxels", "paper")}  # direct light of lights cannot be told from the rest
WITH_AMBIENT = {("ray-traced-voxels", "paper"), ("photon-splatting", "paper")}
SUN_AND_SKY = ("--sun=0.4,-1,0.3 20", "--env=1.5,1.8,2.2")


class View:
    """A scene with light and camera."""

    def __init__(self, label, path, options, exposure):
        self.label, self.path, self.options, self.exposure = label, path, list(options), exposure


def lit(label, name, camera="own"):
    scene = LitScene(name)
    return View(label, scene.path, scene.view(camera), scene.exposure)


def built_in(label, name, *options, exposure=1):
    return View(label, cli.scene_file(name), options, exposure)


def two_rooms_with_a_door():
    """The wall between the rooms ends a metre before the side wall."""
    scene = MovingScene(cli.scene_file("two-rooms"))
    wall = scene.gltf["nodes"][scene.node("wall between")]
    wall["scale"] = [1, 1, 0.75]
    return View("two rooms, door", scene.save(output("two-rooms-door.gltf")), ["--camera=sealed"], 1)


VIEWS = (lambda: lit("Cornell, spot", "cornell-spot"), lambda: built_in("Cornell, emitter", "cornell-box"),
         lambda: lit("room", "room"), lambda: built_in("arena, sun and sky", "arena", *SUN_AND_SKY, exposure=0.2),
         lambda: lit("Sponza, sun and sky", "sponza-crytek", "nave"), lambda: lit("Sibenik, lamps", "sibenik"),
         lambda: lit("conference", "conference"), two_rooms_with_a_door)


def side_by_side(section):
    """Every technique and preset on eight scenes."""
    results = []
    for make in VIEWS:
        try:
            view = make()
        except Missing as reason:
            section.skip("a scene", str(reason))
            continue
        results += scene_rows(section, view)
    with open(output("side-by-side.json"), "w", encoding="utf-8") as f:
        json.dump(results, f, indent=1)
    section.text("%s; `best` %d frames, `paper` %d, the last %d averaged. *Own*: device ms a frame of all passes that "
                 "`--technique none` does not have; *frame*: all of it. Memory: all of it, MiB. Energy and relMSE (truth's noise "
                 "subtracted) of indirect light, SSIM and FLIP of the whole picture, 4 x 4 averages, against the path tracer at as many bounces as the preset shows. *Path "
                 "tracer*: relMSE that it has after the same time (all frames), and seconds that it takes to the same relMSE, both "
                 "from %d paths a pixel, as error falls with 1 / time. `ray-traced-voxels paper` keeps direct light in its voxels: "
                 "its energy and relMSE are those of the whole picture. As JSON, with each pass: "
                 "build/results/side-by-side.json." % (SIZE, FRAMES, PAPER_FRAMES, FRAMES // 2, PATHS))
    section.table(["scene", "technique", "own, ms", "frame, ms", "MiB", "energy", "relMSE", "SSIM", "FLIP", "path tracer, same time",
                   "same error, s"], [[*r["labels"], milliseconds(r["own_ms"]), milliseconds(r["frame_ms"]), "%.0f" % r["mib"],
                                       "%.3f" % r["energy"], number(r["relMSE"], 2), "%.3f" % r["ssim"], "%.3f" % r["flip"],
                                       number(r["traced_relMSE"], 2), number(r["traced_seconds"], 2)] for r in results])


def scene_rows(section, view):
    truths = {bounces: TracedView(section, view, bounces) for bounces in {None, *(cli.most_bounces(*p) for p in PRESETS)}}
    base = run(section, view, ("--technique", "none"), 1, "side-by-side-none")[1]
    shared_passes = {p["name"] for p in base["passes"]}
    rows, pictures = [], []
    for technique, preset in PRESETS:
        frames = FRAMES if preset == "best" else PAPER_FRAMES
        picture, stats = run(section, view, method(technique, preset), frames,
                             "side-by-side-%s-%s-%s" % (slug(view.label), technique, preset))
        pictures.append(picture)
        traced = truths[cli.most_bounces(technique, preset)]
        true, traced_cost = traced.true, traced.cost
        light = errors(section, view, picture, true, "combined" if (technique, preset) in WITH_DIRECT else "indirect")
        whole = errors(section, view, picture, true, "combined")
        each = {p["name"]: p["time_ms"] * p["frames"] / stats["frames"] for p in stats["passes"]}
        time = stats["gpu_time_ms"] * stats["frames"] / 1000
        error = max(light["relMSE"] - true.noise, 0.0)
        rows.append({"labels": [view.label, "%s `%s`" % (technique, preset)], "frame_ms": stats["gpu_time_ms"],
                     "own_ms": sum(ms for name, ms in each.items() if name not in shared_passes),
                     "mib": sum(stats["memory_bytes"].values()) / 2 ** 20, "energy": light["energy"], "relMSE": error,
                     "ssim": whole["ssim"], "flip": whole["flip"], "traced_relMSE": traced_cost / max(time, 1e-9),
                     "traced_seconds": traced_cost / max(error, 1e-9), "passes": each})
    montage(section, "side-by-side-" + slug(view.label), [*pictures, truths[None].true.path],
            [" ".join(names) for names in PRESETS] + ["path tracer"], view.exposure, columns=5)
    return rows


class TracedView:
    """The truth of a view at so many bounces, and relMSE times seconds of the path tracer there."""

    def __init__(self, section, view, bounces):
        self.true = quiet_truth(section, view.path, SIZE, bounces, view.options, QUIET, MOST_SAMPLES)
        traced, seconds = truth(section, view.path, SIZE, PATHS, bounces, *view.options)
        self.cost = seconds * max(errors(section, view, traced, self.true, "indirect")["relMSE"] - self.true.noise, 0.0)


def slug(label):
    return label.lower().replace(",", "").replace(" ", "-")


def errors(section, view, picture, true, aov):
    return section.compare(part(picture, aov), part(true.path, aov), "--block", 4, "--exposure", view.exposure)


def run(section, view, technique, frames, name):
    picture = output(name + ".exr")
    return picture, section.run_json("render", view.path, *view.options, *technique, "--size", SIZE, "--frames", frames,
                                     "--samples", max(1, frames // 2), "--aov", "direct,indirect", "--stats", "json", "-o", picture)


# ---- leak and flicker ----

STEADY_FRAMES = 24
STEADY_SIZE = "64x64"
TRUE_SAMPLES = 64


def steadiness(section):
    """Leak into a sealed room, and flicker under moving lights, of every technique and preset."""
    scene = cli.scene_file("cornell-dynamic")
    true = {bounces: [gray(sequence(section, scene, "true%d-%s" % (seed, bounces or "all"), "--technique", "path-tracer", "--samples",
                                    TRUE_SAMPLES, *cli.bounce_options(bounces), "--seed", seed)) for seed in (1, 2)]
            for bounces in {None, *(cli.most_bounces(*p) for p in PRESETS)}}
    static, rows = None, []
    for technique, preset in PRESETS:
        files = sequence(section, scene, "%s-%s" % (technique, preset), *method(technique, preset), "--samples", 1)
        static = static or static_pixels(files)
        truths = true[cli.most_bounces(technique, preset)]
        scale = mean_over(truths[0], static)
        own = changes(gray(files))
        flicker = root(mean_product(*(difference(own, changes(t)) for t in truths), static)) / scale
        rows.append(["%s `%s`" % (technique, preset), "%.3f %%" % (100 * leak(section, technique, preset)), "%.4f" % flicker])
    own_changes = root(mean_product(*map(changes, true[None]), static)) / mean_over(true[None][0], static)
    section.text("*Leak*: mean of the view `sealed` of `two-rooms` over that of the view `lit`, whole picture, as each preset is by "
                 "default. *Flicker*: `cornell-dynamic`, %s, %d frames, indirect light at pixels whose surface stays: root mean "
                 "square, over the mean of the truth at as many bounces, of what changes from frame to frame and is not the truth's own change (%.4f)."
                 % (STEADY_SIZE, STEADY_FRAMES, own_changes))
    section.table(["technique", "leak", "flicker"], rows)


def sequence(section, scene, name, *options):
    """Files of the frames; indirect light and depth lie beside them."""
    section.run("render", scene, *options, "--size", STEADY_SIZE, "--frames", STEADY_FRAMES, "--aov", "indirect,depth", "-o",
                output("side-by-side-steady", name + "-%03d.exr"), timeout=1800)
    return [output("side-by-side-steady", name + "-%03d.exr" % frame) for frame in range(STEADY_FRAMES)]


def leak(section, technique, preset):
    means = {}
    for camera in ("sealed", "lit"):
        picture = output("side-by-side-leak.exr")
        options = ("--ambient=0",) if (technique, preset) in WITH_AMBIENT else ()
        frames = FRAMES if preset == "best" else PAPER_FRAMES
        section.run("render", cli.scene_file("two-rooms"), *method(technique, preset), *options, "--camera", camera, "--size",
                    STEADY_SIZE, "--frames", frames, "--samples", 4, "-o", picture)
        means[camera] = mean_of(section, picture)
    return means["sealed"] / means["lit"]


FIGURES = {"side-by-side": side_by_side, "side-by-side-steady": steadiness}
