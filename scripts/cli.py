"""Calls build/lightwell and reads what it answers. Python 3 standard library only."""

import functools
import json
import os
import struct
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PROGRAM = os.path.join(ROOT, "build", "lightwell")


class Failed(Exception):
    """What went wrong, in one line."""


def lightwell(*arguments, environment=None, timeout=600):
    """Runs the program; returns what it printed."""
    command = [PROGRAM, *map(str, arguments)]
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False,
                              timeout=timeout, env={**os.environ, **(environment or {})})
    except FileNotFoundError:
        raise Failed(PROGRAM + " is not built: run scripts/demo or scripts/test") from None
    except subprocess.TimeoutExpired:
        raise Failed("lightwell %s took more than %d s" % (arguments[0], timeout)) from None
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines() or ["exit code %d" % done.returncode]
        raise Failed("lightwell %s: %s" % (arguments[0], lines[-1]))
    return done.stdout


def lightwell_json(*arguments, **more):
    text = lightwell(*arguments, **more)
    try:
        return json.loads(text)
    except ValueError:
        raise Failed("lightwell %s printed no JSON" % arguments[0]) from None


# Presets that show fewer bounces than all and have no option --bounces which says so.
FEWER_BOUNCES = {("light-volume", "paper-lpv"): 1}


@functools.lru_cache(maxsize=None)
def most_bounces(technique, preset):
    """Bounces that a preset shows at most by its defaults: what the path tracer is compared with needs as many. None: all."""
    for found in lightwell_json("info", "--techniques", "--json"):
        for shown in found["presets"] if found["name"] == technique else ():
            if shown["name"] == preset:
                limits = [option["default"] for option in shown["options"] if option["name"] == "bounces"]
                return limits[0] if limits else FEWER_BOUNCES.get((technique, preset))
    raise Failed("%s has no preset %s" % (technique, preset))


def bounce_options(bounces):
    """Of the path tracer, whose paths have no limit but chance where it has no option."""
    return [] if bounces is None else ["--max-bounces", str(bounces)]


class Method:
    """A technique with one of its presets."""

    def __init__(self, technique, preset, default):
        self.arguments = ["--technique", technique, "--preset", preset]
        self.name = technique if default else "%s %s" % (technique, preset)
        self.bounces = most_bounces(technique, preset)


def methods():
    """GI techniques of this build with their presets, each technique's default last; the path tracer and the frame
    without a technique are none."""
    found = []
    for technique in lightwell_json("info", "--techniques", "--json"):
        presets = [p["name"] for p in technique["presets"] if p["name"]]
        found += [Method(technique["name"], p, p == presets[0]) for p in reversed(presets)]
    return found


def scene_file(name):
    """Path of a built-in scene, or of a file."""
    for path in (name, *(os.path.join(ROOT, "scenes", name + e) for e in (".gltf", ".glb"))):
        if os.path.isfile(path):
            return path
    raise Failed("%s: no such scene" % name)


def scene_exposure(path):
    """The exposure that a built-in scene asks for (extras of its first glTF scene), else 1."""
    try:
        with open(path, "rb") as f:
            data = f.read()
        if data[:4] == b"glTF":
            data = data[20:20 + struct.unpack_from("<I", data, 12)[0]]
        return float(json.loads(data)["scenes"][0]["extras"]["exposure"])
    except (KeyError, IndexError, TypeError, ValueError, struct.error):
        return 1.0


def main(run):
    """Runs a script's body with one-line errors."""
    try:
        sys.exit(run())
    except Failed as reason:
        sys.exit("%s: %s" % (os.path.basename(sys.argv[0]), reason))
    except KeyboardInterrupt:
        sys.exit(130)
