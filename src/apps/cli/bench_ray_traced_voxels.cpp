#include "apps/cli/bench_ray_traced_voxels.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/bench_frames.h"
#include "apps/cli/bench_ray_traced_voxels_measure.h"
#include "apps/cli/bench_ray_traced_voxels_tables.h"
#include "apps/cli/bench_tables.h"
#include "apps/cli/render_methods.h"
#include "apps/cli/text.h"
#include "core/join.h"
#include "core/log.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> kColumns = {"voxelise", "inject", "final"};
constexpr int kMaximumGrid = 256, kMaximumRays = 2048;

struct Arguments {
  std::vector<std::string> tables;   // empty: all
  std::vector<std::string> presets;  // empty: all
  bool full = false;
  std::string grids, rays, size_scale, rays_scale;  // "": as `full` says
  std::string sponza, sponza_scale = "0.01", sibenik;
  std::string frames = "3", warm_up = "1", rounds = "1";
  std::string device;
  bool validation = false;
  bool json = false;
};

std::string or_else(const std::string& given, const std::string& otherwise) {
  return given.empty() ? otherwise : given;
}

std::vector<int> parse_list(const char* option, const std::string& text, int most) {
  std::vector<int> values;
  for (const std::string& number : split(text, ',')) values.push_back(parse_integer(option, number, 1, most));
  return values;
}

VoxelAxes parse_axes(const Arguments& arguments) {
  const bool full = arguments.full;
  return {parse_list("--grids", or_else(arguments.grids, full ? "64,128,256" : "64,128"), kMaximumGrid),
          parse_list("--rays", or_else(arguments.rays, full ? "256,512,1024,2048" : "256,512"), kMaximumRays)};
}

VoxelBenchSettings parse_settings(const Arguments& arguments) {
  const auto scale = [&](const char* option, const std::string& given) {
    return parse_number(option, or_else(given, arguments.full ? "1" : "0.25"), 1e-3f, 1.0f);
  };
  return {.sponza = arguments.sponza,
          .sponza_scale = arguments.sponza_scale,
          .sibenik = arguments.sibenik,
          .size_scale = scale("--size-scale", arguments.size_scale),
          .rays_scale = scale("--rays-scale", arguments.rays_scale),
          .frames = parse_integer("--frames", arguments.frames, 1, kMaximumBenchFrames),
          .warm_up = parse_integer("--warm-up", arguments.warm_up, 0, kMaximumBenchFrames),
          .device = arguments.device,
          .validation = arguments.validation};
}

std::vector<std::string> choose_presets(const Arguments& arguments) {
  const std::vector<RenderMethod> methods = make_render_methods();
  const RenderMethod& method = find_render_method(methods, kVoxelTechnique);
  if (arguments.presets.empty()) return method.presets;
  for (const std::string& preset : arguments.presets) find_preset(method, preset);
  return arguments.presets;
}

// In the order that they were asked for; without being asked, those that have rows.
std::vector<VoxelTable> choose_tables(const Arguments& arguments) {
  const VoxelAxes axes = parse_axes(arguments);
  const std::vector<std::string> presets = choose_presets(arguments);
  std::vector<VoxelTable> tables;
  for (const std::string& name : arguments.tables.empty() ? voxel_table_names() : arguments.tables) {
    VoxelTable table = make_voxel_table(name, axes, presets);
    if (!table.rows.empty())
      tables.push_back(std::move(table));
    else if (!arguments.tables.empty())
      throw InputError("--table", "'" + name + "' has no row of preset " + join(presets));
  }
  return tables;
}

Json times_as_json(const VoxelTimes& times) {
  Json json;
  for (std::size_t i = 0; i < times.size(); ++i) json[kColumns[i]] = times[i];
  return json;
}

// null where the base took no time.
Json ratio(double time, double base) {
  return base > 0.0 ? Json(time / base) : Json(nullptr);
}

Json ratios(const VoxelTimes& times, const VoxelTimes& base) {
  Json json;
  for (std::size_t i = 0; i < times.size(); ++i) json[kColumns[i]] = ratio(times[i], base[i]);
  return json;
}

