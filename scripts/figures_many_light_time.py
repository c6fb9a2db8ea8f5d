"""Figures about many_light's time at equal error, and about how steady its light is."""

import os

import cli
import pixels
from figures import MOST_SAMPLES, Missing, bench, fastest, milliseconds, number, output, part, quiet_truth, shared
from figures_many_light import preset
from moving_scene import MovingScene

SIZE = "128x128"
FRAMES = 16        # of history
MOMENT = (FRAMES - 1) / 24  # s: the last of these frames
SINGLE_FRAMES = 8  # whose errors are averaged where there is no history
INDIRECT = ("many light: ", "light clusters: ", "indirect light ")
WORLD = ("svo: ", "rsm: ", "light paths: ")
QUIET = 0.0002     # relMSE of a truth's own noise, 4 x 4 averages: it is subtracted, too


# ---- scenes whose camera and light move ----

def moving_cornell():
    """cornell-spot; the light crosses a fifth of the box in the 16 frames, the camera a tenth."""
    scene = MovingScene(cli.scene_file("cornell-spot"))
    scene.move(scene.node("spot"), (0, MOMENT), [(0.22, 0.538, 0.25), (0.33, 0.538, 0.2796)])
    scene.move(scene.node("main"), (0, MOMENT), [(0.25, 0.273, -0.8), (0.30, 0.273, -0.8)])
    return scene.save(output("moving-cornell-spot.gltf")), ["--camera=main"]


def moving_sponza():
    """Crytek Sponza under one spot light, as in the thesis; light and camera move by more than half a metre."""
    scene = MovingScene(shared("scenes", "sponza-crytek", "sponza-crytek.gltf"))
    light = scene.add_spot((-600, 700, 0), (0.7, -1, -0.3), 1500, 25, 40)
    scene.move(light, (0, MOMENT), [(-600, 700, 0), (-530, 700, 20)])
    camera = scene.node("camera")
    scene.place(camera, (-1000, 200, -20), (1, 0, 0))
    scene.move(camera, (0, MOMENT), [(-1060, 200, -20), (-1000, 200, -20)])
    return scene.save(output("moving-sponza.gltf")), ["--scale=0.01"]


MOVING = {"cornell-spot": moving_cornell, "sponza-crytek": moving_sponza}


class Moving:
    """A moving scene, and what is true at its last frame."""

    def __init__(self, section, name):
        self.section, self.name = section, name
        self.path, self.options = MOVING[name]()
        self.true = quiet_truth(section, self.path, SIZE, 1, [*self.options, "--time=%.6f" % MOMENT], QUIET, MOST_SAMPLES)
        self.mask = output("many-light-mask-%s.png" % name)
        pixels.save_mask(self.mask, self.away_from_edges())
        halves = [part(self.true.path, "half%d" % half) for half in (0, 1)]
        self.noise = section.compare(*halves, "--mask", self.mask)["relMSE"] / 4

    def away_from_edges(self):
        """Pixels whose neighbours have about the same distance, normal and albedo: a frame has one sample a pixel, the truth's
        pixels are averages."""
        picture = output("many-light-edges.exr")
        self.section.run("render", self.path, *self.options, "--time=%.6f" % MOMENT, "--technique", "none", "--size", SIZE,
                         "--frames", 1, "--samples", 1, "--aov", "normal,depth,albedo", "-o", picture)
        quiet = None
        for aov, alike in (("depth", lambda low, high: low > 0 and high <= 1.2 * low),
                           ("normal", lambda low, high: high - low <= 0.3), ("albedo", lambda low, high: high <= 1.5 * low)):
            image = pixels.load_exr(part(picture, aov))
            for c in range(1 if aov == "depth" else 3):
                low, high = pixels.spread([[p[c] for p in row] for row in image], 1)
                found = [[alike(*pair) for pair in zip(*rows)] for rows in zip(low, high)]
                quiet = found if quiet is None else [[x and y for x, y in zip(*rows)] for rows in zip(quiet, found)]
        return quiet

    def error(self, technique, first, frames):
        """relMSE of indirect light, the truth's noise subtracted: (pixel by pixel, 4 x 4). Mean over the frames from the last
        moment on: there all is at rest, so that frames differ by their virtual lights alone. `first`: s, of the frames before."""
        folder = output("many-light-time-" + self.name)
        os.makedirs(folder, exist_ok=True)
        before = round(24 * (MOMENT - first))
        self.section.run("render", self.path, *self.options, *technique, "--time=%.6f" % first, "--size", SIZE, "--frames",
                         before + frames, "--samples", 1, "--aov", "indirect", "-o", os.path.join(folder, "%03d.exr"))
        errors = [self.error_of(os.path.join(folder, "%03d.indirect.exr" % (before + frame))) for frame in range(frames)]
        return [sum(kind) / frames for kind in zip(*errors)]

    def error_of(self, picture):
        pair = picture, part(self.true.path, "indirect")
        return (self.section.compare(*pair, "--mask", self.mask)["relMSE"] - self.noise,
                self.section.compare(*pair, "--block", 4)["relMSE"] - self.true.noise)

    def times(self, technique, frames=4):
        """Least milliseconds of a moving frame: (indirect light, what all views share)."""
        result = bench(self.section, self.path, *self.options, *technique, "--animate", "--size", SIZE, "--frames", frames,
                       "--warm-up", 2)
        return fastest(result, INDIRECT), fastest(result, WORLD)


