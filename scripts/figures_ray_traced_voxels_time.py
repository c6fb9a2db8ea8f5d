"""Figures about ray_traced_voxels' time: both ways to bring light into the cache, and beside the other techniques."""

from figures import bench, each_lit_scene, fastest, method, milliseconds, number, output, part
from figures_ray_traced_voxels import SAMPLES, SIZE, preset, true_light

SCENES = {"cornell-spot": "own", "sibenik": "own"}


def errors(section, scene, camera, true, name, technique, frames):
    """(energy, relMSE of 4 x 4 averages without the truth's noise) of indirect light; the last SAMPLES frames averaged."""
    picture = output(name + ".exr")
    section.run("render", scene.path, *scene.view(camera), *technique, "--size", SIZE, "--frames", frames, "--samples",
                min(frames, SAMPLES), "--aov", "indirect", "-o", picture)
    error = section.compare(part(picture, "indirect"), part(true.path, "indirect"), "--block", 4)
    return error["energy"], error["relMSE"] - true.noise


def moving_light(section, scene, camera, technique):
    """Device times of frames in which lights move."""
    return bench(section, scene.path, *scene.view(camera), *technique, "--move-lights", "--size", SIZE, "--frames", 6,
                 "--warm-up", 4)


# ---- injection ----

CACHE = ("voxel faces: ", "light paths: ", "light cache: ", "ray-traced voxels: ")
PIXELS = ("ray-traced voxels: pixels", "light cache: smooth", "light cache: look-up")
INJECT_FRAMES = (16, 64)


def inject(section):
    """Light brought into the cache by the camera's rays or by the lights': error and time."""
    rows = []
    for scene in each_lit_scene(section, SCENES):
        camera = SCENES[scene.name]
        true = true_light(section, scene, camera)
        for way in ("camera", "light"):
            for rays in (1, 0):
                technique = preset("best", inject=way, rays=rays)
                row = [scene.name, way, str(rays)]
                for frames in INJECT_FRAMES:
                    energy, error = errors(section, scene, camera, true, "ray-traced-voxels-inject", technique, frames)
                    row += ["%.4f" % energy, number(error)]
                times = moving_light(section, scene, camera, technique)
                pixels = fastest(times, PIXELS)
                rows.append([*row, *map(milliseconds, (fastest(times, CACHE) - pixels, pixels, fastest(times)))])
    section.text("%s. Energy and relMSE of indirect light, 4 x 4 averages, the truth's noise subtracted, after 16 and 64 "
                 "frames. Device time, ms, fastest of 6 frames in which the lights move: *cache*: what all views share; "
                 "*pixels*: rays of a view, with 0 rays the look-up; *frame*: everything." % SIZE)
    section.table(["scene", "inject", "rays", *(text % frames for frames in INJECT_FRAMES for text in
                                                 ("energy, %d frames", "relMSE, %d frames")), "cache", "pixels", "frame"], rows)


# ---- beside the other techniques ----

METHODS = (("light-volume", {}), ("many-light", {}), ("ray-traced-voxels", {}), ("ray-traced-voxels", {"rays": 0}))
EQUAL_FRAMES = (1, 4, 16, 64)
OTHERS = ("g-buffer", "shadow", "direct light", "combine", "tone map", "sampled light")


def time(section):
    """Time by stage and error at equal frames beside light-volume and many-light."""
    section.text("%s, `best` of each. Device time, ms, median of 6 frames in which the lights move (geometry and camera do "
                 "not), by pass; what every technique's frame needs is left out. relMSE of indirect light, 4 x 4 averages, "
                 "the truth's noise subtracted, of static frames, the last %d or all of them averaged." % (SIZE, SAMPLES))
    for scene in each_lit_scene(section, SCENES):
        camera = SCENES[scene.name]
        true = true_light(section, scene, camera)
        stages, rows = [], []
        for technique, options in METHODS:
            words = method(technique, "best", **options)
            label = " ".join(["`%s" % technique, *("--%s %s" % option for option in options.items())]) + "`"
            times = stage_times(moving_light(section, scene, camera, words))
            stages += [[label, stage, milliseconds(value)] for stage, value in times.items() if value >= 0.1]
            stages.append([label, "all", milliseconds(sum(times.values()))])
            rows.append([label, *(number(errors(section, scene, camera, true, "ray-traced-voxels-time", words, frames)[1])
                                  for frames in EQUAL_FRAMES), milliseconds(sum(times.values()))])
        section.text("**%s**" % scene.name)
        section.table(["technique", *("relMSE, frame %d" % frames for frames in EQUAL_FRAMES), "ms"], rows)
        section.table(["technique", "stage", "ms"], stages)


def stage_times(result):
    """Milliseconds of the passes that belong to the technique."""
    return {p["name"]: p["ms"]["median"] for p in result["passes"] if not p["name"].startswith(OTHERS)}


FIGURES = {"ray-traced-voxels-inject": inject, "ray-traced-voxels-time": time}