// What tells one row from another, as text.
Json properties(const VoxelBench& bench, const VoxelCell& cell) {
  Json json = {{"scene", bench.stands_in(cell) ? bench.scene_of(cell) : cell.scene},
               {"light", cell.light},
               {"size", bench.size_of(cell)},
               {"preset", cell.preset},
               {"grid", std::to_string(cell.grid)}};
  if (cell.preset == "paper") json["rays"] = std::to_string(bench.rays_of(cell));
  for (const auto& [name, value] : technique_options(cell)) json[name] = value;
  return json;
}

Json row_as_json(const VoxelBench& bench, const VoxelRow& row) {
  const MeasuredCell& measured = bench.result(row.cell);
  Json json = {{"settings", properties(bench, row.cell)}, {"base", properties(bench, row.base)}};
  const MeasuredCell& base = bench.result(row.base);
  json["ms"] = times_as_json(measured.ms);
  json["other_ms"] = measured.other_ms;
  json["ratio"] = ratios(measured.ms, base.ms);
  if (row.cell.preset == "paper")
    json["inject_parts"] = {{"trace_ms", measured.trace_ms},
                            {"write_ms", measured.write_ms},
                            {"write_ratio", ratio(measured.write_ms, base.write_ms)},
                            {"clear_ms", measured.clear_ms}};
  if (row.published)
    json["published"] = {{"scene", row.cell.scene},
                         {"size", row.cell.size},
                         {"rays", row.cell.rays},
                         {"ms", times_as_json(*row.published)},
                         {"ratio", ratios(*row.published, row.published_base.value())}};
  json["rounds"] = measured.rounds;
  return json;
}

std::string setting(const Json& row, const std::string& name) {
  const Json& settings = row["settings"];
  return settings.contains(name) ? settings[name].get<std::string>() : "-";
}

// Names of the settings that are not the same in all rows, or of those that are.
std::vector<std::string> setting_names(const Json& rows, bool varying) {
  std::vector<std::string> names;
  for (const Json& row : rows)
    for (const auto& [name, value] : row["settings"].items())
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  std::erase_if(names, [&](const std::string& name) {
    return varying == std::all_of(rows.begin(), rows.end(),
                                  [&](const Json& row) { return setting(row, name) == setting(rows[0], name); });
  });
  return names;
}

Json table_as_json(const VoxelBench& bench, const VoxelTable& table) {
  Json rows = Json::array();
  for (const VoxelRow& row : table.rows) rows.push_back(row_as_json(bench, row));
  return {{"table", table.name},
          {"title", table.title},
          {"ratios_to", table.base},
          {"same", setting_names(rows, false)},
          {"varying", setting_names(rows, true)},
          {"rows", rows}};
}

void print_number(const Json& number, int width, int digits) {
  if (number.is_number())
    std::printf(" %*.*f", width, digits, number.get<double>());
  else
    std::printf(" %*s", width, "-");
}

void print_table(const Json& table) {
  const Json& rows = table["rows"];
  const bool published = rows[0].contains("published");
  std::printf("%s  %s; ratios to %s%s\n ", table["table"].get<std::string>().c_str(),
              table["title"].get<std::string>().c_str(), table["ratios_to"].get<std::string>().c_str(),
              published ? ", beside the published (RTX 2070 Super)" : "");
  for (const std::string name : table["same"]) std::printf(" %s %s", name.c_str(), setting(rows[0], name).c_str());
  std::printf("\n");
  const auto names = table["varying"].get<std::vector<std::string>>();
  for (const std::string& name : names) std::printf("%-13s", name.c_str());
  for (const char* column : kColumns) std::printf(" | %8s, ms   ratio   publ.", column);
  std::printf(" | rays, ms | write, ms   ratio | clear, ms | other, ms\n");
  for (const Json& row : rows) {
    const Json theirs = row.value("published", Json::object()).value("ratio", Json::object());
    const Json parts = row.value("inject_parts", Json::object());
    for (const std::string& name : names) std::printf("%-13s", setting(row, name).c_str());
    for (const char* column : kColumns) {
      std::printf(" |");
      print_number(row["ms"][column], 12, 3);
      print_number(row["ratio"][column], 7, 2);
      print_number(theirs.value(column, Json()), 7, 2);
    }
    std::printf(" |");
    print_number(parts.value("trace_ms", Json()), 8, 3);
    std::printf(" |");
    print_number(parts.value("write_ms", Json()), 9, 3);
    print_number(parts.value("write_ratio", Json()), 7, 2);
    std::printf(" |");
    print_number(parts.value("clear_ms", Json()), 9, 3);
    std::printf(" |");
    print_number(row["other_ms"], 9, 3);
    std::printf("\n");
  }
  std::printf("\n");
}

