#include "passes/sampled_lights/sampled_lights.h"

#include <algorithm>

#include "kernels/passes/sampled_lights/sample_lights.comp.h"
#include "passes/noise_filter/noise_filter.h"
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
  SceneRevisions revisions;         // of the scene in the last frame
  glm::mat4 view{0.0f};             // of the last frame
  std::uint32_t steady_frames = 0;  // since the scene or the camera changed
  std::uint32_t still_frames = 0;   // since the scene changed; kFadingFrames + 1 where its past does not matter

  // Counts what happened since the last frame.
  void note_changes(const ViewFrame& frame);
  // How the next frame and the mean of those before come together.
  TemporalBlend blend() const;
};

void SampledLights::State::note_changes(const ViewFrame& frame) {
  const bool reset = frame.is_cut();
  const bool changed = !reset && surfaces_changed(revisions, frame.world.revisions);
  const bool moved = frame.camera.steady_view_projection != view;
  steady_frames = reset || changed || moved ? 0 : steady_frames + 1;
  still_frames = changed ? 0 : reset ? kFadingFrames + 1 : std::min(still_frames + 1, kFadingFrames + 1);
  revisions = frame.world.revisions;
  view = frame.camera.steady_view_projection;
}

TemporalBlend SampledLights::State::blend() const {
  if (still_frames == 0) return {.most_frames = kMostFramesInChange};
  if (still_frames < kFadingFrames) return {.blend_factor = kBlendFactorWhileFading};
  if (still_frames == kFadingFrames) return {.most_frames = static_cast<float>(kFadingFrames)};
  return {};
}

SampledLights::SampledLights() : state_(std::make_unique<State>()) {}
SampledLights::~SampledLights() = default;

SampledLights::Frame SampledLights::record(FrameGraph& graph, ViewFrame& view, const Settings& settings) {
  State& state = *state_;
  WorldFrame& world = view.world;
  const GBuffer& gbuffer = view.gbuffer;
  const bool has_emitters = has(settings.kinds, LightKinds::kEmitters) && world.scene.emissive_triangle_count > 0;
  const std::uint32_t environment =
      has(settings.kinds, LightKinds::kEnvironment) ? world.gpu_environment().kind() : glsl::kEnvironmentBlack;
  if (settings.samples == 0 || (!has_emitters && environment == glsl::kEnvironmentBlack)) return {};
  state.note_changes(view);
  const EmitterTable::Frame& emitters = world.emitters();
  const BufferHandle environment_table = world.environment_table();

  Frame frame;
  frame.sampled = graph.create_image(
      "sampled light", {.width = gbuffer.width, .height = gbuffer.height, .format = VK_FORMAT_R32G32B32A32_SFLOAT});
  trace_compute(graph, "sample lights", kernels::sampled_lights_sample_lights_comp, world)
      .read("position", gbuffer.position)
      .read("normal", gbuffer.normal)
      .read("face", gbuffer.face)
      .read("environment", world.environment)
      .read("emitters", emitters.emitters)
      .read("groups", emitters.groups)
      .read("environment_table", environment_table)
      .write("irradiance", frame.sampled)
      .constant("kEmitters", has_emitters ? 1 : 0)
      .constant("kEmittersLookUp", emitters.look_up ? 1 : 0)
      .constant("kEnvironment", environment)
      .push(glsl::SampleLightsParams{{gbuffer.width, gbuffer.height},
                                     world.gpu_environment().table_size(),
                                     world.scene.emissive_triangle_count,
                                     settings.samples,
                                     static_cast<std::uint32_t>(world.index) * settings.samples,
                                     pixel_clearance(view.camera)})
      .dispatch_threads(gbuffer.width, gbuffer.height);

  const TemporalMean mean =
      record_temporal_mean(graph, "sampled light", frame.sampled, view.reprojection(), state.blend());
  if (!mean.has_history) {
    state.steady_frames = 0;
    state.still_frames = kFadingFrames + 1;  // of the past nothing is left to fade
  }
  frame.mean = mean.mean;
  frame.steady = (state.steady_frames + 1) * settings.samples >= kSteadySamples;
  frame.irradiance =
      settings.filter ? record_noise_filter(graph, "sampled light", mean, gbuffer, view.camera) : frame.mean;
  return frame;
}

}  // namespace lightwell
