#include "passes/sampled_lights/sampled_lights.h"

#include "kernels/passes/sampled_lights/sample_lights.comp.h"
#include "passes/noise_filter/noise_filter.h"
#include "passes/noise_filter/still_frames.h"
#include "passes/sampled_lights/sample_lights_params.h"

namespace lightwell {
namespace {

// Samples of each kind a pixel, without change, after which a frame is steady. Of an edge of shadow 64 stratified
// points leave an error of about 64^-3/4 = 4 % of its contrast, of smooth light much less, and the film averages on.
constexpr std::uint32_t kSteadySamples = 64;

// Frames for which what was before a change fades.
constexpr std::uint32_t kFadingFrames = 16;

}  // namespace

struct SampledLights::State {
  StillFrames still_frames{{.fading_frames = kFadingFrames}};
};

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
  state.still_frames.note(view);
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
      record_temporal_mean(graph, "sampled light", frame.sampled, view.reprojection(), state.still_frames.blend());
  if (!mean.has_history) state.still_frames.note_no_history();
  frame.mean = mean.mean;
  frame.steady = (state.still_frames.steady() + 1) * settings.samples >= kSteadySamples;
  frame.irradiance =
      settings.filter ? record_noise_filter(graph, "sampled light", mean, gbuffer, view.camera) : frame.mean;
  return frame;
}

}  // namespace lightwell