void bench_ray_traced_voxels(const Arguments& arguments) {
  const VoxelBenchSettings settings = parse_settings(arguments);
  const int rounds = parse_integer("--rounds", arguments.rounds, 1, kMaximumBenchFrames);
  const std::vector<VoxelTable> tables = choose_tables(arguments);
  VoxelBench bench(settings);
  std::set<VoxelCell> cells;
  std::set<std::string> missing;
  for (const VoxelTable& table : tables)
    for (const VoxelRow& row : table.rows) {
      cells.insert({row.cell, row.base});
      if (bench.stands_in(row.cell) && missing.insert(row.cell.scene).second)
        log_warning("no --" + row.cell.scene + " FILE: " + bench.scene_of(row.cell) + " stands in for it");
    }
  bench.measure(cells, rounds);
  Json measured = Json::array();
  for (const VoxelTable& table : tables) measured.push_back(table_as_json(bench, table));
  if (!arguments.json)
    for (const Json& table : measured) print_table(table);
  else
    std::printf("%s\n", Json({{"published_by", "Magalhaes 2020, RTX 2070 Super"},
                              {"size_scale", settings.size_scale},
                              {"rays_scale", settings.rays_scale},
                              {"tables", measured}})
                            .dump(2)
                            .c_str());
}

}  // namespace

void add_bench_ray_traced_voxels_command(CLI::App& bench) {
  CLI::App* command = bench.add_subcommand(
      kVoxelTechnique, "The tables that were published for ray-traced voxels, measured here, and ours beside them");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("--table", arguments->tables, "One of " + join(voxel_table_names()) + "; may be repeated (all)")
      ->allow_extra_args(false);
  command->add_option("--preset", arguments->presets, "Only rows of paper or of best; may be repeated (both)")
      ->allow_extra_args(false);
  command->add_flag("--full", arguments->full,
                    "All published grids, numbers of rays and sizes: for a GPU. Without, two grids and two numbers of "
                    "rays, and a quarter of the published rays and of the output along each side");
  command->add_option("--grids", arguments->grids, "Voxels along a side, by comma (64,128)");
  command->add_option("--rays", arguments->rays, "Published rays along a side, by comma (256,512)");
  command->add_option("--size-scale", arguments->size_scale, "Factor on published width and height (0.25)");
  command->add_option("--rays-scale", arguments->rays_scale, "Factor on published rays along a side (0.25)");
  command->add_option("--sibenik", arguments->sibenik, "File of Sibenik; cornell-spot stands in for it");
  command->add_option("--sponza", arguments->sponza, "File of Crytek Sponza; room stands in for it");
  command->add_option("--sponza-scale", arguments->sponza_scale, "Unit of that file in metres (0.01)");
  command->add_option("--frames", arguments->frames,
                      "Frames of each setting and round whose times count, after those from nothing (3)");
  command->add_option("--warm-up", arguments->warm_up, "Frames before, not measured: drivers compile in them (1)");
  command->add_option("--rounds", arguments->rounds,
                      "How often all settings have their turn; the least time of each stage counts (1)");
  command->add_option("--device", arguments->device, "best, cpu, a part of a device's name or its number (best)");
  command->add_flag("--validation", arguments->validation, "Check every Vulkan call; any message is an error");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->footer("");  // not that of `bench`
  command->callback([arguments, command, &bench] {
    refuse_options_of_bench(bench, *command);
    bench_ray_traced_voxels(*arguments);
  });
}

}  // namespace lightwell