# ---- time at equal error ----

def time(section):
    """Indirect time of `best` at the error that `paper` reaches with 2048 VPLs, and what VPLs and cells cost."""
    section.text("%s, one bounce, 128³, the last of %d frames in which camera and light move. *relMSE*: of indirect light, "
                 "pixel by pixel, away from edges, the truth's noise subtracted; of a single frame: the mean of %d, each with "
                 "its own virtual lights. *Indirect*: device time of the passes `many light`, `light clusters` and "
                 "`indirect light` in the fastest of 4 moving frames; *world*: of octree, RSMs and light paths. Demands: at "
                 "an error of `paper` with 2048 VPLs or less, `best` takes at most 1/5 of its time from a single frame "
                 "without history, and at most 1/10 after %d moving frames; from 512 to 2048 VPLs its time grows at most by "
                 "1.3, and its relMSE falls." % (SIZE, FRAMES, SINGLE_FRAMES, FRAMES))
    for name in MOVING:
        try:
            moving = Moving(section, name)
        except Missing as reason:
            section.skip(name, str(reason))
            continue
        time_of_scene(section, moving)


def time_of_scene(section, moving):
    rows, results = [], {}

    def measure(label, technique, first=MOMENT, frames=1):
        error, blocks = moving.error(technique, first, frames)
        indirect, world = moving.times(technique)
        results[label] = error, indirect
        base = results["`paper`, 2048 VPLs"]
        rows.append([label, number(error), number(blocks), milliseconds(indirect), "%.3f" % (indirect / base[1]),
                     "%.2f" % (error / base[0]), milliseconds(world)])

    paper = {"bounces": 1, "resolution": 128}
    measure("`paper`, 2048 VPLs", preset("paper", vpls=2048, **paper))
    measure("`paper`, 512 VPLs", preset("paper", vpls=512, **paper))
    measure("`paper`, 512 VPLs, 256³", preset("paper", vpls=512, bounces=1, resolution=256))
    for by in ("voxels", "triangles", "none"):
        measure("`paper`, 512 VPLs, %s" % by, preset("paper", vpls=512, visibility=by, **paper))
    single = []
    for vpls in (512, 2048):
        for rays in (1, 2, 4):
            single.append("`best`, %d VPLs, %d ray%s, single frame" % (vpls, rays, "s" * (rays > 1)))
            measure(single[-1], preset("best", vpls=vpls, rays=rays, history=0, bounces=1), frames=SINGLE_FRAMES)
    moved = []
    for vpls in (2048, 8192):
        moved.append("`best`, %d VPLs, after %d frames" % (vpls, FRAMES))
        measure(moved[-1], preset("best", vpls=vpls, bounces=1), first=0.0)
    section.text("**%s**" % moving.name)
    section.table(["setting", "relMSE", "relMSE, 4 x 4", "indirect, ms", "time, to paper 2048", "error, to paper 2048",
                   "world, ms"], rows)
    verdicts(section, moving.name, results, single, moved)


