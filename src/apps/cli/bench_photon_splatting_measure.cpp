#include "apps/cli/bench_photon_splatting_measure.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "apps/cli/animation_arguments.h"
#include "apps/cli/memory_check.h"
#include "apps/cli/scene_arguments.h"
#include "apps/cli/technique_arguments.h"
#include "lightwell/photon_mapper.h"
#include "lightwell/renderer.h"

namespace lightwell {

namespace {

constexpr int kFixedK = 64;                // of the photon mapper's curve
constexpr int kLeastK = 8, kMostK = 4096;  // between them, by doubling, the k of least RMSE is looked for
constexpr int kTimed = 2;                  // equal frames or pictures: the faster one counts
constexpr int kLeastPhotons = 16;          // that the technique takes

using Prefixes = std::vector<std::string_view>;

// Passes of the technique and of what it filters with.
const Prefixes kOwnPasses = {"photon splatting: ",         "splats: ",  "light paths: ",  "rsm: ",
                             "read back totals of splats", "reproject", "indirect light "};
const Prefixes kMaps = {"photon shadow maps", "accepted texels"};
const Prefixes kTiles = {"bounds of splats", "surfaces of tiles", "splats of parts",
                         "ranges of splats", "lists of splats",   "splats: "};
const Prefixes kPhotons = {"photon splatting: ", "photon starts", "light point",  "light path survivals",
                           "all light point",    "splats",        "merged cells", "bundle begins"};

bool is_one_of(const Prefixes& prefixes, std::string_view name) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](std::string_view prefix) { return name.starts_with(prefix); });
}

double own_time(const RenderStatistics& statistics) {
  double sum = 0.0;
  for (const PassStatistics& pass : statistics.passes)
    if (is_one_of(kOwnPasses, pass.name)) sum += pass.time_ms;
  return sum;
}

SplatMemory memory_of(const RenderStatistics& statistics, int photons) {
  SplatMemory memory{.photons = photons};
  for (const auto& [name, bytes] : statistics.memory_bytes) {
    if (is_one_of(kMaps, name))
      memory.map_bytes += bytes;
    else if (is_one_of(kTiles, name))
      memory.tile_bytes += bytes;
    else if (is_one_of(kPhotons, name))
      memory.photon_bytes += bytes;
    if (name == "splats") memory.splat_bytes = bytes;
  }
  return memory;
}

SceneArguments scene_arguments(const SplatBenchArguments& arguments, const SplatScene& scene) {
  SceneArguments result;
  result.scene = scene.needs_file ? arguments.conference : scene.name;
  result.scale = scene.scale;
  if (!scene.light.empty()) {
    result.no_lights = true;
    result.lights = {scene.light};
  }
  return result;
}

EqualError equal_error(const SplatPoint& mapper, const SplatMeasure& best) {
  constexpr double kLeast = 1e-6;  // of errors whose logarithm is taken
  EqualError equal{.mapper = mapper, .setting = best.setting};
  const auto reached = std::find_if(best.points.begin(), best.points.end(), [&](const SplatPoint& candidate) {
    return candidate.error.rmse8 <= mapper.error.rmse8;
  });
  if (reached == best.points.end()) return equal;
  equal.time_ms = reached->time_ms;
  equal.at_most = reached == best.points.begin();
  if (equal.at_most) return equal;
  const SplatPoint& before = *(reached - 1);
  const auto log_error = [&](const SplatPoint& p) { return std::log(std::max(p.error.rmse8, kLeast)); };
  const double part = (log_error(before) - log_error(mapper)) / (log_error(before) - log_error(*reached));
  equal.time_ms = before.time_ms * std::pow(reached->time_ms / before.time_ms, part);
  return equal;
}

}  // namespace

SplatBench::SplatBench(const SplatBenchArguments& arguments, const SplatScene& scene, Device& device)
    : arguments_(arguments), device_(device), scene_(load_scene(scene_arguments(arguments, scene))) {
  check_photon_mapper_memory(arguments.size);
  check_frame_memory(arguments.size, device);
  moment_ = Playback(scene_, scene_arguments(arguments, scene), {}, {}).frame(0);
  truth_ = std::make_unique<IndirectTruth>(scene_, moment_, arguments.size, arguments.samples, arguments.bounces);
}

int SplatBench::scaled(int photons) const {
  return std::max(kLeastPhotons, static_cast<int>(std::lround(arguments_.photons_scale * static_cast<float>(photons))));
}

SplatMeasure SplatBench::measure(const SplatSetting& setting) const {
  if (setting.curve == SplatCurve::kMapper) return measure_mapper(setting);
  return setting.curve == SplatCurve::kFrame ? measure_frame(setting) : measure_frames(setting);
}

