#!/usr/bin/env python3
"""How far light is right where a scene is larger, or has finer parts, than one grid of cells can hold.

usage: scripts/figures_extent.py [--technique NAME]... [--list] [CASE...]

Prints the table of `scripts/results --only extent` for the cases whose names begin so, and leaves docs/results.md alone.
"""

import argparse
import itertools
import json
import math
import os

import cli
import extent_scenes
import figures
import pixels
from cli import most_bounces
from figures import (LitScene, Missing, Section, mean_of, method, milliseconds, number, output, part, quiet_truth,
                     shared, truth)

TECHNIQUES = ("light-volume", "ray-traced-voxels", "many-light")
SMALL, LARGE = "64x64", "128x128"
FRAMES, AVERAGED = 48, 16
NOISE = 0.004       # relMSE of a truth's indirect light, 4 x 4 averages
MOST_SAMPLES = 512  # paths a pixel of a truth
SKY = "--env=%g,%g,%g" % extent_scenes.SKY
ARENA = ("--sun=0.4,-1,0.3 20", "--eye=0,2,0", "--target=20,0,5", "--fov=70")
# Energy of indirect light, leak, and SSIM that is demanded; all techniques have ENERGY_OF_OTHERS besides.
ENERGY_OF_OTHERS = {"ray-traced-voxels": (0.93, 1.07)}
LEAK_OF_ROOM, LEAK_OF_WALL, BAND = 0.001, 0.003, 0.01
SSIM = 0.93


class Case:
    """A view with what is demanded of it."""

    def __init__(self, name, make, size=SMALL, exposure=1.0, energy=None, ssim=None, leak=None, options=None):
        self.name, self.make, self.size, self.exposure = name, make, size, exposure
        self.energy = energy          # (low, high) of light-volume
        self.ssim = ssim              # of light-volume
        self.leak = leak              # at most; the case has a camera that sees no light, and one that does
        self.options = options or {}  # {technique: more words}

    def energy_of(self, technique):
        if self.energy is None or technique == "light-volume":
            return self.energy
        if technique == "many-light":
            return (0.95, 1.05) if self.name == "classroom" else None
        return ENERGY_OF_OTHERS.get(technique)


def generated(name, *options):
    """(path, options of the command line) of a scene of extent_scenes.py."""
    return lambda: (extent_scenes.write(output("extent-scenes"), name), list(options))


def lit(name):
    def make():
        scene = LitScene(name)
        return scene.path, scene.view("own")
    return make


def lit_case(name, **more):
    with open(os.path.join(figures.LIGHTS, name + ".json"), encoding="utf-8") as f:
        return Case(name, lit(name), LARGE, json.load(f)["exposure"], **more)


def all_cases():
    cases = []
    inside = "--camera=inside"
    for ground in extent_scenes.GROUNDS:
        cases += [Case("sealed %d m" % ground, generated("sealed-%d.gltf" % ground, SKY), leak=LEAK_OF_ROOM),
                  Case("door %d m" % ground, generated("door-%d.gltf" % ground, SKY, inside), exposure=2, energy=(0.9, 1.1)),
                  Case("lamp %d m" % ground, generated("lamp-%d.gltf" % ground, inside), energy=(0.95, 1.05))]
    cases.append(Case("narrow door", generated("narrow-door.gltf", SKY, inside), exposure=4, energy=(0.95, 1.05)))
    for size in extent_scenes.EMITTERS:
        for kind in ("emitter", "shaded"):
            cases.append(Case("%s %g cm" % (kind, size), generated("%s-%g.gltf" % (kind, size)), energy=(0.97, 1.03)))
    for degrees in (0, 30):
        cases.append(Case("thin wall %d" % degrees, generated("thin-wall-%d.gltf" % degrees), leak=LEAK_OF_WALL))
    for count in (1000, 10000):
        cases.append(Case("cubes %d" % count, generated("cubes-%d.glb" % count), energy=(0.93, 1.07)))
    coarse = {name: ["--set", "resolution=32"] for name in ("light-volume", "ray-traced-voxels")}
    cases += [Case("arena", lambda: (shared("scenes", "arena-zdm2", "zdm2.glb"), list(ARENA)), exposure=0.2,
                   energy=(0.93, 1.05), options=coarse),
              Case("arena, built-in", lambda: (cli.scene_file("arena"), []), energy=(0.93, 1.05), options=coarse)]
    cases.append(lit_case("classroom", energy=(0.95, 1.05), ssim=SSIM))
    for name in ("breakfast-room", "living-room", "sibenik", "sponza-crytek", "sponza-dabrovic", "conference"):
        cases.append(lit_case(name, energy=(0.96, 1.04), ssim=SSIM))
    return cases


