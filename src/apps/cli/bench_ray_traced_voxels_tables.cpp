#include "apps/cli/bench_ray_traced_voxels_tables.h"

#include <algorithm>
#include <functional>

#include "core/join.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

constexpr const char* kFirstRow = "the first row";

using Cells = std::vector<VoxelCell>;

// Every cell with every value, the values changing faster.
template <typename List, typename Member>
Cells over(const Cells& cells, const List& values, Member VoxelCell::*member) {
  Cells all;
  for (const VoxelCell& cell : cells)
    for (const auto& value : values) {
      all.push_back(cell);
      all.back().*member = value;
    }
  return all;
}

Cells over_light_grid_and_rays(const VoxelCell& start, const VoxelAxes& axes) {
  const Cells lights = over({start}, kPublishedLights, &VoxelCell::light);
  return over(over(lights, axes.grids, &VoxelCell::grid), axes.rays, &VoxelCell::rays);
}

using BaseOf = std::function<VoxelCell(const VoxelCell&)>;
using PublishedOf = std::function<std::optional<VoxelTimes>(const VoxelCell&)>;

// `published_base`: what was published for bases.
std::vector<VoxelRow> make_rows(const Cells& cells, const BaseOf& base_of, const PublishedOf& published,
                                const PublishedOf& published_base) {
  std::vector<VoxelRow> rows;
  for (const VoxelCell& cell : cells) {
    const VoxelCell base = base_of(cell);
    rows.push_back({cell, base, published(cell), published_base(base)});
  }
  return rows;
}

BaseOf first_of(const Cells& cells) {
  return [first = cells.front()](const VoxelCell&) { return first; };
}

std::optional<VoxelTimes> unpublished(const VoxelCell&) {
  return std::nullopt;
}

PublishedOf writes(const std::string& table) {
  return [table](const VoxelCell& cell) { return published_writes(table, cell.light, cell.grid, cell.rays); };
}

VoxelTable scenes_table(const VoxelAxes&) {
  const Cells cells = over({VoxelCell{}}, kPublishedScenes, &VoxelCell::scene);
  const auto published = [](const VoxelCell& cell) { return published_scene(cell.scene); };
  return {"5.1", "Two scenes", kFirstRow, make_rows(cells, first_of(cells), published, published)};
}

VoxelTable output_table(const VoxelAxes& axes) {
  const Cells sizes = over({VoxelCell{.scene = "sponza"}}, kPublishedSizes, &VoxelCell::size);
  const Cells cells = over(over(sizes, axes.grids, &VoxelCell::grid), axes.rays, &VoxelCell::rays);
  const auto published = [](const VoxelCell& cell) { return published_output(cell.size, cell.grid, cell.rays); };
  return {"7.1", "Size of the output", kFirstRow, make_rows(cells, first_of(cells), published, published)};
}

VoxelTable no_writer_table(const VoxelAxes& axes) {
  const Cells cells = over_light_grid_and_rays({.writer = "none"}, axes);
  return {"7.2", "Writes that nothing synchronises", kFirstRow,
          make_rows(cells, first_of(cells), writes("7.2"), writes("7.2"))};
}

VoxelTable writer_table(const std::string& name, const std::string& title, const std::string& writer,
                        const VoxelAxes& axes) {
  const auto base = [](VoxelCell cell) {
    cell.writer = "none";
    return cell;
  };
  return {name, title, "the same row of 7.2",
          make_rows(over_light_grid_and_rays({.writer = writer}, axes), base, writes(name), writes("7.2"))};
}

VoxelTable no_secondaries_table(const VoxelAxes& axes) {
  const Cells cells = over_light_grid_and_rays({}, axes);
  return {"7.5", "No secondary rays", kFirstRow, make_rows(cells, first_of(cells), writes("7.5"), writes("7.5"))};
}

VoxelTable secondaries_table(const VoxelAxes& axes) {
  const auto base = [](VoxelCell cell) {
    cell.secondaries = 0;
    return cell;
  };
  return {"7.6", "One mirrored secondary ray", "the same row of 7.5",
          make_rows(over_light_grid_and_rays({.secondaries = 1}, axes), base, writes("7.6"), writes("7.5"))};
}

