#include "passes/sampled_lights/sampled_lights.h"

#include <algorithm>

#include "kernels/passes/sampled_lights/sample_lights.comp.h"
#include "passes/camera/camera.h"
#include "passes/noise_filter/noise_filter.h"
#include "passes/sampled_lights/emitter_table.h"
#include "passes/sampled_lights/sample_lights_params.h"

namespace lightwell {
namespace {

// Samples of each kind a pixel, without change, after which a frame is steady. Of an edge of shadow 64 stratified
// points leave an error of about 64^-3/4 = 4 % of its contrast, of smooth light much less, and the film averages on.
constexpr std::uint32_t kSteadySamples = 64;

// Frames that a history counts for while light or geometry changes: it lags by as many.
constexpr float kMostFramesInChange = 8.0f;

// For so many frames after a change every frame counts more than those before it: what was before the change fades to
// (8 9 10 11) / (24 25 26 27) = 2 %, and with the mean that follows to 0.5 % after 64 frames.
constexpr std::uint32_t kFadingFrames = 16;
constexpr float kBlendFactorWhileFading = 4.0f;

}  // namespace

struct SampledLights::State {
  EmitterTable emitters;
  SceneRevisions revisions;         // of the scene in the last frame
  glm::mat4 view{0.0f};             // of the last frame
  std::uint32_t steady_frames = 0;  // since the scene or the camera changed
  std::uint32_t still_frames = 0;   // since the scene changed; kFadingFrames + 1 where its past does not matter

  // Counts what happened since the last frame.
  void note_changes(const GpuScene::Frame& scene, const glsl::GpuCamera& camera, bool reset);
  // How the next frame and the mean of those before come together.
  TemporalBlend blend() const;
};

void SampledLights::State::note_changes(const GpuScene::Frame& scene, const glsl::GpuCamera& camera, bool reset) {
  const bool changed = !reset && surfaces_changed(revisions, scene.revisions);
  const bool moved = camera.steady_view_projection != view;
  steady_frames = reset || changed || moved ? 0 : steady_frames + 1;
  still_frames = changed ? 0 : reset ? kFadingFrames + 1 : std::min(still_frames + 1, kFadingFrames + 1);
  revisions = scene.revisions;
  view = camera.steady_view_projection;
}

TemporalBlend SampledLights::State::blend() const {
  if (still_frames == 0) return {.most_frames = kMostFramesInChange};
  if (still_frames < kFadingFrames) return {.blend_factor = kBlendFactorWhileFading};
  if (still_frames == kFadingFrames) return {.most_frames = static_cast<float>(kFadingFrames)};
  return {};
}

SampledLights::SampledLights() : state_(std::make_unique<State>()) {}
SampledLights::~SampledLights() = default;

bool SampledLights::has_light(std::uint32_t emissive_triangle_count, const GpuEnvironment& environment,
                              const Settings& settings) {
  return settings.samples > 0 && ((settings.emitters && emissive_triangle_count > 0) || !environment.is_black());
}

SampledLights::Frame SampledLights::record(FrameGraph& graph, const GBuffer& gbuffer, const GpuScene::Frame& scene,
                                           const Tracer::Frame& tracer, const Reprojection& reprojection,
                                           GpuEnvironment& environment, ImageHandle environment_map,
                                           const glsl::GpuCamera& camera, const Settings& settings, bool reset,
                                           std::uint64_t frame_index) {
  State& state = *state_;
  const bool has_emitters = settings.emitters && scene.emissive_triangle_count > 0;
  if (!has_light(scene.emissive_triangle_count, environment, settings)) return {};
  state.note_changes(scene, camera, reset);
  const EmitterTable::Frame emitters = state.emitters.record(graph, scene);
  const BufferHandle environment_table = environment.record_table(graph);

  Frame frame;
  frame.sampled = graph.create_image(
      "sampled light", {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
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

  const TemporalMean mean = record_temporal_mean(graph, "sampled light", frame.sampled, reprojection, state.blend());
  frame.mean = mean.mean;
  frame.steady = (state.steady_frames + 1) * settings.samples >= kSteadySamples;
  frame.irradiance = settings.filter ? record_noise_filter(graph, "sampled light", mean, gbuffer, camera) : frame.mean;
  return frame;
}

}  // namespace lightwell
