"""Figures about photon splatting: error over time of the published settings and ours, and memory."""

import json
import os

from figures import Missing, output, shared

MOST_RATIO = 0.25  # of the photon mapper's time, at its error
MOST_QUERY = 25.0  # us, of the photon mapper on one core
MOST_BYTES = 64.0  # a photon
LEAST_SAVING = 50  # of the published memory of stratified-256

MEGABYTE = 1 << 20


def conference(section):
    try:
        return ["--conference", shared("scenes", "conference", "conference.gltf")]
    except Missing as reason:
        section.skip("conference", str(reason))
        return []


def kept(name):
    return output("photon-splatting-%s.json" % name)


def run_bench(section, name, *options):
    result = section.run_json("bench", "photon-splatting", *options, "--json", timeout=7200)
    with open(kept(name), "w", encoding="utf-8") as f:
        json.dump(result, f, indent=1)
    return result


def error_over_time(section, *more):
    """Error over time of the settings of the thesis and ours; `--size 1600x900` among `more` is the published size."""
    curves, picture = output("photon-splatting-error.csv"), output("photon-splatting-error.svg")
    result = run_bench(section, "error", *conference(section), "--csv", curves, "--svg", picture, *more)
    section.text("Indirect light of %s bounce%s at most against the path tracer's, %s, on pixels away from edges, at the "
                 "exposure that makes its mean 0.18; relMSE divides by r² + (mean / 10)². *ms*: of the technique's own passes on "
                 "the device, or of emission, kd-tree and queries of the photon mapper on all cores; G-buffer and direct light "
                 "are left out of both. What the truth's own noise adds is subtracted. *Factor*: what pictures normalised by "
                 "weights, which have no unit, are multiplied by first (least squares). Settings and lights: "
                 "src/apps/cli/bench_photon_splatting_settings.cpp. All points: build/results/photon-splatting-error.csv." % (
                     result["bounces"], "" if result["bounces"] == 1 else "s", result["size"].replace("x", " x ")))
    section.picture(picture, "RMSE and relMSE over milliseconds, a curve a setting")
    for scene in result["scenes"]:
        truth = scene["truth"]
        section.text("**%s**: %d pixels; truth of %d paths a pixel, %.0f s, its own RMSE %.2f, relMSE %.2g." % (
            scene["scene"], scene["pixels"], truth["samples"], truth["seconds"], truth["noise_rmse8"], truth["noise_relMSE"]))
        section.table(["setting", "photons", "frames", "ms", "RMSE", "relMSE", "energy", "factor"],
                      [row for curve in scene["curves"] for row in rows_of(curve)])
        equal_error(section, scene)


def rows_of(curve):
    return [[curve["setting"], "%d" % p["photons"], "%d" % p["frames"], "%.3g" % p["time_ms"] if p["time_ms"] < 100 else
             "%.0f" % p["time_ms"], "%.2f" % p["rmse8"], "%.3g" % p["relMSE"], "%.3f" % p["energy"],
             "" if p["factor"] == 1 else "%.2f" % p["factor"]] for p in curve["points"]]


def equal_error(section, scene):
    """`best` against the photon mapper at the mapper's error, of its most photons."""
    if not scene["equal_error"]:
        return
    section.text("Photon mapping with the k of least RMSE, and when `best` is as near. Demanded of the last row: a ratio of at "
                 "most %g, and at most %g us a query." % (MOST_RATIO, MOST_QUERY))
    rows = []
    for row in scene["equal_error"]:
        mapper, last = row["mapper"], row is scene["equal_error"][-1]
        what = "%s, %d photons" % (scene["scene"], mapper["photons"])
        ratio = "not reached" if row["ratio"] is None else ("≤ " if row["at_most"] else "") + "%.3g" % row["ratio"]
        met = row["ratio"] is not None and row["ratio"] <= MOST_RATIO
        rows.append(["%d" % mapper["photons"], "%d" % mapper["k"],
                     section.demand(not last or mapper["us_per_query"] <= MOST_QUERY, "%.1f" % mapper["us_per_query"],
                                    what + ", us a query, at most %g" % MOST_QUERY),
                     "%.2f" % mapper["rmse8"], "%.1f" % mapper["time_ms"],
                     "" if row["best_ms"] is None else "%.1f" % row["best_ms"],
                     section.demand(not last or met, ratio, what + ", ratio of times, at most %g" % MOST_RATIO)])
    section.table(["photons", "k", "us a query", "RMSE", "mapper, ms", "best, ms", "ratio"], rows)


def memory(section, *more):
    """Table 1 of the thesis, memory of photons, and ours; of the last figure's run where there is one."""
    if os.path.exists(kept("error")):
        with open(kept("error"), encoding="utf-8") as f:
            result = json.load(f)
        section.commands.append("# kept from photon-splatting-error: build/results/photon-splatting-error.json")
    else:
        result = run_bench(section, "memory", "--scenes", "cornell-spot", "--samples", 4, "--frames", 1, *more)
    scene = result["scenes"][0]
    section.text("MiB, %s at %s. *Splats*: what the picture is made of, photons and kd-tree of the photon mapper; *with paths*: "
                 "all that lies between lights and splats, too, during a frame; *lists*: of splats by tiles of the picture, "
                 "whose limit is the option `list-memory`. Images of the picture's size are left out, as published. Demanded: at "
                 "most %g bytes a photon as splats, and 1/%d of the published memory of `stratified-256` for photons, maps and "
                 "paths." % (scene["scene"], result["size"].replace("x", " x "), MOST_BYTES, LEAST_SAVING))
    section.table(["setting", "photons", "published", "splats", "bytes each", "with paths", "bytes each", "maps", "lists"],
                  [memory_row(section, row) for row in scene["memory"]])


def memory_row(section, row):
    published = row.get("published", {}).get("bytes")
    each = row["splat_bytes"] / row["photons"]
    whole = row["photon_bytes"] + row["map_bytes"]
    paths = megabytes(row["photon_bytes"])
    if row["setting"] == "stratified-256":
        paths = section.demand(whole * LEAST_SAVING <= published, paths, "stratified-256, 1/%d of published" % LEAST_SAVING)
    return [row["setting"], "%d" % row["photons"], "" if published is None else megabytes(published),
            megabytes(row["splat_bytes"]),
            section.demand(each <= MOST_BYTES or row["setting"] == "photon-mapping", "%.1f" % each,
                           "%s, bytes a photon, at most %g" % (row["setting"], MOST_BYTES)),
            paths, "%.1f" % row["bytes_a_photon"], megabytes(row["map_bytes"]), megabytes(row["tile_bytes"])]


def megabytes(count):
    return "%.2f" % (count / MEGABYTE)


FIGURES = {"photon-splatting-error": error_over_time, "photon-splatting-memory": memory}
