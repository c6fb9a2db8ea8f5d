#include "apps/cli/bench_many_light.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/animation_arguments.h"
#include "apps/cli/bench_frames.h"
#include "apps/cli/bench_tables.h"
#include "apps/cli/scene_arguments.h"
#include "apps/cli/technique_arguments.h"
#include "apps/cli/text.h"
#include "core/log.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kMaximumVpls = 1 << 20;  // the technique's own limit is lower, and says so itself

// Published numbers of VPLs, and times for each.
constexpr std::array<int, 3> kPublishedVpls = {512, 1024, 2048};
using Milliseconds = std::array<double, kPublishedVpls.size()>;

// The last takes all other passes, which the thesis leaves out.
const std::vector<Stage> kStages = {{"voxels and octree", {"svo: "}},
                                    {"RSM", {"rsm: "}},
                                    {"VPLs", {"light paths: "}},
                                    {"direct light", {"direct light"}},
                                    {"indirect light", {"many light: ", "light clusters: ", "indirect light "}},
                                    {"all other", {}}};
constexpr std::size_t kIndirect = 4;
constexpr std::size_t kPublishedStages = 5;

// What the thesis measured, on a Titan X.
struct Case {
  const char* name;
  const char* size;
  int resolution;  // cells along the octree's side
  std::array<Milliseconds, kPublishedStages> published;
};
constexpr Case kCornell{
    "cornell-dynamic",
    "768x768",
    128,
    {{{0.57, 0.57, 0.58}, {0.46, 0.46, 0.46}, {0.02, 0.02, 0.02}, {0.17, 0.17, 0.18}, {16, 33, 69}}}};
constexpr Case kSponza{
    "sponza-crytek",
    "1280x720",
    256,
    {{{4.65, 4.65, 4.65}, {0.61, 0.62, 0.62}, {0.02, 0.02, 0.02}, {0.31, 0.31, 0.31}, {19.5, 36.2, 73}}}};

// The one spot light of the thesis' Sponza: its place is not published; here it shines along the nave, onto floor and
// wall.
constexpr const char* kSponzaLight = "spot pos=-6,7,0 dir=0.7,-1,-0.3 intensity=1500 inner=25 outer=40";

struct Arguments {
  std::string sponza;  // "": left out
  std::string sponza_scale = "0.01";
  std::string scenes = "cornell-dynamic,sponza-crytek";
  std::string presets = "paper,best";
  std::string vpls = "512,1024,2048";
  std::string size, size_scale = "1";
  std::string resolution;  // "": the thesis'
  std::string frames = "1", warm_up = "1";
  std::vector<std::string> assignments;
  std::string device;
  bool validation = false;
  bool json = false;
};

std::vector<int> parse_vpls(const std::string& text) {
  std::vector<int> counts;
  for (const std::string& number : split(text, ',')) counts.push_back(parse_integer("--vpls", number, 1, kMaximumVpls));
  return counts;
}

std::string size_of(const Case& scene, const Arguments& arguments) {
  if (!arguments.size.empty()) return arguments.size;
  return scaled_size(scene.size, parse_number("--size-scale", arguments.size_scale, 1e-3f, 16.0f));
}

