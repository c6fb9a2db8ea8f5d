"""Figures about many_light's light: the published table, quality, bounces, epsilon. Times and steadiness:
figures_many_light_time.py."""

import json

import cli
from figures import (MOST_SAMPLES, QUIET, LitScene, Missing, each_lit_scene, mean_of, method, milliseconds, number, output,
                     part, quiet_truth, shared, within)
from moving_scene import MovingScene

SIZE = "256x256"
NOISE = 0.002         # relMSE of a truth's own noise that is allowed, 4 x 4 averages


def preset(name, **options):
    return method("many-light", name, **options)


# ---- the published table ----

TABLE_SCENES = ("cornell-dynamic", "sponza-crytek")
TABLE_VPLS = (512, 1024, 2048)
PRESETS = ("paper", "best")


def table(section, *more):
    """The thesis' Table 5.1, both presets, at full size; `more` goes to `lightwell bench many-light`."""
    cells = {}
    for scene in TABLE_SCENES:
        options = []
        if scene == "sponza-crytek":
            try:
                options = ["--sponza", shared("scenes", "sponza-crytek", "sponza-crytek.gltf")]
            except Missing as reason:
                section.skip(scene, str(reason))
                continue
        for name in PRESETS:
            for vpls in TABLE_VPLS:
                result = section.run_json("bench", "many-light", "--scenes", scene, *options, "--preset", name, "--vpls",
                                          vpls, *more, "--json", timeout=3600)
                cells[scene, name, vpls] = result["tables"][0]
    with open(output("many-light-table.json"), "w", encoding="utf-8") as f:
        json.dump([{"scene": s, "preset": p, "vpls": v, **c} for (s, p, v), c in cells.items()], f, indent=1)
    section.text("Device time of one frame that starts from nothing, ms, and its share of the five rows' sum; "
                 "published: on a Titan X. *Indirect, to 512*: over the same with 512 VPLs. Everything is made anew in "
                 "every frame, as if all geometry moved. `all other` (G-buffer, shadow maps, tone mapping, what answers "
                 "rays) is not in the thesis' table. As JSON: build/results/many-light-table.json.")
    for scene in TABLE_SCENES:
        if (scene, PRESETS[0], TABLE_VPLS[0]) in cells:
            table_of_scene(section, scene, cells)


def table_of_scene(section, scene, cells):
    first = cells[scene, PRESETS[0], TABLE_VPLS[0]]
    section.text("**%s**, %s, %s³ cells" % (scene, first["size"].replace("x", " x "), first["resolution"]))
    columns = [(p, v) for p in (*PRESETS, "published") for v in TABLE_VPLS]

    def column(p, v):
        found = cells[scene, "paper" if p == "published" else p, v]["columns"][0]
        return found["published"] if p == "published" else found
    rows = []
    for i, stage in enumerate(s["name"] for s in first["columns"][0]["stages"]):
        rows.append([stage])
        for p, v in columns:
            stages = column(p, v)["stages"]
            rows[-1].append(cell_of(stages[i]) if i < len(stages) else "")
    indirect = [s["name"] for s in first["columns"][0]["stages"]].index("indirect light")
    rows.append(["indirect, to 512"])
    for p, v in columns:
        base = column(p, TABLE_VPLS[0])["stages"][indirect]["ms"]
        rows[-1].append("%.2f" % (column(p, v)["stages"][indirect]["ms"] / base))
    section.table(["ms", *("%s, %d" % c for c in columns)], rows)


def cell_of(stage):
    time = "%.2f" % stage["ms"] if stage["ms"] < 10 else milliseconds(stage["ms"])
    return time + (" (%.1f %%)" % (100 * stage["share"]) if "share" in stage else "")


# ---- quality ----

# (energy at least, at most, SSIM at least) of `best`. The truth's noise should be a hundredth of what SSIM may lack.
CLOSE, FAR = (0.97, 1.03, 0.97), (0.95, 1.05, 0.93)
QUALITY_DEMANDS = {"cornell-spot": CLOSE, "room": CLOSE, "cornell-dynamic": CLOSE, "sponza-crytek": FAR, "sibenik": FAR}
FRAMES = 16  # of history and film


