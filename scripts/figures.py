"""What all figures of scripts/results share: running commands and keeping them, true pictures, tables."""

import hashlib
import json
import math
import os
import shlex
import time

import cli
import pixels

OUT = os.path.join(cli.ROOT, "build", "results")
LIGHTS = os.path.join(cli.ROOT, "tests", "lights")
SHARED = os.path.join(cli.ROOT, os.environ.get("LIGHTWELL_SHARED_DIR", os.path.join("..", "shared")))


class Missing(Exception):
    """Something that this figure needs is not here."""


class Section:
    """One generated part of docs/results.md."""

    def __init__(self, name):
        self.name = name
        self.commands = []  # as they were run
        self.missed = []    # demands that were not met
        self.skipped = []
        self.lines = []     # Markdown
        self.pictures = []  # (file, name in docs/images)

    def run(self, *arguments, timeout=900):
        arguments = [str(a) for a in arguments]
        shown = [os.path.relpath(a, cli.ROOT) if os.path.isabs(a) else a for a in arguments]
        self.commands.append(shlex.join(["build/lightwell", *shown]))
        return cli.lightwell(*arguments, timeout=timeout)

    def run_json(self, *arguments, **more):
        return json.loads(self.run(*arguments, **more))

    def compare(self, test, reference, *more):
        return self.run_json("compare", test, reference, *more, "--json")

    def demand(self, met, value, what):
        """`value` with MISSED beside it where the demand is not met."""
        if met:
            return value
        self.missed.append("%s: %s" % (what, value))
        return value + " **MISSED**"

    def skip(self, row, reason):
        self.skipped.append("%s: %s" % (row, reason))

    def text(self, *paragraphs):
        for paragraph in paragraphs:
            self.lines += [paragraph, ""]

    def picture(self, path, title):
        """Shows a PNG or SVG in the page; it is copied beside the page when that is written."""
        name = os.path.basename(path)
        self.pictures.append((path, name))
        self.text("![%s](images/%s)" % (title, name))

    def table(self, head, rows):
        self.lines += ["| " + " | ".join(row) + " |" for row in (head, ["---"] * len(head), *rows)] + [""]


def number(value, digits=3):
    return "%.*g" % (digits, value)


def milliseconds(value):
    return "%.0f" % value if value >= 100 else "%.1f" % value


def output(*names):
    """A file in build/results."""
    os.makedirs(OUT, exist_ok=True)
    return os.path.join(OUT, "-".join(names))


def part(path, aov):
    """x.exr -> x.indirect.exr; combined is x.exr itself."""
    return path if aov == "combined" else path[:-4] + "." + aov + ".exr"


def shared(*path):
    full = os.path.join(SHARED, *path)
    if not os.path.exists(full):
        raise Missing("no " + os.path.relpath(full, cli.ROOT))
    return full


def reference(name):
    """(scene file, folder, exposure) of a shared reference."""
    folder = shared("references", name)
    with open(os.path.join(folder, "scene.json"), encoding="utf-8") as f:
        return os.path.join(folder, name + ".glb"), folder, json.load(f)["exposure"]


class LitScene:
    """A test scene with light and cameras of tests/lights (README.md there)."""

    def __init__(self, name):
        with open(os.path.join(LIGHTS, name + ".json"), encoding="utf-8") as f:
            known = json.load(f)
        self.name = name
        self.path = shared("scenes", known["file"]) if "file" in known else cli.scene_file(known["scene"])
        self.exposure = known["exposure"]
        self.options = words(known["options"])
        self.cameras = {camera: words(options) for camera, options in known["cameras"].items()}

    def view(self, camera):
        """Options of the command line for this light and camera."""
        return self.options + self.cameras[camera]


def words(options):
    """{"light": ["a", "b"], "fov": "60"} as --light=a --light=b --fov=60: values may begin with a minus."""
    return ["--%s=%s" % (name, value) for name, values in options.items()
            for value in (values if isinstance(values, list) else [values])]


def lit_scene_names():
    return sorted(name[:-5] for name in os.listdir(LIGHTS) if name.endswith(".json"))


def each_lit_scene(section, names=None):
    """The LitScenes of these names, or all; those whose files are not here are skipped."""
    for name in names or lit_scene_names():
        try:
            yield LitScene(name)
        except Missing as reason:
            section.skip(name, str(reason))


def method(technique, preset, **options):
    """Words of the command line for a preset with options: svo_memory=64 is --svo-memory=64."""
    return ["--technique", technique, "--preset", preset,
            *("--%s=%s" % (key.replace("_", "-"), value) for key, value in options.items())]


AOVS = "direct,indirect,albedo,normal,depth"


def render(section, scene, name, *options):
    """Renders to build/results/NAME.exr and its parts; returns the path."""
    path = output(name + ".exr")
    section.run("render", scene, *options, "--aov", AOVS, "-o", path)
    return path


