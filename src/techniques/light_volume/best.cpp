#include "techniques/light_volume/best.h"

namespace lightwell {
namespace {

// In a frame before which nothing was known, light is asked for and found so many times: it has bounced twice then.
constexpr int kFirstRounds = 3;

}  // namespace

BufferHandle LightVolumeBestWorld::record_points(FrameGraph& graph, WorldFrame& world, const Points& points) {
  BufferHandle irradiance = cache.record_points(graph, points.points, points.count);
  for (int round = 0; cache.fresh() && round < kFirstRounds; ++round) {
    cache.record_round(graph, world);
    irradiance = cache.record_points(graph, points.points, points.count);
  }
  return irradiance;
}

GiResult LightVolumeBest::record_view(FrameGraph& graph, TechniqueWorld* world, ViewFrame& view) {
  LightCache& cache = static_cast<LightVolumeBestWorld*>(world)->cache;
  ImageHandle irradiance = cache.record_look_up(graph, view);
  for (int round = 0; cache.fresh() && round < kFirstRounds; ++round) {
    cache.record_round(graph, view.world);
    irradiance = cache.record_look_up(graph, view);
  }
  views_ = {{"voxel-direct", cache.record_view(graph, view, false)},
            {"voxel-indirect", cache.record_view(graph, view, true)}};
  return {.irradiance = irradiance, .steady = cache.steady()};
}

}  // namespace lightwell
