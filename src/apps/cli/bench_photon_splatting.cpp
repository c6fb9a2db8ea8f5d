#include "apps/cli/bench_photon_splatting.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/bench_photon_splatting_measure.h"
#include "apps/cli/bench_photon_splatting_print.h"
#include "apps/cli/bench_photon_splatting_settings.h"
#include "apps/cli/bench_tables.h"
#include "apps/cli/progress.h"
#include "apps/cli/svg_plot.h"
#include "apps/cli/text.h"
#include "core/files.h"
#include "core/log.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kMostBounces = 8, kMostFrames = 100000, kMostSamples = 1 << 20;

struct Arguments {
  std::string scenes = "cornell-spot,conference";
  std::string conference;
  std::vector<std::string> settings;  // none: all
  std::string size = "320x180", bounces = "1", frames = "16", samples = "256", photons_scale = "1";
  std::string csv, svg;
  std::string device;
  bool validation = false;
  bool json = false;
};

// What was measured in one scene.
struct SceneResult {
  std::string name;
  std::unique_ptr<SplatBench> bench;
  std::vector<SplatMeasure> measures;

  const SplatMeasure* find(const std::string& setting) const {
    const auto found = std::find_if(measures.begin(), measures.end(),
                                    [&](const SplatMeasure& measure) { return measure.setting == setting; });
    return found == measures.end() ? nullptr : &*found;
  }
};

std::vector<SplatSetting> choose_settings(const std::vector<std::string>& names) {
  if (names.empty()) return splat_settings();
  std::vector<SplatSetting> chosen;
  for (const std::string& name : names) {
    const auto found = std::find_if(splat_settings().begin(), splat_settings().end(),
                                    [&](const SplatSetting& setting) { return setting.name == name; });
    if (found == splat_settings().end())
      throw InputError("--setting", "'" + name + "' (there are: " + join(splat_setting_names()) + ")");
    chosen.push_back(*found);
  }
  return chosen;
}

std::vector<SplatScene> choose_scenes(const Arguments& arguments, std::vector<std::string>& left_out) {
  std::vector<SplatScene> chosen;
  for (const std::string& name : split(arguments.scenes, ',')) {
    const auto found = std::find_if(splat_scenes().begin(), splat_scenes().end(),
                                    [&](const SplatScene& scene) { return scene.name == name; });
    if (found == splat_scenes().end())
      throw InputError("--scenes", "'" + name + "' (there are: cornell-spot, conference)");
    if (found->needs_file && arguments.conference.empty()) {
      log_warning(name + ": left out, no --conference FILE");
      left_out.push_back(name);
      continue;
    }
    chosen.push_back(*found);
  }
  return chosen;
}

SplatBenchArguments parse(const Arguments& arguments) {
  return {.size = parse_size("--size", arguments.size),
          .bounces = parse_integer("--bounces", arguments.bounces, 1, kMostBounces),
          .frames = parse_integer("--frames", arguments.frames, 1, kMostFrames),
          .samples = parse_integer("--samples", arguments.samples, 2, kMostSamples),
          .photons_scale = parse_number("--photons-scale", arguments.photons_scale, 1e-3f, 10.0f),
          .conference = arguments.conference,
          .device = arguments.device,
          .validation = arguments.validation};
}

Json point_as_json(const SplatPoint& point) {
  Json json = {{"photons", point.photons}, {"frames", point.frames}};
  if (point.k > 0) {
    json["k"] = point.k;
    json["us_per_query"] = point.us_per_query;
  }
  json["time_ms"] = point.time_ms;
  json["rmse8"] = point.error.rmse8;
  json["relMSE"] = point.error.rel_mse;
  json["energy"] = point.error.energy;
  json["factor"] = point.error.factor;
  return json;
}

Json memory_as_json(const SplatSetting& setting, const SplatMemory& memory) {
  Json json = {{"setting", setting.name},
               {"photons", memory.photons},
               {"splat_bytes", memory.splat_bytes},
               {"photon_bytes", memory.photon_bytes},
               {"bytes_a_photon", static_cast<double>(memory.photon_bytes) /
                                      static_cast<double>(std::max<std::int64_t>(memory.photons, 1))},
               {"map_bytes", memory.map_bytes},
               {"tile_bytes", memory.tile_bytes}};
  if (setting.published_bytes > 0.0)
    json["published"] = {{"photons", setting.memory_photons}, {"bytes", setting.published_bytes}};
  return json;
}

Json equal_errors_as_json(const SceneResult& scene) {
  Json rows = Json::array();
  const SplatMeasure* mapper = scene.find("photon-mapping");
  std::vector<const SplatMeasure*> bests;
  for (const SplatMeasure& measure : scene.measures)
    if (measure.setting.starts_with("best")) bests.push_back(&measure);
  if (!mapper || bests.empty()) return rows;
  for (const EqualError& equal : equal_errors(*mapper, bests)) {
    Json row = {{"mapper", point_as_json(equal.mapper)}, {"best_ms", nullptr}, {"ratio", nullptr}};
    if (equal.time_ms) {
      row["best_ms"] = *equal.time_ms;
      row["setting"] = equal.setting;
      row["ratio"] = equal.ratio();
      row["at_most"] = equal.at_most;
    }
    rows.push_back(row);
  }
  return rows;
}