def quality(section):
    """Indirect light of both presets against the truth: scenes of tests/lights with demands, all their cameras."""
    rows = []
    for scene in each_lit_scene(section, QUALITY_DEMANDS):
        for camera in scene.cameras:
            if camera != "sealed":
                rows += quality_rows(section, scene, camera)
    section.text("%s, 4 x 4 averages, all bounces. `best`: %d frames, all averaged; `paper` as it is by default, which "
                 "cannot show more bounces than it makes. Energy and relMSE of indirect light; SSIM of the whole "
                 "picture, and of indirect light alone. *Noise*: relMSE that the truth's own noise makes, from the "
                 "difference of its halves (demand: at most %g). Demands on `best`: %s." % (
                     SIZE, FRAMES, NOISE, "; ".join("%s energy %g to %g, SSIM %g" % (name, *demands)
                                                    for name, demands in QUALITY_DEMANDS.items())))
    section.table(["scene", "camera", "preset", "energy", "relMSE", "SSIM", "SSIM, indirect", "noise", "paths", "seconds"],
                  rows)


def quality_rows(section, scene, camera):
    view = scene.view(camera)
    low, high, ssim = QUALITY_DEMANDS.get(scene.name, (0, 0, 1 - 100 * QUIET))
    moves = any(option.startswith("--time") for option in view)  # there --frames counts moments
    rows = []
    for name in ("best", "paper"):
        samples = FRAMES if name == "best" else 1
        true = quiet_truth(section, scene.path, SIZE, cli.most_bounces("many-light", name), view, (1 - ssim) / 100, MOST_SAMPLES)
        picture = output("many-light-quality-%s-%s-%s.exr" % (scene.name, camera, name))
        stats = section.run_json("render", scene.path, *view, *preset(name), "--size", SIZE, "--frames",
                                 1 if moves else samples, "--samples", samples, "--aov", "direct,indirect", "--stats", "json",
                                 "-o", picture)
        light, whole = (section.compare(part(picture, aov), part(true.path, aov), "--block", 4, "--exposure",
                                        scene.exposure) for aov in ("indirect", "combined"))
        judged = name == "best" and scene.name in QUALITY_DEMANDS
        what = "%s, %s, " % (scene.name, camera)
        rows.append([scene.name, camera, "`%s`" % name, within(section, light["energy"], low, high, what + "energy", judged),
                     number(light["relMSE"]),
                     section.demand(not judged or whole["ssim"] >= ssim, "%.4f" % whole["ssim"], what + "SSIM"),
                     "%.4f" % light["ssim"],
                     section.demand(true.noise <= NOISE, number(true.noise, 2), what + "noise"), str(true.samples),
                     "%.1f" % (stats["wall_time_ms"] / 1000)])
    return rows


# ---- bounces ----

BOUNCE_SCENES = ("cornell-spot", "room", "sponza-crytek", "sibenik")
BOUNCE_SIZE = "128x128"
BOUNCE_FRAMES = 64
JUDGED_PART = 0.1  # of the first bounce: less than that does not stand out of the noise of two means


def bounces(section):
    """What the second and third bounce add, against what they add to the truth."""
    rows = []
    for scene in each_lit_scene(section, BOUNCE_SCENES):
        view = scene.view("own")
        true = [mean_of(section, part(quiet_truth(section, scene.path, BOUNCE_SIZE, b, view, QUIET, MOST_SAMPLES).path,
                                      "indirect")) for b in (1, 2, 3)]
        for name in ("best", "paper"):
            frames = BOUNCE_FRAMES if name == "best" else 1
            found = []
            for b in (1, 2, 3):
                picture = output("many-light-bounces-%s-%s-%d.exr" % (scene.name, name, b))
                section.run("render", scene.path, *view, *preset(name, bounces=b, vpls=2048), "--size", BOUNCE_SIZE,
                            "--frames", frames, "--samples", frames, "--aov", "indirect", "-o", picture)
                found.append(mean_of(section, part(picture, "indirect")))
            row = [scene.name, "`%s`" % name, "%.4f" % (found[0] / true[0])]
            for b in (1, 2):
                added, share = (found[b] - found[b - 1]) / (true[b] - true[b - 1]), (true[b] - true[b - 1]) / true[0]
                row += [number(share), within(section, added, 0.9, 1.1, "%s, bounce %d adds" % (scene.name, b + 1),
                                              name == "best" and share >= JUDGED_PART)]
            rows.append(row)
    section.text("%s, own cameras, 2048 VPLs, `best` over %d frames; mean indirect light over the truth's with one bounce, "
                 "and what the second and the third bounce add over what they add to the truth (demand on `best`: 0.9 to "
                 "1.1 where that is at least a tenth of the first). *Part*: what they add to the truth, over its first "
                 "bounce." % (BOUNCE_SIZE, BOUNCE_FRAMES))
    section.table(["scene", "preset", "bounce 1", "part of 2", "bounce 2", "part of 3", "bounce 3"], rows)


