#include "passes/sampled_lights/sampled_lights.h"

#include <algorithm>
#include <string>

#include "graph/linear_dispatch.h"
#include "kernels/passes/sampled_lights/accumulate_light.comp.h"
#include "kernels/passes/sampled_lights/filter_light.comp.h"
#include "kernels/passes/sampled_lights/light_variance.comp.h"
#include "kernels/passes/sampled_lights/sample_lights.comp.h"
#include "passes/camera/camera.h"
#include "passes/sampled_lights/accumulate_light_params.h"
#include "passes/sampled_lights/emitter_table.h"
#include "passes/sampled_lights/filter_light_params.h"
#include "passes/sampled_lights/sample_lights_params.h"

namespace lightwell {
namespace {

// Samples of each kind a pixel, without change, after which a frame is steady. Of an edge of shadow 64 stratified
// points leave an error of about 64^-3/4 = 4 % of its contrast, of smooth light much less, and the film averages on.
constexpr std::uint32_t kSteadySamples = 64;

// Frames that a history counts for while light or geometry changes: it lags by as many.
constexpr float kMostFramesInChange = 8.0f;

// For so many frames after a change every frame counts more than the ones before: the changed past fades to
// (8 9 10 11) / (24 25 26 27) = 2 %, and with the mean that follows to 0.5 % after 64 frames.
constexpr std::uint32_t kFadingFrames = 16;
constexpr float kEagernessWhileFading = 4.0f;

constexpr float kUnlimitedFrames = 1e6f;

// Pixels between the taps of the filter's rounds, along the diagonals and along the axes by turns.
constexpr int kFilterSteps[] = {1, 1, 2, 2};

// The mean of sampled light without most of its noise, W/m^2.
ImageHandle filter_light(FrameGraph& graph, const GBuffer& gbuffer, ImageHandle mean, ImageHandle surface,
                         float pixel_tangent) {
  const ImageDesc desc{.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT};
  glsl::FilterLightParams params{{gbuffer.width, gbuffer.height}, pixel_tangent, 0, 0};
  ImageHandle filtered = graph.create_image("light estimate", desc);
  graph.compute("light variance", kernels::sampled_lights_light_variance_comp)
      .read("position", gbuffer.position)
      .read("normal", gbuffer.normal)
      .read("light", mean)
      .read("surface", surface)
      .write("estimate", filtered)
      .push(params)
      .dispatch_threads(gbuffer.width, gbuffer.height);
  for (const int step : kFilterSteps) {
    params.step = step;
    params.diagonal = 1 - params.diagonal;
    ImageHandle target = graph.create_image("filtered light", desc);
    graph.compute("filter light", kernels::sampled_lights_filter_light_comp)
        .read("position", gbuffer.position)
        .read("normal", gbuffer.normal)
        .read("source", filtered)
        .write("target", target)
        .push(params)
        .dispatch_threads(gbuffer.width, gbuffer.height);
    filtered = target;
  }
  return filtered;
}

}  // namespace

struct SampledLights::State {
  EmitterTable emitters;
  SceneRevisions revisions;         // of the scene in the last frame
  glm::mat4 view{0.0f};             // of the last frame
  std::uint32_t steady_frames = 0;  // since the scene or the camera changed
  std::uint32_t still_frames = 0;   // since the scene changed; kFadingFrames + 1 where its past does not matter
  bool odd = false;                 // which set of histories the last frame wrote