def verdicts(section, name, results, single, moved):
    def least_share(labels, most, what):
        """Of `paper`'s time, at no more than its error."""
        good = [results[label][1] / indirect for label in labels if results[label][0] <= error]
        share = min(good, default=None)
        return section.demand(share is not None and share <= most, "none" if share is None else "%.3f" % share,
                              "%s, %s, at most %g" % (name, what, most))

    error, indirect = results["`paper`, 2048 VPLs"]
    few, many = (results["`best`, %d VPLs, 1 ray, single frame" % vpls] for vpls in (512, 2048))
    grows, falls = many[1] / few[1], many[0] / few[0]
    section.text("Least part of the time of `paper` with 2048 VPLs at no more than its error: a single frame %s, after %d moving frames %s. 512 to 2048 VPLs: time %s, error %s." % (
                     least_share(single, 0.2, "single frame"), FRAMES, least_share(moved, 0.1, "after moving frames"),
                     section.demand(grows <= 1.3, "x %.2f" % grows, name + ", 512 to 2048 VPLs, time"),
                     section.demand(falls < 1, "x %.2f" % falls, name + ", 512 to 2048 VPLs, error")))


# ---- stability ----

STABILITY_FRAMES = 60
TRUE_SAMPLES = 64
GONE = 0.01      # of the light that was there: no more to be seen
GONE_WITHIN = 8  # frames
OFF_FRAME = 24


def stability(section):
    """Frame-to-frame change of static pixels beside the truth's own, and how long light stays that was switched off."""
    section.text("`cornell-dynamic`, %s, %d frames of moving lights and a moving object at 24 a second; pixels whose surface "
                 "stays the same in all frames. *Change*: root mean square of indirect light's change from frame to frame, "
                 "over the truth's mean. *Flicker*: the same of what is not the truth's change. Both are taken from products "
                 "with two independent truths, so that their noise drops out. Demands on `best`: change at most twice the "
                 "truth's, flicker at most half of `paper`'s." % (SIZE, STABILITY_FRAMES))
    rows = []
    for bounces, settings in ((1, ("paper", "best", "best without history")), (8, ("best", "best without history"))):
        rows += stability_rows(section, bounces, settings)
    section.table(["bounces", "", "change", "to the truth's", "flicker", "to `paper`'s"], rows)
    switched_off(section)


def stability_rows(section, bounces, settings):
    scene = cli.scene_file("cornell-dynamic")
    true = [gray(sequence(section, scene, "true%d" % seed, STABILITY_FRAMES, "--technique", "path-tracer", "--samples",
                          TRUE_SAMPLES, "--max-bounces", bounces, "--seed", seed)) for seed in (1, 2)]
    static, rows, of_paper = None, [], None
    for name in settings:
        options = {"history": 0} if "without" in name else {}
        files = sequence(section, scene, name.replace(" ", "-"), STABILITY_FRAMES,
                         *preset(name.split()[0], bounces=bounces, **options), "--samples", 1)
        if static is None:
            static = static_pixels(files)
            scale = mean_over(true[0], static)
            truth = root(mean_product(changes(true[0]), changes(true[1]), static)) / scale
            rows.append([str(bounces), "truth", "%.4f" % truth, "", "", ""])
        own = changes(gray(files))
        change = root(mean_product(own, own, static)) / scale
        flicker = root(mean_product(*(difference(own, changes(t)) for t in true), static)) / scale
        of_paper = flicker if name == "paper" else of_paper
        judged, what = name == "best", "best with %d bounces, " % bounces
        rows.append([str(bounces), "`%s`" % name, "%.4f" % change,
                     section.demand(not judged or change <= 2 * truth, "%.2f" % (change / truth),
                                    what + "change, at most twice the truth's"), "%.4f" % flicker,
                     "" if of_paper is None else
                     section.demand(not judged or flicker <= 0.5 * of_paper, "%.2f" % (flicker / of_paper),
                                    what + "flicker, at most half of paper's")])
    return rows