# ---- epsilon, loss and leak ----

EPSILONS = (0.5, 1, 1.8, 2.5, 3, 4, 5)
RESOLUTION = 128
WALL = 0.25  # m, of two-rooms: two cells
OFFSETS = 8


def epsilon(section):
    """What visibility by voxels loses and leaks, over epsilon, and the other ways to answer shadow rays."""
    scene = LitScene("cornell-spot")
    true = quiet_truth(section, scene.path, "128x128", 1, scene.view("own"), 0.0005, MOST_SAMPLES)
    reference = mean_of(section, part(true.path, "indirect"))
    plane = thin_wall()
    settings = [("paper", {"visibility": "svo-restart", "epsilon": e}) for e in EPSILONS]
    settings += [(name, {"visibility": v}) for v in ("voxels", "triangles", "none") for name in ("best", "paper")]
    rows = []
    for name, options in settings:
        options = {**options, "bounces": 1}
        picture = output("many-light-epsilon.exr")
        section.run("render", scene.path, *preset(name, resolution=RESOLUTION, **options), "--size", "128x128",
                    "--frames", 8, "--samples", 8, "--aov", "indirect", "-o", picture)
        visible = mean_of(section, part(picture, "indirect")) / reference
        thick, thin = (leak(section, preset(name, **options), path) for path in (cli.scene_file("two-rooms"), plane))
        by, judged = options["visibility"], name == "best"
        what = "leak of two-rooms, %s, " % by
        rows.append(["`%s`" % name, by, number(options.get("epsilon", 0)) if "epsilon" in options else "", "%.3f" % visible,
                     section.demand(not judged or by == "none" or thick <= (0 if by == "triangles" else 0.01),
                                    "%.3f %%" % (100 * thick), what + "wall of two cells"),
                     section.demand(not judged or by != "triangles" or thin == 0, "%.3f %%" % (100 * thin),
                                    what + "plane without thickness")])
    section.text("*Energy*: mean indirect light of `cornell-spot`, one bounce, 128 x 128, over the truth's: what is "
                 "missing was lost at the ends of shadow rays. *Leak*: mean radiance of the view of the sealed room of "
                 "`two-rooms` over that of the lit one, mean of %d offsets of the grid along the wall's normal; a wall "
                 "of two cells (demand on `best`: at most 1 %% by voxels, 0 by triangles) and the same scene with a "
                 "plane without thickness for a wall (0 by triangles). Epsilon in voxels; %d³." % (OFFSETS, RESOLUTION))
    section.table(["preset", "visibility", "epsilon", "energy", "leak, two cells", "leak, plane"], rows)


def thin_wall():
    scene = MovingScene(cli.scene_file("two-rooms"))
    scene.replace_by_rectangle(scene.node("wall between"),
                               [(0, 0.125, -2.125), (0, 0.125, 2.125), (0, 3.375, 2.125), (0, 3.375, -2.125)])
    return scene.save(output("two-rooms-plane.gltf"))


def leak(section, technique, scene):
    cell = WALL / 2
    half = cell * (RESOLUTION - 1 / 128) / 2  # the fit leaves 1/256 of a cell free on both sides
    sums = {"sealed": 0.0, "lit": 0.0}
    for step in range(OFFSETS):
        shift = cell * (step - OFFSETS / 2) / OFFSETS
        bounds = ",".join("%.6f" % v for v in (shift - half, -half, -half, shift + half, half, half))
        for camera in sums:
            picture = output("many-light-leak.exr")
            section.run("render", scene, *technique, "--resolution", RESOLUTION, "--grid-bounds=" + bounds, "--camera",
                        camera, "--shadows", "rays", "--size", "48x48", "--frames", 4, "--samples", 4, "-o", picture)
            sums[camera] += mean_of(section, picture)
    return sums["sealed"] / sums["lit"]


FIGURES = {"many-light-table": table, "many-light-quality": quality, "many-light-bounces": bounces,
           "many-light-epsilon": epsilon}