# ---- measuring ----


def render(section, case, technique, path, options):
    """(picture, statistics) of a preset `best`."""
    picture = output("extent-%s-%s.exr" % (case.name.replace(",", "").replace(" ", "-"), technique))
    stats = section.run_json("render", path, *options, *method(technique, "best"), *case.options.get(technique, ()), "--size", case.size,
                             "--frames", FRAMES, "--samples", AVERAGED, "--aov", "direct,indirect", "--stats", "json", "-o", picture)
    return picture, stats


def leak_row(section, case, technique, path, options):
    """Light of the view that should be black, over the truth's light of the other."""
    dark, light = ("inside", "outside") if case.name.startswith("sealed") else ("sealed", "lit")
    lit_picture = truth(section, path, case.size, 64, None, "--camera=" + light, *options)[0]
    picture, stats = render(section, case, technique, path, ["--camera=" + dark, *options])
    scale = mean_of(section, lit_picture)
    shown = []
    for aov in ("indirect", "combined"):
        leak, most = (light / scale for light in (mean_of(section, part(picture, aov)), brightest_block(part(picture, aov), 4)))
        met = leak <= case.leak and most <= BAND or technique != "light-volume"
        shown.append(section.demand(met, "%.3f %%, %.2f %%" % (100 * leak, 100 * most),
                                    "%s, %s: leak of %s light" % (case.name, technique, aov)))
    return ["", "", "", "", *shown, *costs(stats)]


def brightest_block(picture, side):
    """Largest mean of side x side pixels, all channels."""
    rows = pixels.load_exr(picture)
    blocks = ((x, y) for y in range(0, len(rows) - side + 1, side) for x in range(0, len(rows[0]) - side + 1, side))
    return max(sum(sum(rows[y + j][x + i]) for j in range(side) for i in range(side)) for x, y in blocks) / (3 * side * side)


def light_row(section, case, technique, path, options):
    bounces = most_bounces(technique, "best")
    true = quiet_truth(section, path, case.size, bounces, options, NOISE, MOST_SAMPLES)
    picture, stats = render(section, case, technique, path, options)
    light, whole = (section.compare(part(picture, aov), part(true.path, aov), "--block", 4, "--exposure", case.exposure)
                    for aov in ("indirect", "combined"))
    what = "%s, %s" % (case.name, technique)
    low, high = case.energy_of(technique) or (-math.inf, math.inf)
    energy = section.demand(low <= light["energy"] <= high, "%.3f" % light["energy"], "%s: energy within %g to %g" % (what, low, high))
    ssim = section.demand(technique != "light-volume" or case.ssim is None or whole["ssim"] >= case.ssim, "%.3f" % whole["ssim"],
                          "%s: SSIM" % what)
    return ["all" if bounces is None else "%d" % bounces, number(true.noise, 1), energy, "%.3f, %s" % (whole["energy"], ssim), "", "", *costs(stats)]


def costs(stats):
    return [milliseconds(stats["gpu_time_ms"]), "%.0f" % (sum(stats["memory_bytes"].values()) / 2 ** 20)]


def measure(section, cases, techniques, each_row=lambda row: None):
    rows = []
    for case in cases:
        try:
            path, options = case.make()
        except Missing as reason:
            section.skip(case.name, str(reason))
            continue
        for technique in techniques:
            row = leak_row if case.leak is not None else light_row
            rows.append([case.name, technique, *row(section, case, technique, path, options)])
            each_row(rows[-1])
    return rows


HEAD = ["case", "technique", "bounces", "truth's noise", "energy, indirect", "energy and SSIM, combined", "leak, indirect",
        "leak, combined", "ms a frame", "MiB"]


