// Times cells of the tables of ray-traced voxels.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "apps/cli/bench_frames.h"
#include "apps/cli/bench_ray_traced_voxels_tables.h"
#include "lightwell/scene.h"

namespace lightwell {

constexpr const char* kVoxelTechnique = "ray-traced-voxels";

struct VoxelBenchSettings {
  std::string sponza, sponza_scale, sibenik;  // files; "": a built-in scene stands in
  float size_scale = 1.0f, rays_scale = 1.0f;
  int frames = 1, warm_up = 1;  // between them: from nothing to where times are steady
  std::string device;
  bool validation = false;
};

// Each stage in the frame where it took the device least: voxelising in one that voxelises, the others a while
// after the start.
struct MeasuredCell {
  VoxelTimes ms;  // as published: to voxelise, to inject, of the final pass
  // Parts of the injection by `paper`: rays, the writer's work on their hits, and on every voxel (clear, resolve).
  double trace_ms = 0.0, write_ms = 0.0, clear_ms = 0.0;
  double other_ms = 0.0;          // all other passes
  nlohmann::ordered_json rounds;  // what bench_as_json() says of each
};

class VoxelBench {
 public:
  explicit VoxelBench(const VoxelBenchSettings& settings) : settings_(settings) {}

  // A file, or the built-in scene that stands in.
  std::string scene_of(const VoxelCell& cell) const;
  bool stands_in(const VoxelCell& cell) const;
  std::string size_of(const VoxelCell& cell) const;
  int rays_of(const VoxelCell& cell) const;

  // Times all cells, one after the other, in rounds, so that what slows the machine for a while slows none of them
  // alone. Throws InputError, where a scene cannot be read before anything is timed.
  void measure(const std::set<VoxelCell>& cells, int rounds);

  // Of a cell that was measured.
  const MeasuredCell& result(const VoxelCell& cell) const { return measured_.at(cell); }

 private:
  const Scene& load(const VoxelCell& cell);  // once, under the cell's light
  BenchResult run(const VoxelCell& cell);

  VoxelBenchSettings settings_;
  std::map<std::pair<std::string, std::string>, std::unique_ptr<Scene>> scenes_;  // by scene and light
  std::map<VoxelCell, MeasuredCell> measured_;
};

}  // namespace lightwell