  // Counts what happened since the last frame.
  void note_changes(const GpuScene::Frame& scene, const glsl::GpuCamera& camera, bool reset);
  // How the next frame and the mean of those before come together.
  void weigh_history(glsl::AccumulateLightParams& params) const;
};

void SampledLights::State::note_changes(const GpuScene::Frame& scene, const glsl::GpuCamera& camera, bool reset) {
  const bool changed = !reset && surfaces_changed(revisions, scene.revisions);
  const bool moved = camera.steady_view_projection != view;
  steady_frames = reset || changed || moved ? 0 : steady_frames + 1;
  still_frames = changed ? 0 : reset ? kFadingFrames + 1 : std::min(still_frames + 1, kFadingFrames + 1);
  revisions = scene.revisions;
  view = camera.steady_view_projection;
}

void SampledLights::State::weigh_history(glsl::AccumulateLightParams& params) const {
  params.most_frames = still_frames == 0               ? kMostFramesInChange
                       : still_frames == kFadingFrames ? static_cast<float>(kFadingFrames)
                                                       : kUnlimitedFrames;
  params.eagerness = still_frames > 0 && still_frames < kFadingFrames ? kEagernessWhileFading : 1.0f;
}

SampledLights::SampledLights() : state_(std::make_unique<State>()) {}
SampledLights::~SampledLights() = default;

bool SampledLights::has_light(std::uint32_t emissive_triangle_count, const GpuEnvironment& environment,
                              const Settings& settings) {
  return settings.samples > 0 && ((settings.emitters && emissive_triangle_count > 0) || !environment.is_black());
}

SampledLights::Frame SampledLights::record(FrameGraph& graph, const GBuffer& gbuffer, const GpuScene::Frame& scene,
                                           const Tracer::Frame& tracer, GpuEnvironment& environment,
                                           ImageHandle environment_map, const glsl::GpuCamera& camera,
                                           const Settings& settings, bool reset, std::uint64_t frame_index) {
  State& state = *state_;
  const bool has_emitters = settings.emitters && scene.emissive_triangle_count > 0;
  if (!has_light(scene.emissive_triangle_count, environment, settings)) return {};
  const auto image = [&](const char* name, VkFormat format) {
    return graph.create_image(name, {.width = gbuffer.width, .height = gbuffer.height, .format = format});
  };
  state.note_changes(scene, camera, reset);
  const EmitterTable::Frame emitters = state.emitters.record(graph, scene);
  const BufferHandle environment_table = environment.record_table(graph);

  Frame frame;
  frame.sampled = image("sampled light", VK_FORMAT_R32G32B32A32_SFLOAT);
  const float pixel_tangent = 2.0f * camera.tan_half_y / static_cast<float>(gbuffer.height);
  trace_compute(graph, "sample lights", kernels::sampled_lights_sample_lights_comp, scene, tracer)
      .read("position", gbuffer.position)
      .read("normal", gbuffer.normal)
      .read("face", gbuffer.face)
      .read("environment", environment_map)
      .read("emitters", emitters.emitters)
      .read("groups", emitters.groups)
      .read("environment_table", environment_table)
      .write("irradiance", frame.sampled)
      .constant("kEmitters", has_emitters ? 1 : 0)
      .constant("kEmittersLookUp", emitters.look_up ? 1 : 0)
      .constant("kEnvironment", environment.is_black()            ? glsl::kEnvironmentBlack
                                : environment.constant_radiance() ? glsl::kEnvironmentConstant
                                                                  : glsl::kEnvironmentMap)
      .push(glsl::SampleLightsParams{{gbuffer.width, gbuffer.height},
                                     environment.table_size(),
                                     scene.emissive_triangle_count,
                                     settings.samples,
                                     static_cast<std::uint32_t>(frame_index) * settings.samples,
                                     pixel_clearance(camera)})
      .dispatch_threads(gbuffer.width, gbuffer.height);

  // Histories lie in two sets by turns: a pixel reads where its surface was, and writes where it is.
  state.odd = !state.odd;
  const std::string now = state.odd ? "odd" : "even";
  const std::string last = state.odd ? "even" : "odd";
  bool fresh[4];
  const auto history = [&](const std::string& name, VkFormat format, bool& is_fresh) {
    return graph.history_image(name, {.width = gbuffer.width, .height = gbuffer.height, .format = format}, is_fresh);
  };
  const ImageHandle last_light = history("sampled light " + last, VK_FORMAT_R32G32B32A32_SFLOAT, fresh[0]);
  const ImageHandle last_surface = history("sampled light surface " + last, VK_FORMAT_R32G32B32A32_UINT, fresh[1]);
  frame.mean = history("sampled light " + now, VK_FORMAT_R32G32B32A32_SFLOAT, fresh[2]);
  ImageHandle surface = history("sampled light surface " + now, VK_FORMAT_R32G32B32A32_UINT, fresh[3]);
  glsl::AccumulateLightParams params{.size = {gbuffer.width, gbuffer.height},
                                     .fresh = reset || fresh[0] || fresh[1] ? 1u : 0u,
                                     .camera_position = camera.position,
                                     .pixel_tangent = pixel_tangent};
  state.weigh_history(params);
  graph.compute("accumulate light", kernels::sampled_lights_accumulate_light_comp)
      .read("sampled", frame.sampled)
      .read("position", gbuffer.position)
      .read("normal", gbuffer.normal)
      .read("face", gbuffer.face)
      .read("motion", gbuffer.motion)
      .read("last_light", last_light)
      .read("last_surface", last_surface)
      .write("light", frame.mean)
      .write("surface", surface)
      .push(params)
      .dispatch_threads(gbuffer.width, gbuffer.height);
  frame.steady = (state.steady_frames + 1) * settings.samples >= kSteadySamples;
  frame.irradiance = settings.filter ? filter_light(graph, gbuffer, frame.mean, surface, pixel_tangent) : frame.mean;
  return frame;
}

}  // namespace lightwell