// Every frame starts from nothing, so that the octree and RSMs are made anew in each, as in the thesis. The Cornell box
// is animated with both of its spot lights; in Sponza the light moves.
BenchResult measure(const Case& scene_case, const std::string& preset, int vpls, const Arguments& arguments) {
  SceneArguments scene_arguments;
  AnimationArguments animation;
  BenchRun run;
  run.frames = parse_integer("--frames", arguments.frames, 1, kMaximumBenchFrames);
  run.warm_up = parse_integer("--warm-up", arguments.warm_up, 0, kMaximumBenchFrames);
  run.cut = BenchCut::kEvery;
  const bool is_sponza = scene_case.name == std::string(kSponza.name);
  scene_arguments.scene = scene_case.name;
  if (is_sponza) {
    scene_arguments.scene = arguments.sponza;
    scene_arguments.scale = arguments.sponza_scale;
    scene_arguments.no_lights = true;
    scene_arguments.lights = {kSponzaLight};
    run.moving_lights = 1;
  }
  TechniqueArguments technique;
  technique.technique = "many-light";
  technique.preset = preset;
  technique.size = size_of(scene_case, arguments);
  technique.device = arguments.device;
  technique.validation = arguments.validation;
  technique.options = {
      {"vpls", std::to_string(vpls)},
      {"resolution", arguments.resolution.empty() ? std::to_string(scene_case.resolution) : arguments.resolution}};
  technique.assignments = arguments.assignments;
  const ChosenTechnique chosen = choose_technique(technique);
  const Scene scene = load_scene(scene_arguments);
  const Playback playback(scene, scene_arguments, {}, animation);
  RenderJob job = make_job(technique, chosen, scene, playback.looped_frame(0));
  if (playback.is_animated()) job.play = [&](int frame) { return playback.looped_frame(frame); };
  return run_frames(job, run, chosen.method.name);
}

std::optional<std::size_t> published_column(int vpls) {
  const auto found = std::find(kPublishedVpls.begin(), kPublishedVpls.end(), vpls);
  if (found == kPublishedVpls.end()) return std::nullopt;
  return static_cast<std::size_t>(found - kPublishedVpls.begin());
}

std::vector<double> published_times(const Case& scene, std::size_t column) {
  std::vector<double> times;
  for (const Milliseconds& stage : scene.published) times.push_back(stage[column]);
  return times;
}

// The machines differ, so that only ratios can be compared: to the sum of the published rows, and of indirect light to
// that of the fewest VPLs.
Json column_as_json(const std::vector<double>& times, double indirect_of_fewest) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kPublishedStages; ++i) sum += times[i];
  Json stages = Json::array();
  for (std::size_t i = 0; i < times.size(); ++i) {
    stages.push_back({{"name", kStages[i].name}, {"ms", times[i]}});
    if (i < kPublishedStages) stages.back()["share"] = sum > 0.0 ? times[i] / sum : 0.0;
  }
  return {{"sum_ms", sum},
          {"indirect_to_first", indirect_of_fewest > 0.0 ? times[kIndirect] / indirect_of_fewest : 0.0},
          {"stages", stages}};
}

Json measure_table(const Case& scene, const std::string& preset, const std::vector<int>& vpls,
                   const Arguments& arguments) {
  Json columns = Json::array();
  double indirect_of_first = 0.0;
  std::optional<double> published_of_first;
  for (const int count : vpls) {
    const BenchResult result = measure(scene, preset, count, arguments);
    const std::vector<double> times = stage_times(fastest_frame(result), kStages);
    if (columns.empty()) indirect_of_first = times[kIndirect];
    Json column = {{"vpls", count}};
    column.update(column_as_json(times, indirect_of_first));
    if (const std::optional<std::size_t> published = published_column(count)) {
      const std::vector<double> theirs = published_times(scene, *published);
      if (!published_of_first) published_of_first = theirs[kIndirect];
      column["published"] = column_as_json(theirs, *published_of_first);
    }
    column["bench"] = bench_as_json(result);
    columns.push_back(column);
  }
  return {{"scene", scene.name},
          {"preset", preset},
          {"size", size_of(scene, arguments)},
          {"resolution", arguments.resolution.empty() ? std::to_string(scene.resolution) : arguments.resolution},
          {"columns", columns}};
}

