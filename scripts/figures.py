"""What all figures of scripts/results share: running commands and keeping them, true pictures, tables."""

import hashlib
import json
import os
import shlex
import time

import cli
from demo_run import sources_digest

OUT = os.path.join(cli.ROOT, "build", "results")
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
    """x.exr -> x.indirect.exr"""
    return path[:-4] + "." + aov + ".exr"


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


AOVS = "direct,indirect,albedo,normal,depth"


def render(section, scene, name, *options):
    """Renders to build/results/NAME.exr and its parts; returns the path."""
    path = output(name + ".exr")
    section.run("render", scene, *options, "--aov", AOVS, "-o", path)
    return path


def truth(section, scene, size, samples, bounces, *options):
    """(path of the path tracer's picture with its parts, seconds): kept until its sources, the scene or options change."""
    options = ["--technique", "path-tracer", "--size", size, "--samples", str(samples), "--max-bounces", str(bounces),
               *options]
    digest = hashlib.sha256(repr(options).encode())
    with open(scene, "rb") as f:
        digest.update(f.read())
    sources_digest(digest)
    path = output("truth", digest.hexdigest()[:16] + ".exr")
    note = path[:-4] + ".json"
    if os.path.exists(note):
        with open(note, encoding="utf-8") as f:
            seconds = json.load(f)["seconds"]
        section.commands.append("# kept from an earlier run: %s %s" % (os.path.relpath(scene, cli.ROOT),
                                                                     shlex.join(options)))
        return path, seconds
    started = time.monotonic()
    section.run("render", scene, *options, "--aov", AOVS, "-o", path)
    seconds = time.monotonic() - started
    with open(note, "w", encoding="utf-8") as f:
        json.dump({"seconds": seconds}, f)
    return path, seconds


def bench(section, scene, *options):
    return section.run_json("bench", scene, *options, "--json")


def fastest(result, prefixes=("",)):
    """Milliseconds that all passes whose names start so took in the frame where they took least."""
    times = [p["each_ms"] for p in result["passes"] if p["name"].startswith(tuple(prefixes))]
    return min(map(sum, zip(*times)))
