#include "apps/cli/bench_ray_traced_voxels_measure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "apps/cli/animation_arguments.h"
#include "apps/cli/bench_frames.h"
#include "apps/cli/bench_tables.h"
#include "apps/cli/progress.h"
#include "apps/cli/scene_arguments.h"
#include "apps/cli/technique_arguments.h"

namespace lightwell {

namespace {

// Those of the thesis, with the injection by `paper` in its parts: rays, writes, and what is done to all voxels. Last,
// all that the thesis leaves out. Its final pass draws the scene, too: that is among ours of the last row.
enum StageIndex : std::uint8_t { kVoxelise, kTrace, kWrite, kFinal, kInject, kOther };
const std::vector<Stage> kStages = {{"voxelise", {"ray-traced voxels: voxelise", "voxel faces: ", "voxelize: "}},
                                    {"trace", {"ray-traced voxels: inject: trace"}},
                                    {"write", {"ray-traced voxels: inject: write"}},
                                    {"final",
                                     {"ray-traced voxels: final", "ray-traced voxels: pixels", "light cache: smooth",
                                      "light cache: look-up", "reproject", "indirect light "}},
                                    {"inject", {"ray-traced voxels: ", "light cache: ", "light paths: "}},
                                    {"other", {}}};

// One spot light, as in the thesis, whose places are not published. Far: in the middle of the space. Near: in front of
// a flat floor, so that all rays meet few voxels.
struct Lights {
  const char* far;
  const char* near;
};

// Below the vault of the nave, along it and down; a quarter of a metre above the floor.
constexpr Lights kSibenik = {"spot pos=-5,-8,0 dir=1,-0.3,0 intensity=1000 inner=30 outer=40",
                             "spot pos=-5,-15.06,0 dir=0,-1,0 intensity=1000 inner=30 outer=40"};
constexpr Lights kSponza = {"spot pos=-6,7,0 dir=0.7,-1,-0.3 intensity=1500 inner=30 outer=40",
                            "spot pos=0,0.22,0 dir=0,-1,0 intensity=1500 inner=30 outer=40"};
// Built-in: `cornell-spot` for Sibenik, its own light being the far one, and `room` for Sponza.
constexpr Lights kCornell = {"spot pos=0.278,0.538,0.2796 dir=0,-1,0 intensity=1 inner=30 outer=40",
                             "spot pos=0.278,0.006,0.1 dir=0,-1,0 intensity=1 inner=30 outer=40"};
constexpr Lights kRoom = {"spot pos=4.5,2.5,3.25 dir=1,-0.5,0 intensity=100 inner=30 outer=40",
                          "spot pos=4.5,0.1,3.25 dir=0,-1,0 intensity=100 inner=30 outer=40"};

bool is_sponza(const VoxelCell& cell) {
  return cell.scene == kPublishedScenes[1];
}

// The first frame of a run starts from nothing, and only there preset `best` voxelises what does not move. Nobody has
// asked its voxels for light then; after four frames about as many ask as ever will.
int first_counted_frame(const VoxelCell& cell) {
  return cell.preset == "best" ? 5 : 1;
}

}  // namespace

bool VoxelBench::stands_in(const VoxelCell& cell) const {
  return (is_sponza(cell) ? settings_.sponza : settings_.sibenik).empty();
}

std::string VoxelBench::scene_of(const VoxelCell& cell) const {
  if (stands_in(cell)) return is_sponza(cell) ? "room" : "cornell-spot";
  return is_sponza(cell) ? settings_.sponza : settings_.sibenik;
}

std::string VoxelBench::size_of(const VoxelCell& cell) const {
  return scaled_size(cell.size, settings_.size_scale);
}

int VoxelBench::rays_of(const VoxelCell& cell) const {
  return scaled_side(cell.rays, settings_.rays_scale);
}

const Scene& VoxelBench::load(const VoxelCell& cell) {
  std::unique_ptr<Scene>& scene = scenes_[{cell.scene, cell.light}];
  if (scene) return *scene;
  SceneArguments arguments;
  arguments.scene = scene_of(cell);
  if (is_sponza(cell) && !stands_in(cell)) arguments.scale = settings_.sponza_scale;
  const Lights& lights = stands_in(cell) ? (is_sponza(cell) ? kRoom : kCornell) : is_sponza(cell) ? kSponza : kSibenik;
  arguments.no_lights = true;
  arguments.lights = {cell.light == "near" ? lights.near : lights.far};
  scene = std::make_unique<Scene>(load_scene(arguments));
  return *scene;
}

BenchResult VoxelBench::run(const VoxelCell& cell) {
  TechniqueArguments technique;
  technique.technique = kVoxelTechnique;
  technique.preset = cell.preset;
  technique.size = size_of(cell);
  technique.device = settings_.device;
  technique.validation = settings_.validation;
  for (const auto& [name, value] : technique_options(cell)) technique.options[name] = value;
  technique.options["resolution"] = std::to_string(cell.grid);
  if (cell.preset == "paper") technique.options["rays"] = std::to_string(rays_of(cell));
  const ChosenTechnique chosen = choose_technique(technique);
  const Scene& scene = load(cell);
  SceneArguments scene_arguments;
  scene_arguments.scene = scene_of(cell);
  const Playback playback(scene, scene_arguments, {}, {});
  const RenderJob job = make_job(technique, chosen, scene, playback.frame(0));
  BenchRun frames;
  frames.frames = first_counted_frame(cell) + settings_.frames;
  frames.warm_up = settings_.warm_up;
  frames.cut = BenchCut::kFirst;
  return run_frames(job, frames, chosen.method.name);
}

// Lowers `times` to those of a run: of voxelising in all its frames that voxelise, of the other stages from `first` on.
void keep_least(const BenchResult& result, std::size_t first, std::vector<double>& times) {
  for (std::size_t frame = 0; frame < result.frames.size(); ++frame) {
    const std::vector<double> now = stage_times(result.frames[frame], kStages);
    for (std::size_t stage = 0; stage < times.size(); ++stage) {
      const bool counts = stage == kVoxelise ? now[stage] > 0.0 : frame >= first;
      if (counts) times[stage] = std::min(times[stage], now[stage]);
    }
  }
}

void VoxelBench::measure(const std::set<VoxelCell>& cells, int rounds) {
  for (const VoxelCell& cell : cells) load(cell);
  std::map<VoxelCell, std::vector<double>> least;
  Progress progress(kVoxelTechnique);
  int done = 0;
  for (int round = 0; round < rounds; ++round)
    for (const VoxelCell& cell : cells) {
      const BenchResult result = run(cell);
      const auto first = static_cast<std::size_t>(first_counted_frame(cell));
      keep_least(result, first, least.try_emplace(cell, kStages.size(), INFINITY).first->second);
      measured_[cell].rounds.push_back(bench_as_json(result));
      progress.update(static_cast<float>(++done) / static_cast<float>(rounds * static_cast<int>(cells.size())));
    }
  for (const auto& [cell, times] : least) {
    MeasuredCell& measured = measured_[cell];
    const bool voxelises = std::isfinite(times[kVoxelise]);
    measured.ms = {voxelises ? times[kVoxelise] : 0.0, times[kTrace] + times[kWrite] + times[kInject], times[kFinal]};
    measured.trace_ms = times[kTrace];
    measured.write_ms = times[kWrite];
    measured.clear_ms = times[kInject];
    measured.other_ms = times[kOther];
  }
}

}  // namespace lightwell
