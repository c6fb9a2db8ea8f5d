// Which frames the tables of ray-traced voxels are made of.
#pragma once

#include <compare>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/cli/bench_ray_traced_voxels_published.h"

namespace lightwell {

// One setting that is timed: size and rays as published, before they are scaled.
struct VoxelCell {
  std::string scene = "sibenik", light = "far", size = "1920x1080", preset = "paper", inject = "light";
  int grid = 128;
  // Of preset paper alone.
  int rays = 512;
  std::string writer = "average", trace = "triangles";
  int secondaries = 0, taps = 7;

  auto operator<=>(const VoxelCell&) const = default;
};

// The options of the technique in a cell by their names, without `resolution` and `rays`.
std::vector<std::pair<std::string, std::string>> technique_options(const VoxelCell& cell);

struct VoxelRow {
  VoxelCell cell;
  VoxelCell base;  // what its times are compared to
  std::optional<VoxelTimes> published, published_base;
};

struct VoxelTable {
  std::string name;
  std::string title;
  std::string base;  // in words
  std::vector<VoxelRow> rows;
};

// Which published values are measured.
struct VoxelAxes {
  std::vector<int> grids, rays;
};

// Names of all tables: the published ones, and ours.
std::vector<std::string> voxel_table_names();

// Only rows of these presets; there may be none. Throws InputError where no table has that name.
VoxelTable make_voxel_table(const std::string& name, const VoxelAxes& axes, const std::vector<std::string>& presets);

}  // namespace lightwell