void print_table(const Json& table) {
  std::printf("%s, preset %s, %s, %s cells a side; ms on this device, share of the sum; published (Titan X)\n",
              table["scene"].get<std::string>().c_str(), table["preset"].get<std::string>().c_str(),
              table["size"].get<std::string>().c_str(), table["resolution"].get<std::string>().c_str());
  std::printf("%-20s", "number of VPLs");
  for (const Json& column : table["columns"]) std::printf(" | %34d", column["vpls"].get<int>());
  const auto print_cell = [](const Json& stage, const char* number) {
    std::printf(number, stage["ms"].get<double>());
    if (stage.contains("share"))
      std::printf(" %5.1f %%", 100.0 * stage["share"].get<double>());
    else
      std::printf("%8s", "");
  };
  for (std::size_t i = 0; i < kStages.size(); ++i) {
    std::printf("\n%-20s", kStages[i].name);
    for (const Json& column : table["columns"]) {
      std::printf(" | ");
      print_cell(column["stages"][i], "%11.2f");
      if (i < kPublishedStages && column.contains("published"))
        print_cell(column["published"]["stages"][i], "%7.2f");
      else
        std::printf("%15s", "");
    }
  }
  std::printf("\n%-20s", "indirect, to first");
  for (const Json& column : table["columns"]) {
    std::printf(" | %11.2f%8s", column["indirect_to_first"].get<double>(), "");
    if (column.contains("published"))
      std::printf("%7.2f%8s", column["published"]["indirect_to_first"].get<double>(), "");
    else
      std::printf("%15s", "");
  }
  std::printf("\n\n");
}

void bench_many_light(const Arguments& arguments) {
  const std::vector<int> vpls = parse_vpls(arguments.vpls);
  Json tables = Json::array(), left_out = Json::array();
  for (const std::string& name : split(arguments.scenes, ',')) {
    const auto cases = {&kCornell, &kSponza};
    const auto scene = std::find_if(cases.begin(), cases.end(), [&](const Case* known) { return known->name == name; });
    if (scene == cases.end())
      throw InputError("--scenes", "'" + name + "' (there are: cornell-dynamic, sponza-crytek)");
    if (*scene == &kSponza && arguments.sponza.empty()) {
      log_warning(name + ": left out, no --sponza FILE");
      left_out.push_back(name);
      continue;
    }
    for (const std::string& preset : split(arguments.presets, ','))
      tables.push_back(measure_table(**scene, preset, vpls, arguments));
  }
  if (arguments.json)
    std::printf("%s\n", Json({{"tables", tables}, {"left_out", left_out}}).dump(2).c_str());
  else
    for (const Json& table : tables) print_table(table);
}

}  // namespace

void add_bench_many_light_command(CLI::App& bench) {
  CLI::App* command = bench.add_subcommand(
      "many-light", "The table of stages and numbers of VPLs that was published for many-light, measured here");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option(
      "--scenes", arguments->scenes,
      "Of cornell-dynamic (768x768, 128 cells) and sponza-crytek (1280x720, 256 cells), by comma (both)");
  command->add_option("--sponza", arguments->sponza, "File of Crytek Sponza; it is left out without");
  command->add_option("--sponza-scale", arguments->sponza_scale, "Unit of that file in metres (0.01)");
  command->add_option("--preset", arguments->presets, "Presets, by comma (paper,best)");
  command->add_option("--vpls", arguments->vpls, "Numbers of VPLs, by comma (512,1024,2048)");
  CLI::Option* size = command->add_option("--size", arguments->size, "WIDTHxHEIGHT of all, instead of the published");
  command->add_option("--size-scale", arguments->size_scale, "Factor on width and height (1)")->excludes(size);
  command->add_option("--resolution", arguments->resolution, "Cells along the octree's side, instead of the published");
  command->add_option("--frames", arguments->frames, "Frames that are measured; the fastest counts (1)");
  command->add_option("--warm-up", arguments->warm_up, "Frames before, not measured: drivers compile in them (1)");
  command->add_option("--set", arguments->assignments, "Set an option of the technique: name=value")
      ->allow_extra_args(false);
  command->add_option("--device", arguments->device, "best, cpu, a part of a device's name or its number (best)");
  command->add_flag("--validation", arguments->validation, "Check every Vulkan call; any message is an error");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->footer("");  // not that of `bench`
  command->callback([arguments, command, &bench] {
    refuse_options_of_bench(bench, *command);
    bench_many_light(*arguments);
  });
}

}  // namespace lightwell