VoxelTable taps_table(const VoxelAxes& axes) {
  const Cells sizes = over(over({VoxelCell{}}, kPublishedTaps, &VoxelCell::taps), kPublishedSizes, &VoxelCell::size);
  const Cells cells = over(sizes, axes.grids, &VoxelCell::grid);
  const auto base = [first = cells.front()](VoxelCell cell) {
    if (cell.taps == first.taps) return first;
    cell.taps = first.taps;
    return cell;
  };
  const auto published = [](const VoxelCell& cell) { return published_taps(cell.taps, cell.size, cell.grid); };
  return {"7.7", "Taps of the final pass", "one tap: the first row; 7 taps: the same row with one",
          make_rows(cells, base, published, published)};
}

VoxelTable trace_table(const VoxelAxes& axes) {
  const std::vector<std::string> ways = {"triangles", "voxels"};
  const auto base = [](VoxelCell cell) {
    cell.trace = "triangles";
    return cell;
  };
  const Cells cells = over(over_light_grid_and_rays({}, axes), ways, &VoxelCell::trace);
  return {"trace", "Triangles against voxels", "the same row with triangles",
          make_rows(cells, base, unpublished, unpublished)};
}

VoxelTable presets_table(const VoxelAxes&) {
  const Cells presets = over(over({VoxelCell{}}, kPublishedScenes, &VoxelCell::scene),
                             std::vector<std::string>{"paper", "best"}, &VoxelCell::preset);
  const Cells cells = over(presets, std::vector<std::string>{"light", "camera"}, &VoxelCell::inject);
  const auto base = [](const VoxelCell& cell) { return VoxelCell{.scene = cell.scene}; };
  return {"presets", "Both presets", "the same scene by paper from the light",
          make_rows(cells, base, unpublished, unpublished)};
}

struct Maker {
  std::string name;
  std::function<VoxelTable(const VoxelAxes&)> make;
};

Maker writer_maker(const std::string& name, const std::string& title, const std::string& writer) {
  return {name, [=](const VoxelAxes& axes) { return writer_table(name, title, writer, axes); }};
}

const std::vector<Maker>& makers() {
  static const std::vector<Maker> all = {{"5.1", scenes_table},
                                         {"7.1", output_table},
                                         {"7.2", no_writer_table},
                                         writer_maker("7.3", "Atomic moving average", "average"),
                                         writer_maker("7.4", "Atomic maximum", "maximum"),
                                         writer_maker("exact", "Exact average", "exact"),
                                         {"7.5", no_secondaries_table},
                                         {"7.6", secondaries_table},
                                         {"7.7", taps_table},
                                         {"trace", trace_table},
                                         {"presets", presets_table}};
  return all;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> technique_options(const VoxelCell& cell) {
  if (cell.preset != "paper") return {{"inject", cell.inject}};
  return {{"inject", cell.inject},
          {"writer", cell.writer},
          {"trace", cell.trace},
          {"secondaries", std::to_string(cell.secondaries)},
          {"taps", std::to_string(cell.taps)}};
}

std::vector<std::string> voxel_table_names() {
  std::vector<std::string> names;
  for (const Maker& maker : makers()) names.push_back(maker.name);
  return names;
}

VoxelTable make_voxel_table(const std::string& name, const VoxelAxes& axes, const std::vector<std::string>& presets) {
  const auto maker = std::find_if(makers().begin(), makers().end(), [&](const Maker& m) { return m.name == name; });
  if (maker == makers().end())
    throw InputError("--table", "'" + name + "' (there are: " + join(voxel_table_names()) + ")");
  VoxelTable table = maker->make(axes);
  std::erase_if(table.rows, [&](const VoxelRow& row) {
    return std::find(presets.begin(), presets.end(), row.cell.preset) == presets.end();
  });
  return table;
}

}  // namespace lightwell