Json scene_as_json(const SceneResult& scene, const std::vector<SplatSetting>& settings) {
  const IndirectTruth& truth = scene.bench->truth();
  Json curves = Json::array(), memory = Json::array();
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const SplatMeasure& measure = scene.measures[i];
    Json curve = {{"setting", measure.setting}, {"points", Json::array()}};
    for (const SplatPoint& point : measure.points) curve["points"].push_back(point_as_json(point));
    curves.push_back(curve);
    if (measure.memory.photons > 0) memory.push_back(memory_as_json(settings[i], measure.memory));
  }
  return {{"scene", scene.name},
          {"pixels", truth.pixels()},
          {"exposure", truth.exposure()},
          {"truth",
           {{"samples", truth.samples()},
            {"seconds", truth.seconds()},
            {"mean", truth.mean()},
            {"noise_rmse8", truth.noise_rmse8()},
            {"noise_relMSE", truth.noise_rel_mse()}}},
          {"curves", curves},
          {"equal_error", equal_errors_as_json(scene)},
          {"memory", memory}};
}

std::string as_csv(const std::vector<SceneResult>& scenes) {
  std::string csv = "scene,setting,photons,frames,k,time_ms,rmse8,relMSE,energy,factor\n";
  for (const SceneResult& scene : scenes)
    for (const SplatMeasure& measure : scene.measures)
      for (const SplatPoint& point : measure.points) {
        char numbers[256];
        std::snprintf(numbers, sizeof numbers, ",%d,%d,%d,%.6g,%.6g,%.6g,%.6g,%.6g\n", point.photons, point.frames,
                      point.k, point.time_ms, point.error.rmse8, point.error.rel_mse, point.error.energy,
                      point.error.factor);
        csv += scene.name + "," + measure.setting + numbers;
      }
  return csv;
}

// A row of plots for each measure of error, with a plot a scene.
std::string as_svg(const std::vector<SceneResult>& scenes) {
  std::vector<Plot> plots;
  for (const bool relative : {false, true})
    for (const SceneResult& scene : scenes) {
      Plot plot{scene.name, "ms", relative ? "relMSE" : "RMSE, 8 bits", {}};
      for (const SplatMeasure& measure : scene.measures) {
        PlotCurve& curve = plot.curves.emplace_back(PlotCurve{measure.setting, {}});
        for (const SplatPoint& point : measure.points)
          curve.points.emplace_back(point.time_ms, relative ? point.error.rel_mse : point.error.rmse8);
      }
      plots.push_back(plot);
    }
  return plots_as_svg(plots, std::max(1, static_cast<int>(scenes.size())));
}

void write_text(const std::string& path, const std::string& text) {
  write_file_atomically(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void bench_photon_splatting(const Arguments& arguments) {
  const SplatBenchArguments parsed = parse(arguments);
  const std::vector<SplatSetting> settings = choose_settings(arguments.settings);
  std::vector<std::string> left_out;
  const std::vector<SplatScene> chosen = choose_scenes(arguments, left_out);
  for (const std::string& path : {arguments.csv, arguments.svg})
    if (!path.empty()) check_writable(path);
  Device device({parsed.device, parsed.validation});
  std::vector<SceneResult> scenes;
  Progress progress(kSplattingTechnique);
  const auto all = static_cast<float>(chosen.size() * (settings.size() + 1));
  int done = 0;
  for (const SplatScene& scene : chosen) {
    scenes.push_back({scene.name, std::make_unique<SplatBench>(parsed, scene, device), {}});
    progress.update(static_cast<float>(++done) / all);
    for (const SplatSetting& setting : settings) {
      scenes.back().measures.push_back(scenes.back().bench->measure(setting));
      progress.update(static_cast<float>(++done) / all);
    }
  }
  if (!device.validation_messages().empty())
    throw InputError("--validation",
                     std::to_string(device.validation_messages().size()) + " messages of the validation layer");

  if (!arguments.csv.empty()) write_text(arguments.csv, as_csv(scenes));
  if (!arguments.svg.empty()) write_text(arguments.svg, as_svg(scenes));
  Json json = {{"device", device.summary().name}, {"driver", device.summary().driver}, {"size", arguments.size},
               {"bounces", parsed.bounces},       {"scenes", Json::array()},           {"left_out", left_out}};
  for (const SceneResult& scene : scenes) json["scenes"].push_back(scene_as_json(scene, settings));
  if (arguments.json)
    std::printf("%s\n", json.dump(2).c_str());
  else
    for (const Json& scene : json["scenes"]) print_splat_scene(scene);
}

}  // namespace

void add_bench_photon_splatting_command(CLI::App& bench) {
  CLI::App* command = bench.add_subcommand(
      kSplattingTechnique, "Error over time and memory of the published settings of photon splatting, and of ours");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("--scenes", arguments->scenes, "Of cornell-spot and conference, by comma (both)");
  command->add_option("--conference", arguments->conference,
                      "File of the conference room, in units of 3 mm; it is left out without");
  command
      ->add_option("--setting", arguments->settings,
                   "One of " + join(splat_setting_names()) + "; may be repeated (all)")
      ->allow_extra_args(false);
  command->add_option("--size", arguments->size, "WIDTHxHEIGHT in pixels (320x180; published: 1600x900)");
  command->add_option("--bounces", arguments->bounces, "Bounces of light, at most, in all pictures (1, as published)");
  command->add_option("--frames", arguments->frames, "Frames whose mean `best` makes (16)");
  command->add_option("--samples", arguments->samples, "Paths a pixel of the path tracer, the truth (256)");
  command->add_option("--photons-scale", arguments->photons_scale, "Factor on all numbers of photons (1)");
  command->add_option("--csv", arguments->csv, "Write all curves to this file: a line a point");
  command->add_option("--svg", arguments->svg, "Draw all curves into this file");
  command->add_option("--device", arguments->device, "best, cpu, a part of a device's name or its number (best)");
  command->add_flag("--validation", arguments->validation, "Check every Vulkan call; any message is an error");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->footer("");  // not that of `bench`
  command->callback([arguments, command, &bench] {
    refuse_options_of_bench(bench, *command);
    bench_photon_splatting(*arguments);
  });
}

}  // namespace lightwell
