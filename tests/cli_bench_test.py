#!/usr/bin/env python3
"""Tests of the command line as a user meets it: what lightwell bench and its commands print.

cli_bench_test.py PROGRAM [unittest arguments]. Python's standard library only.
"""
import csv
import json
import xml.etree.ElementTree

from command_line import CommandLine, main


class Bench(CommandLine):
    def test_frames(self):
        devices = json.loads(self.succeed("info", "--json"))
        if not any(not device["missing"] for device in devices):
            self.skipTest("no Vulkan device")
        result = json.loads(self.succeed("bench", "tiny", "--light", "point pos=0,0,8 intensity=1", "--technique", "none",
                                         "--size", "24x16", "--frames", 4, "--warm-up", 1, "--move-lights", "--json"))
        self.assertEqual(result["frames"], 4)
        self.assertEqual(result["lights"], 1)
        for times in (result["wall_ms"], result["gpu_ms"], *(p["ms"] for p in result["passes"])):
            self.assertTrue(0 <= times["min"] <= times["median"] <= times["max"])
        self.assertLessEqual(result["gpu_ms"]["mean"], result["wall_ms"]["mean"])
        self.assertAlmostEqual(sum(p["ms"]["mean"] for p in result["passes"]), result["gpu_ms"]["mean"], places=6)
        self.assertEqual(result["memory_bytes"], sum(m["bytes"] for m in result["memory"]))
        self.assertNotIn("read back", [p["name"] for p in result["passes"]])

    def test_rays(self):
        devices = json.loads(self.succeed("info", "--json"))
        if not any(not device["missing"] for device in devices):
            self.skipTest("no Vulkan device")
        result = json.loads(self.succeed("rays", "tiny", "--rays", 1000, "--repeat", 1, "--json"))
        self.assertEqual(result["structures"][0]["tracing"], "bvh")
        self.assertGreater(result["structures"][0]["build_ms"], 0)
        for row in result["rates"]:
            self.assertEqual(row["count"], 1000)
            self.assertGreater(row["rays_per_s"], 0)
            self.assertLessEqual(abs(row["hits"] - row["embree_hits"]), 1)

    def test_many_light(self):
        if "many-light" not in [t["name"] for t in json.loads(self.succeed("info", "--techniques", "--json"))]:
            self.skipTest("no technique many-light in this build")
        if not any(not device["missing"] for device in json.loads(self.succeed("info", "--json"))):
            self.skipTest("no Vulkan device")
        tiny = ["bench", "many-light", "--vpls", "64,512", "--size", "32x32", "--resolution", 32, "--frames", 2]
        result = json.loads(self.succeed(*tiny, "--json"))
        self.assertEqual(result["left_out"], ["sponza-crytek"])
        self.assertEqual([(t["scene"], t["preset"]) for t in result["tables"]],
                         [("cornell-dynamic", "paper"), ("cornell-dynamic", "best")])
        for table in result["tables"]:
            self.assertEqual((table["size"], table["resolution"]), ("32x32", "32"))
            self.assertEqual([column["vpls"] for column in table["columns"]], [64, 512])
            self.assertEqual(["published" in column for column in table["columns"]], [False, True])
            for column in table["columns"]:
                self.check_many_light_column(column, table["preset"])
            self.assertEqual(table["columns"][0]["indirect_to_first"], 1)
            self.assertEqual(table["columns"][1]["published"]["stages"][4]["ms"], 16)
        text = self.succeed(*tiny, "--preset", "paper")
        for stage in ("voxels and octree", "RSM", "VPLs", "direct light", "indirect light", "all other"):
            self.assertEqual(text.count("\n" + stage), 1)

    def check_many_light_column(self, column, preset):
        """Stages add up to their sum, and with all other passes to the fastest frame; none took no time, but for those that
        the preset does without."""
        times = [stage["ms"] for stage in column["stages"]]
        made_by_none = ("voxels and octree", "RSM") if preset == "best" else ()
        for stage in column["stages"]:
            self.assertTrue(stage["ms"] > 0 or stage["name"] in made_by_none, stage)
        self.assertAlmostEqual(sum(times[:-1]), column["sum_ms"], places=6)
        self.assertAlmostEqual(sum(times), column["bench"]["gpu_ms"]["min"], places=6)
        self.assertAlmostEqual(sum(stage.get("share", 0) for stage in column["stages"]), 1, places=6)

    def test_many_light_errors(self):
        many_light = ["bench", "many-light"]
        self.fail_with("SCENE is required", "bench")
        self.fail_with("--technique", *many_light, "--technique", "none")
        self.fail_with("SCENE", *many_light, "tiny")
        self.fail_with("--scenes", *many_light, "--scenes", "tiny")
        self.fail_with("--vpls", *many_light, "--vpls", "512,")
        self.fail_with("--size-scale", *many_light, "--size", "8x8", "--size-scale", "2")

    def test_ray_traced_voxels(self):
        techniques = {t["name"]: t for t in json.loads(self.succeed("info", "--techniques", "--json"))}
        if "ray-traced-voxels" not in techniques:
            self.skipTest("no technique ray-traced-voxels in this build")
        if not any(not device["missing"] for device in json.loads(self.succeed("info", "--json"))):
            self.skipTest("no Vulkan device")
        small = ["bench", "ray-traced-voxels", "--grids", 64, "--rays", "256,512", "--size-scale", 0.05, "--rays-scale", 0.1,
                 "--frames", 1]
        result = json.loads(self.succeed(*small, "--rounds", 2, "--table", "7.2", "--table", "7.3", "--table", "7.7", "--json"))
        self.assertEqual([table["table"] for table in result["tables"]], ["7.2", "7.3", "7.7"])
        for table in result["tables"]:
            for row in table["rows"]:
                self.check_voxels_row(row)
        plain, average, taps = (table["rows"] for table in result["tables"])
        self.assertEqual([(row["settings"]["light"], row["settings"]["rays"]) for row in average],
                         [(light, rays) for light in ("far", "near") for rays in ("26", "51")])
        self.assertEqual(average[3]["base"], plain[3]["settings"])
        self.assertAlmostEqual(average[3]["ratio"]["inject"], average[3]["ms"]["inject"] / plain[3]["ms"]["inject"])
        self.assertEqual(average[3]["published"]["ms"], {"voxelise": 0.331098, "inject": 7.32731, "final": 0.156015})
        self.assertAlmostEqual(average[3]["published"]["ratio"]["inject"], 7.32731 / 0.0824932)
        self.assertEqual([(row["settings"]["taps"], row["settings"]["size"]) for row in taps],
                         [(n, size) for n in "17" for size in ("32x24", "64x36", "96x54")])
        self.assertEqual(taps[4]["base"], taps[1]["settings"])
        self.assertEqual(taps[0]["ratio"], {"voxelise": 1, "inject": 1, "final": 1})
        self.assertEqual((average[1]["settings"], average[1]["rounds"]), (taps[5]["settings"], taps[5]["rounds"]))

        text = self.succeed(*small, "--table", "5.1", "--table", "presets")
        self.assertIn("5.1  Two scenes; ratios to the first row", text)
        self.assertEqual(text.count("\nroom "), 1 + 2 * len(techniques["ray-traced-voxels"]["presets"]))

    def check_voxels_row(self, row):
        """Stages take no more than the one frame of each round, after one from nothing; parts of the injection add up."""
        self.assertEqual(row["settings"]["scene"], "cornell-spot")
        self.assertTrue(all(row["ms"][stage] > 0 for stage in ("voxelise", "inject", "final")), row)
        self.assertEqual([result["frames"] for result in row["rounds"]], [2, 2])
        fastest = min(sum(p["each_ms"][1] for p in result["passes"]) for result in row["rounds"])
        self.assertLessEqual(sum(row["ms"].values()) + row["other_ms"], fastest + 1e-6)
        parts = row["inject_parts"]
        self.assertAlmostEqual(parts["trace_ms"] + parts["write_ms"] + parts["clear_ms"], row["ms"]["inject"], places=6)
        for ratios in (row["ratio"], row["published"]["ratio"]):
            self.assertEqual(list(ratios), ["voxelise", "inject", "final"])

    def test_ray_traced_voxels_errors(self):
        if "ray-traced-voxels" not in [t["name"] for t in json.loads(self.succeed("info", "--techniques", "--json"))]:
            self.skipTest("no technique ray-traced-voxels in this build")
        voxels = ["bench", "ray-traced-voxels"]
        self.fail_with("--table: '7.9' (there are: 5.1, 7.1", *voxels, "--table", "7.9")
        self.fail_with("--preset", *voxels, "--preset", "quick")
        self.fail_with("nowhere.gltf", *voxels, "--table", "7.1", "--table", "7.3", "--sibenik", "nowhere.gltf", "-q")
        self.fail_with("--grids", *voxels, "--grids", "64,")
        self.fail_with("--size-scale", *voxels, "--size-scale", 0)
        self.fail_with("--technique", *voxels, "--technique", "none")

    def test_photon_splatting(self):
        if "photon-splatting" not in [t["name"] for t in json.loads(self.succeed("info", "--techniques", "--json"))]:
            self.skipTest("no technique photon-splatting in this build")
        if not any(not device["missing"] for device in json.loads(self.succeed("info", "--json"))):
            self.skipTest("no Vulkan device")
        settings = ["photon-mapping", "small-maps", "stratified-256", "best"]
        small = ["bench", "photon-splatting", "--size", "48x48", "--frames", 3, "--samples", 16, "--photons-scale", 0.02]
        result = json.loads(self.succeed(*small, *(word for name in settings for word in ("--setting", name)),
                                         "--csv", "x.csv", "--svg", "x.svg", "--json"))
        self.assertEqual(result["left_out"], ["conference"])
        [scene] = result["scenes"]
        self.assertEqual(scene["scene"], "cornell-spot")
        self.assertTrue(0 < scene["pixels"] < 48 * 48)
        self.assertAlmostEqual(scene["exposure"] * scene["truth"]["mean"], 0.18, places=6)
        self.assertEqual(scene["truth"]["samples"], 16)
        self.assertGreater(scene["truth"]["noise_rmse8"], 0)

        mapper, maps, stratified, best = scene["curves"]
        self.assertEqual([curve["setting"] for curve in scene["curves"]], settings)
        self.assertEqual([point["photons"] for point in mapper["points"]], [63, 250, 1000, 4000])
        self.assertEqual([point["photons"] for point in maps["points"]], [31, 125, 500, 2000])
        self.assertEqual([point["frames"] for point in best["points"]], [1, 2, 3])
        for curve in scene["curves"]:
            for point in curve["points"]:
                self.assertEqual("k" in point, curve is mapper)
                self.assertEqual(point["factor"] != 1, curve in (maps, stratified))
                self.assertTrue(point["time_ms"] > 0 and point["rmse8"] >= 0 and point["relMSE"] >= 0, point)
        self.assertLess(mapper["points"][-1]["rmse8"], mapper["points"][0]["rmse8"])
        self.assertAlmostEqual(best["points"][2]["time_ms"], 3 * best["points"][0]["time_ms"])
        self.check_equal_error(scene["equal_error"], best["points"])

        memory = {row["setting"]: row for row in scene["memory"]}
        self.assertEqual(list(memory), settings)
        self.assertEqual(memory["stratified-256"]["published"], {"photons": 25000, "bytes": 576 * 2**20})
        self.assertNotIn("published", memory["best"])
        for row in memory.values():
            self.assertAlmostEqual(row["bytes_a_photon"] * row["photons"], row["photon_bytes"], places=3)
            self.assertLessEqual(row["splat_bytes"], row["photon_bytes"])
        self.assertGreaterEqual(memory["small-maps"]["map_bytes"], 500 * 4 * 4 * 4)
        self.check_files_of_curves(scene)

    def check_equal_error(self, rows, best):
        """`best` has the mapper's error at a time that its own errors put it to."""
        self.assertEqual([row["mapper"]["photons"] for row in rows], [63, 250, 1000, 4000])
        for row in rows:
            wanted = row["mapper"]["rmse8"]
            reached = [point for point in best if point["rmse8"] <= wanted]
            self.assertEqual(row["best_ms"] is not None, bool(reached))
            if not reached:
                continue
            self.assertEqual(row["at_most"], reached[0] is best[0])
            before = best[max(best.index(reached[0]) - 1, 0)]
            self.assertTrue(before["time_ms"] - 1e-9 <= row["best_ms"] <= reached[0]["time_ms"] + 1e-9)
            self.assertAlmostEqual(row["ratio"], row["best_ms"] / row["mapper"]["time_ms"])

    def check_files_of_curves(self, scene):
        points = [(curve["setting"], point) for curve in scene["curves"] for point in curve["points"]]
        with open(self.folder / "x.csv", encoding="utf-8") as f:
            head, *lines = csv.reader(f)
        self.assertEqual(head, ["scene", "setting", "photons", "frames", "k", "time_ms", "rmse8", "relMSE", "energy", "factor"])
        self.assertEqual(len(lines), len(points))
        for line, (setting, point) in zip(lines, points):
            self.assertEqual(line[:4], ["cornell-spot", setting, str(point["photons"]), str(point["frames"])])
            for name, text in zip(head[5:], line[5:]):
                self.assertAlmostEqual(float(text), point[name], delta=1e-5 * abs(point[name]))
        svg = "{http://www.w3.org/2000/svg}"
        picture = xml.etree.ElementTree.parse(self.folder / "x.svg").getroot()
        self.assertEqual(picture.tag, svg + "svg")
        shown = sum(point[error] > 0 for _, point in points for error in ("rmse8", "relMSE"))
        self.assertEqual(len(picture.findall(svg + "circle")), shown)
        texts = [text.text for text in picture.findall(svg + "text")]
        for curve in scene["curves"]:
            self.assertEqual(texts.count(curve["setting"]), 1)
        self.assertEqual(texts.count("cornell-spot"), 2)

    def test_photon_splatting_text(self):
        if "photon-splatting" not in [t["name"] for t in json.loads(self.succeed("info", "--techniques", "--json"))]:
            self.skipTest("no technique photon-splatting in this build")
        if not any(not device["missing"] for device in json.loads(self.succeed("info", "--json"))):
            self.skipTest("no Vulkan device")
        text = self.succeed("bench", "photon-splatting", "--scenes", "cornell-spot", "--setting", "photon-mapping", "--size",
                            "32x32", "--samples", 4, "--photons-scale", 0.01)
        self.assertEqual(text.count("\nphoton-mapping"), 5)
        self.assertNotIn("equal RMSE", text)

    def test_photon_splatting_errors(self):
        if "photon-splatting" not in [t["name"] for t in json.loads(self.succeed("info", "--techniques", "--json"))]:
            self.skipTest("no technique photon-splatting in this build")
        splatting = ["bench", "photon-splatting"]
        self.fail_with("--setting: 'tiny-maps' (there are: photon-mapping, small-maps", *splatting, "--setting", "tiny-maps")
        self.fail_with("--scenes: 'tiny' (there are: cornell-spot, conference)", *splatting, "--scenes", "tiny")
        self.fail_with("nowhere.gltf", *splatting, "--scenes", "conference", "--conference", "nowhere.gltf")
        self.fail_with("nowhere", *splatting, "--scenes", "conference", "--svg", "nowhere/x.svg", "-q")
        self.fail_with("--bounces", *splatting, "--bounces", 0)
        self.fail_with("--samples", *splatting, "--samples", 1)
        self.fail_with("--technique", *splatting, "--technique", "none")

    def test_errors(self):
        self.fail_with("--frames", "bench", "tiny", "--technique", "none", "--frames", "0")
        self.fail_with("--rays", "rays", "tiny", "--rays", "0")
        self.fail_with("--technique", "bench", "tiny", "--technique", "path-tracer")


if __name__ == "__main__":
    main()
