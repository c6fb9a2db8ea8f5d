"""The figure about the published tables of ray_traced_voxels' time."""

import json

from figures import Missing, output, shared

STAGES = ("voxelise", "inject", "final")
ROUNDS = 3
WRITERS = {"7.2": "none", "7.3": "average", "7.4": "maximum", "exact": "exact"}  # by their tables
FILES = {"sibenik": ("sibenik", "sibenik.gltf"), "sponza": ("sponza-crytek", "sponza-crytek.gltf")}
MOST = {"near": 1.5, "far": 2.5}  # of the time of unsynchronised writes that the exact writer may take


def scene_files(section, *names):
    files = []
    for name in names:
        try:
            files += ["--" + name, shared("scenes", *FILES[name])]
        except Missing as reason:
            section.skip(name + ", for which a built-in scene stands in", str(reason))
    return files


def run_bench(section, name, *options):
    result = section.run_json("bench", "ray-traced-voxels", "--rounds", ROUNDS, *options, "--json", timeout=3600)
    with open(output(name + ".json"), "w", encoding="utf-8") as f:
        json.dump(result, f, indent=1)
    return result


def tables(section, *more):
    """Tables 5.1 and 7.1 to 7.7 of Magalhaes 2020, reduced, and ours; `more` goes to `lightwell bench ray-traced-voxels`."""
    result = run_bench(section, "ray-traced-voxels-bench", *scene_files(section, *FILES), *more)
    section.text("Device time, ms: of each stage the least of %d rounds over all settings, 3 frames each. `paper` makes everything "
                 "anew in every frame; `best` voxelises once: its *voxelise* is of the first frame, the rest of frames from the sixth on. Sides of the output are %g, of the square of rays %g times the published ones; grids are as "
                 "published. *Ratio*: to the row that is named above each table; beside it the published ratio (RTX 2070 "
                 "Super). *Rays*, *write*, *clear*: parts of `paper`'s injection, which are to trace, to write what was hit, and "
                 "to clear and resolve the grid; the ratio beside *write* is the writer's alone. Published final passes draw the "
                 "scene, too: that is among ours of *other*. As JSON: build/results/ray-traced-voxels-bench.json." % (
                     ROUNDS, result["size_scale"], result["rays_scale"]))
    for table in result["tables"]:
        same = ", ".join("%s %s" % (name, table["rows"][0]["settings"][name]) for name in table["same"])
        section.text("**%s. %s**: %s. Ratios to %s." % (table["table"], table["title"], same, table["ratios_to"]))
        published = "published" in table["rows"][0]
        columns = ("ms", "ratio", "published") if published else ("ms", "ratio")
        head = [*table["varying"], *("%s, %s" % (stage, column) for stage in STAGES for column in columns),
                "rays, ms", "write, ms", "ratio", "clear, ms", "other, ms"]
        section.table(head, [row_of(row, table["varying"], published) for row in table["rows"]])


def row_of(row, varying, published):
    cells = [row["settings"].get(name, "") for name in varying]
    for stage in STAGES:
        cells += [time(row["ms"][stage]), ratio(row["ratio"][stage])]
        if published:
            cells.append(ratio(row["published"]["ratio"][stage]))
    parts = row.get("inject_parts")
    cells += ["", "", "", ""] if parts is None else [
        time(parts["trace_ms"]), time(parts["write_ms"]), ratio(parts["write_ratio"]),
        time(parts["clear_ms"])]
    return [*cells, time(row["other_ms"])]


def time(value):
    return "%.3g" % value if value < 100 else "%.0f" % value


def ratio(value):
    return "" if value is None else "%.2f" % value


def writers(section, *more):
    """What writers cost over the same hits, tracing left out, at published numbers of rays; `more` as above."""
    tables_of = [word for name in WRITERS for word in ("--table", name)]
    result = run_bench(section, "ray-traced-voxels-writers", *scene_files(section, "sibenik"), *tables_of, "--rays", "512,1024",
                       "--rays-scale", 1, "--size-scale", 0.05, *more)
    found = {WRITERS[table["table"]]: table["rows"] for table in result["tables"]}
    scene = found["none"][0]["settings"]["scene"]
    section.text("%s, published grids and rays; ms of the pass that writes what rays have hit, the least of %d rounds in which "
                 "the writers take turns, and its ratio to unsynchronised writes (`none`). *Published*: ratio of the whole "
                 "injection, rays included (RTX 2070 Super, Tables 7.2 to 7.4). *Exact, clear*: what it does once a voxel, to "
                 "clear sums and to make means of them. Demands on `exact`: at most %g with the light near a wall, at most %g "
                 "far. As JSON: build/results/ray-traced-voxels-writers.json." % (scene, ROUNDS, MOST["near"], MOST["far"]))
    rows = []
    for none, average, maximum, exact in zip(*(found[writer] for writer in WRITERS.values())):
        settings, parts = none["settings"], exact["inject_parts"]
        light, what = settings["light"], "%(light)s, %(grid)s cells, %(rays)s rays" % settings
        rows.append([light, settings["grid"], settings["rays"], time(none["inject_parts"]["write_ms"])])
        for row in (average, maximum):
            rows[-1] += [time(row["inject_parts"]["write_ms"]), ratio(row["inject_parts"]["write_ratio"]),
                         ratio(row["published"]["ratio"]["inject"])]
        rows[-1] += [time(parts["write_ms"]), section.demand(parts["write_ratio"] <= MOST[light], ratio(parts["write_ratio"]),
                                                             "exact, %s, at most %g" % (what, MOST[light])),
                     time(parts["clear_ms"])]
    head = ["light", "grid", "rays", "none, ms"]
    for writer in ("average", "maximum"):
        head += [writer + ", ms", "ratio", "published"]
    section.table([*head, "exact, ms", "ratio", "exact, clear"], rows)


FIGURES = {"ray-traced-voxels-bench": tables, "ray-traced-voxels-writes": writers}