def fingerprint(scene, options):
    """What a coarse picture of the path tracer looks like: it changes with the tracer, the importers and the scene."""
    path = output("truth", "fingerprint-%d.exr" % os.getpid())
    cli.lightwell("render", scene, *options, "--size", "24x24", "--samples", 4, "-o", path)
    with open(path, "rb") as f:
        digest = hashlib.sha256(repr(options).encode() + f.read())
    os.remove(path)
    return digest


def truth(section, scene, size, samples, bounces, *options):
    """`bounces` None: all. (path of the path tracer's picture with its parts, seconds): kept until the path tracer, the scene or options change."""
    options = ["--technique", "path-tracer", *cli.bounce_options(bounces), *options]
    return kept_picture(section, fingerprint(scene, options), scene,
                        ["--size", size, "--samples", str(samples), *options], AOVS)


def kept_picture(section, digest, scene, options, aovs):
    digest.update(repr(options).encode())
    path = output("truth", digest.hexdigest()[:16] + ".exr")
    note = path[:-4] + ".json"
    if os.path.exists(note):
        section.commands.append("# kept from an earlier run: %s %s" % (os.path.relpath(scene, cli.ROOT),
                                                                     shlex.join(options)))
        with open(note, encoding="utf-8") as f:
            return path, json.load(f)["seconds"]
    started = time.monotonic()
    section.run("render", scene, *options, "--aov", aovs, "-o", path)
    seconds = time.monotonic() - started
    with open(note, "w", encoding="utf-8") as f:
        json.dump({"seconds": seconds}, f)
    return path, seconds


class Truth:
    """Mean of pictures of the path tracer that know nothing of each other."""

    def __init__(self, path, noise, samples):
        self.path = path        # x.exr; direct and indirect light beside it
        self.noise = noise      # relMSE of its indirect light that noise makes, 4 x 4 averages
        self.samples = samples  # paths a pixel, all together


SAMPLES_AT_ONCE = 64
MOST_SAMPLES = 1024  # paths a pixel of a quiet truth
QUIET = 0.0007       # noise that is aimed at where nothing else is said: SSIM falls with noise, too


def quiet_truth(section, scene, size, bounces, options, noise, most_samples):
    """The Truth of a view, with as many paths as make its noise fall to `noise`; no more than `most_samples` a pixel.

    Halves a, b of the pictures have means of variance s^2: relMSE(a, b) is 2 s^2 over what is seen squared, and the mean of all
    has a quarter of that.
    """
    options = ["--technique", "path-tracer", *cli.bounce_options(bounces), *options]
    digest = fingerprint(scene, options)
    count, found = 2, []
    while True:
        for seed in range(len(found) + 1, count + 1):
            found.append(kept_picture(section, digest.copy(), scene,
                                      ["--size", size, "--samples", str(SAMPLES_AT_ONCE), "--seed", str(seed), *options],
                                      "direct,indirect")[0])
        mean = found[0][:-4] + "-mean-%d.exr" % count
        if not os.path.exists(mean):
            for aov in ("direct", "indirect", "combined"):
                halves = [mean_picture([part(path, aov) for path in found[half::2]]) for half in (0, 1)]
                for half in (0, 1) if aov == "indirect" else ():
                    pixels.save_exr(part(mean, "half%d" % half), halves[half])
                pixels.save_exr(part(mean, aov), average(halves))
        left = section.compare(part(mean, "half0"), part(mean, "half1"), "--block", 4)["relMSE"] / 4
        if left <= noise or count * SAMPLES_AT_ONCE >= most_samples:
            return Truth(mean, left, count * SAMPLES_AT_ONCE)
        wanted = 2 * math.ceil(1.1 * count * left / noise / 2)
        count = min(max(count + 2, wanted), 4 * count, most_samples // SAMPLES_AT_ONCE)


def mean_picture(paths):
    return average([pixels.load_exr(path) for path in paths])


def average(pictures):
    return [[tuple(sum(values) / len(values) for values in zip(*pixel)) for pixel in zip(*rows)]
            for rows in zip(*pictures)]


def mean_of(section, picture):
    return section.compare(picture, picture)["mean_test"]


def within(section, value, low, high, what, demanded=True):
    return section.demand(not demanded or low <= value <= high, "%.4f" % value, "%s within %g to %g" % (what, low, high))


def montage(section, name, pictures, labels, exposure, columns=0):
    """Pictures side by side as build/results/NAME.png; `exposure`: one for all, or one each. Returns the path."""
    exposures = exposure if isinstance(exposure, (list, tuple)) else [exposure] * len(pictures)
    shown = []
    for i, (picture, factor) in enumerate(zip(pictures, exposures)):
        shown.append(output("shown", "%d.png" % i))
        section.run("montage", picture, "--exposure", factor, "-o", shown[-1])
    path = output(name + ".png")
    section.run("montage", *shown, "--labels", ",".join(labels), "--columns", columns, "-o", path)
    return path


def bench(section, scene, *options):
    return section.run_json("bench", scene, *options, "--json")


def fastest(result, prefixes=("",)):
    """Milliseconds that all passes whose names start so took in the frame where they took least."""
    times = [p["each_ms"] for p in result["passes"] if p["name"].startswith(tuple(prefixes))]
    return min(map(sum, zip(*times)))
