"""Figures about ray tracing: rays a second beside Embree's, what hierarchies cost."""

import cli
from figures import Missing, milliseconds, number, shared

# (name, path below ../shared/scenes or None for a built-in scene, scene options)
SCENES = (
    ("cornell-box", ("cornell-box", "cornell-original.gltf"), ()),
    ("room", None, ()),
    ("arena", None, ()),
    ("zdm2", ("arena-zdm2", "zdm2.glb"), ()),
    ("sponza-dabrovic", ("sponza-dabrovic", "sponza-dabrovic.gltf"), ()),
    ("sibenik", ("sibenik", "sibenik.gltf"), ()),
    ("classroom", ("classroom", "classroom.gltf"), ()),
    ("living-room", ("living-room-wig42", "living-room-wig42.gltf"), ()),
    ("sponza", ("sponza-crytek", "sponza-crytek.gltf"), ("--scale", "0.01")),
    ("breakfast-room", ("breakfast-room-wig42", "breakfast-room-wig42.gltf"), ()),
    ("conference", ("conference", "conference.gltf"), ()),
)
DEMANDED_RATIO = 0.1  # of Embree's any-hit rate on the same rays
LARGE = 50000  # triangles from which build time is proportional to their number
DEMANDED_SPREAD = 2.0  # of build time a triangle among large scenes


def measure(section):
    """(name, result of `lightwell rays`) of every scene that is here."""
    results = []
    for name, path, options in SCENES:
        try:
            scene = shared("scenes", *path) if path else cli.scene_file(name)
        except Missing as reason:
            section.skip(name, str(reason))
            continue
        results.append((name, section.run_json("rays", scene, *options, "--json")))
    return results


def rates(section, results):
    section.text("A million rays of each kind: *camera* through the pixels of a picture, in tiles of 8x8; *ambient* from "
                 "what these see into the hemisphere, each its own way; nothing ends them. Millions of rays a second on "
                 "all cores, median of 3 runs, ours and Embree's (one call a ray) in turn. Demand: at least a tenth of "
                 "Embree's rate for any-hit queries.")
    rows = []
    for name, result in results:
        for kind in sorted({(r["tracing"], r["rays"]) for r in result["rates"]}):
            row = [name, *kind]
            for r in result["rates"]:
                if (r["tracing"], r["rays"]) != kind:
                    continue
                ratio = number(r["ratio"])
                if r["query"] == "any hit" and r["tracing"] == "bvh":
                    ratio = section.demand(r["ratio"] >= DEMANDED_RATIO, ratio, "%s, %s rays, any hit" % (name, r["rays"]))
                row += [number(r["rays_per_s"] / 1e6), number(r["embree_rays_per_s"] / 1e6), ratio]
            rows.append(row)
    section.table(["scene", "by", "rays", "any hit", "Embree", "ratio", "closest hit", "Embree", "ratio"], rows)


def builds(section, results):
    section.text("Bringing the hierarchy up to date when all triangles have moved: built anew, or the old one refitted. "
                 "Device time, median of 3.")
    rows = []
    each = {}
    for name, result in results:
        for structure in result["structures"]:
            triangles = result["triangles"]
            each_ns = structure["build_ms"] * 1e6 / triangles
            if structure["tracing"] == "bvh" and triangles >= LARGE:
                each[name] = each_ns
            rows.append([name, str(triangles), structure["tracing"], milliseconds(structure["build_ms"]),
                         number(each_ns), milliseconds(structure["refit_ms"]), milliseconds(result["embree_build_ms"])])
    section.table(["scene", "triangles", "by", "build, ms", "ns a triangle", "refit, ms", "Embree's build, ms"], rows)
    if len(each) > 1:
        spread = max(each.values()) / min(each.values())
        section.text("Build time a triangle, largest over smallest among scenes of %d triangles and more: %s (demand: at "
                     "most %g: build time is linear)." % (LARGE, section.demand(
                         spread <= DEMANDED_SPREAD, number(spread), "build time is linear"), DEMANDED_SPREAD))


def tracing(section):
    """Rays a second of our hierarchy beside Embree's, and what it costs to build and refit."""
    results = measure(section)
    rates(section, results)
    builds(section, results)


FIGURES = {"tracing": tracing}