def extent(section):
    """Rooms on large grounds, small lamps, thin walls, many bodies, public scenes: energy, SSIM, leak, time, memory."""
    section.text("%s generated scenes and arena, %s the others; `best`, %d frames, the last %d averaged. Energy and SSIM of 4 x 4 averages "
                 "against the path tracer at as many bounces. *Truth's noise*: relMSE of its indirect light. *Leak*: mean of the view "
                 "that is to be black over the truth's mean of the other (outside, or the lit room), and its brightest 4 x 4 block over the "
                 "same; the combined one has what shadow maps let through. Light comes from `scripts/extent_scenes.py` and `tests/lights`."
                 % (SMALL, LARGE, FRAMES, AVERAGED))
    section.table(HEAD, measure(section, all_cases(), TECHNIQUES))


# ---- a flight through a town ----

FLIGHT_SECONDS = 5
FLIGHT_RATES = (24, 60)  # frames a second
POP = 0.03
SLOWEST = 1.5  # times the median
POINT_TECHNIQUES = ("light-volume", "ray-traced-voxels")  # that answer away from the screen


def flight(section):
    """Through a town of 1 km and one of its houses: irradiance at 1,000 fixed points, memory, time."""
    path = extent_scenes.write(output("extent-scenes"), "town.glb")
    rows = []
    for technique, rate in itertools.product(POINT_TECHNIQUES, FLIGHT_RATES):
        name = "%s, %d a second" % (technique, rate)
        result = section.run_json("bench", "flight", path, SKY, "--technique", technique, "--fps", rate, "--frames",
                                  FLIGHT_SECONDS * rate, "--points", 1000, "--json", timeout=3600)
        with open(output("flight-%s-%d.json" % (technique, rate)), "w", encoding="utf-8") as f:
            json.dump(result, f, indent=1)
        changes, wall = result["changes"], result["wall_ms"]
        ratio = wall["max"] / wall["median"]
        growth = result["memory_bytes"]["last"] / result["memory_bytes"]["first"]
        rows.append([name, "%.2f %%" % (100 * changes["p50"]), "%.1f %%" % (100 * changes["p99"]),
                     section.demand(changes["p999"] <= POP, "%.1f %%" % (100 * changes["p999"]), name + ": change, 99.9 %"),
                     "%.3f to %.3f" % (result["energy"]["first"], result["energy"]["last"]),
                     "%.3f to %.3f" % (result["error"]["first"], result["error"]["last"]),
                     "%.0f, %+.1f %%" % (result["memory_bytes"]["last"] / 2 ** 20, 100 * (growth - 1)), milliseconds(wall["median"]),
                     section.demand(ratio <= SLOWEST, "%.2f" % ratio, name + ": slowest frame over the median")])
    section.text("`lightwell bench flight` on the town of `scripts/town_scene.py`: 5 s, at up to 36 m/s in the street and 10 m/s "
                 "in the house. *Change*: of a point's irradiance from one frame to the next, over the larger of both and a hundredth "
                 "of the mean of all; of all points and frames. *Energy*: mean at all points over the path tracer's; *error*: mean distance from it, over its mean; first and "
                 "last frame.")
    section.table(["technique, frames", "change, median", "99 %", "99.9 %", "energy", "error", "MiB, growth", "ms a frame",
                   "slowest over median"], rows)


FIGURES = {"extent": extent, "flight": flight}


def main():
    parser = argparse.ArgumentParser(prog="scripts/figures_extent.py", description=__doc__.split("\n\n")[0])
    parser.add_argument("--technique", action="append", choices=TECHNIQUES, help="this one; may be given again")
    parser.add_argument("--list", action="store_true", help="names of the cases")
    parser.add_argument("cases", nargs="*", metavar="CASE", help="beginning of a case's name")
    arguments = parser.parse_args()
    cases = [case for case in all_cases() if not arguments.cases or case.name.startswith(tuple(arguments.cases))]
    if arguments.list:
        print("\n".join(case.name for case in cases))
        return 0
    section = Section("extent")
    print(" | ".join(HEAD))
    measure(section, cases, arguments.technique or TECHNIQUES, lambda row: print(" | ".join(row), flush=True))
    for line in section.skipped:
        print("SKIPPED " + line)
    print("%d demands missed" % len(section.missed))
    return 1 if section.missed else 0


if __name__ == "__main__":
    cli.main(main)