// The best k is looked for from that of the curve on, up and down, as long as the error falls.
SplatMeasure SplatBench::measure_mapper(const SplatSetting& setting) const {
  SplatMeasure measure{.setting = setting.name};
  const PhotonMapper mapper(scene_, moment_.world);
  PhotonMapperOptions options{
      .width = arguments_.size.x, .height = arguments_.size.y, .samples = 1, .max_bounces = arguments_.bounces};
  const auto measure_k = [&](int k) {
    options.k = k;
    SplatPoint point{.photons = options.photons, .k = k, .time_ms = INFINITY, .us_per_query = INFINITY};
    for (int picture = 0; picture < kTimed; ++picture) {
      const PhotonMapping result = mapper.render(moment_.camera, options);
      const PhotonMapperStatistics& statistics = result.statistics;
      const double time_ms = statistics.emission_ms + statistics.tree_ms + statistics.query_ms;
      point.time_ms = std::min(point.time_ms, time_ms);
      point.us_per_query = std::min(point.us_per_query, statistics.us_per_query);
      if (picture == 0) point.error = truth_->judge(result.picture.indirect, false);
    }
    return point;
  };
  for (const int photons : setting.photons) {
    options.photons = scaled(photons);
    const SplatPoint fixed = measure_k(kFixedK);
    SplatPoint best = fixed;
    const auto try_k = [&](int k) {
      const SplatPoint next = measure_k(k);
      const bool better = next.error.rmse8 < best.error.rmse8;
      if (better) best = next;
      return better;
    };
    for (int k = 2 * kFixedK; k <= kMostK && try_k(k);) k *= 2;
    for (int k = kFixedK / 2; k >= kLeastK && try_k(k);) k /= 2;
    measure.points.push_back(fixed);
    measure.best_k.push_back(best);
  }
  PhotonMapperOptions alone{.width = 1, .height = 1, .photons = scaled(setting.memory_photons), .samples = 1};
  alone.max_bounces = arguments_.bounces;
  const PhotonMapperStatistics kept = mapper.render(moment_.camera, alone).statistics;
  const std::uint64_t bytes = kept.photon_bytes + kept.tree_bytes;
  measure.memory = {.photons = kept.photons_kept, .splat_bytes = bytes, .photon_bytes = bytes};
  return measure;
}

RendererOptions SplatBench::options_of(const SplatSetting& setting, int photons) const {
  TechniqueArguments technique;
  technique.technique = kSplattingTechnique;
  technique.preset = setting.preset;
  technique.size = std::to_string(arguments_.size.x) + "x" + std::to_string(arguments_.size.y);
  technique.options = setting.options;
  technique.options.insert({{"photons", std::to_string(scaled(photons))},
                            {"bounces", std::to_string(arguments_.bounces)},
                            {"frames", "1"},
                            {"samples", "1"}});
  const ChosenTechnique chosen = choose_technique(technique);
  return renderer_options(make_job(technique, chosen, scene_, moment_), chosen.method.name);
}

// Frames are alike; the first one is a warm-up, in which drivers compile. Weights give these pictures no unit.
SplatMeasure SplatBench::measure_frame(const SplatSetting& setting) const {
  SplatMeasure measure{.setting = setting.name};
  for (const int photons : setting.photons) {
    Renderer renderer(device_, scene_, moment_.world, options_of(setting, photons));
    SplatPoint point{.photons = scaled(photons), .time_ms = INFINITY};
    Picture picture = renderer.render({&moment_.world, moment_.camera});
    for (int frame = 0; frame < kTimed; ++frame) {
      picture = renderer.render({&moment_.world, moment_.camera});
      point.time_ms = std::min(point.time_ms, own_time(renderer.statistics()));
    }
    point.error = truth_->judge(std::move(picture.indirect), true);
    measure.points.push_back(point);
    if (photons == setting.memory_photons) measure.memory = memory_of(renderer.statistics(), point.photons);
  }
  return measure;
}

// A curve's points are after 1, 2, 4, ... frames and the last one; all frames do the same work, so that each is taken
// to last as long as the fastest. The first frame of all is a warm-up.
SplatMeasure SplatBench::measure_frames(const SplatSetting& setting) const {
  SplatMeasure measure{.setting = setting.name};
  const int photons = setting.photons.back();
  Renderer renderer(device_, scene_, moment_.world, options_of(setting, photons));
  renderer.render({&moment_.world, moment_.camera});
  double frame_ms = INFINITY;
  for (int frame = 1, next = 1; frame <= arguments_.frames; ++frame) {
    Picture picture = renderer.render({.snapshot = &moment_.world, .camera = moment_.camera, .cut = frame == 1});
    frame_ms = std::min(frame_ms, own_time(renderer.statistics()));
    if (frame != next && frame != arguments_.frames) continue;
    next *= 2;
    const IndirectError error = truth_->judge(std::move(picture.indirect), false);
    measure.points.push_back({.photons = scaled(photons), .frames = frame, .error = error});
  }
  for (SplatPoint& point : measure.points) point.time_ms = frame_ms * point.frames;
  measure.memory = memory_of(renderer.statistics(), scaled(photons) * arguments_.bounces);
  return measure;
}

std::vector<EqualError> equal_errors(const SplatMeasure& mapper, const std::vector<const SplatMeasure*>& bests) {
  std::vector<EqualError> result;
  for (const SplatPoint& point : mapper.best_k) {
    EqualError& equal = result.emplace_back(EqualError{.mapper = point});
    for (const SplatMeasure* best : bests) {
      const EqualError next = equal_error(point, *best);
      if (next.time_ms && (!equal.time_ms || *next.time_ms < *equal.time_ms)) equal = next;
    }
  }
  return result;
}

}  // namespace lightwell