def sequence(section, scene, name, frames, *options):
    """Files x.exr of the frames; indirect light and depth lie beside them."""
    folder = output("many-light-stability", name)
    os.makedirs(folder, exist_ok=True)
    section.run("render", scene, *options, "--size", SIZE, "--frames", frames, "--aov", "indirect,depth", "-o",
                os.path.join(folder, "%03d.exr"), timeout=3600)
    return [os.path.join(folder, "%03d.exr" % frame) for frame in range(frames)]


def gray(files):
    """Sum of the three channels of indirect light, pixel by pixel in one list, for each frame."""
    return [[sum(pixel) for row in pixels.load_exr(part(path, "indirect")) for pixel in row] for path in files]


def static_pixels(files):
    """Rows of booleans: the pixel and its neighbours show the same surface in all frames, by its distance."""
    frames = [[[d[0] for d in row] for row in pixels.load_exr(part(path, "depth"))] for path in files]
    same = [[float(0 < max(values) <= 1.00001 * min(values)) for values in zip(*rows)] for rows in zip(*frames)]
    return [[value > 0 for value in row] for row in pixels.spread(same, 1)[0]]


def changes(frames):
    return [[b - a for a, b in zip(*pair)] for pair in zip(frames, frames[1:])]


def difference(a, b):
    return [[x - y for x, y in zip(*pair)] for pair in zip(a, b)]


def mean_product(a, b, static):
    """Over frames and static pixels."""
    use = [i for i, value in enumerate(value for row in static for value in row) if value]
    return sum(x[i] * y[i] for x, y in zip(a, b) for i in use) / (len(use) * len(a))


def root(value):
    return max(value, 0.0) ** 0.5


def mean_over(frames, static):
    use = [i for i, value in enumerate(value for row in static for value in row) if value]
    return sum(frame[i] for frame in frames for i in use) / (len(frames) * len(use))


def switched_off(section):
    scene = MovingScene(cli.scene_file("cornell-spot"))
    inside, outside = (0.278, 0.538, 0.2796), (0.278, -5, 0.2796)  # below the floor it shines away from the box
    scene.move(scene.node("spot"), (0, (OFF_FRAME - 0.5) / 24), [inside, outside], "STEP")
    path = scene.save(output("switched-off.gltf"))
    rows = []
    for name in ("paper", "best"):
        means = [sum(frame) for frame in gray(sequence(section, path, "off-" + name, OFF_FRAME + 24, *preset(name),
                                                       "--samples", 1))]
        left = [value / means[OFF_FRAME - 1] for value in means[OFF_FRAME:]]
        gone = next((frame for frame, value in enumerate(left) if value <= GONE), len(left))
        rows.append(["`%s`" % name, *("%.4f" % left[frame] for frame in (0, 1, 2, 4, 8, 16)),
                     section.demand(name != "best" or gone <= GONE_WITHIN, str(gone), "light that was switched off is gone")])
    section.text("`cornell-spot`, the only light leaves between two frames: the share of indirect light that is left "
                 "in the first frame without it and in later ones, and the first frame with at most %g (demand on "
                 "`best`: at most %d)." % (GONE, GONE_WITHIN))
    section.table(["preset", "frame 0", "1", "2", "4", "8", "16", "gone at"], rows)


FIGURES = {"many-light-time": time, "many-light-stability": stability}
