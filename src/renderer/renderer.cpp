#include "lightwell/renderer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <vector>

#include "core/join.h"
#include "gpu/device.h"
#include "gpu/pipeline_cache.h"
#include "gpu/submit.h"
#include "graph/executor.h"
#include "lightwell/error.h"
#include "passes/gpu_scene/static_resources.h"
#include "passes/tonemap/tonemap.h"
#include "renderer/frame_check.h"
#include "renderer/options.h"
#include "renderer/pass_clock.h"
#include "renderer/readback.h"
#include "renderer/sample_pattern.h"
#include "renderer/shared_world.h"
#include "renderer/view.h"
#include "shaders/lights.h"

namespace lightwell {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Refuses bad options before anything is built with them.
const RendererOptions& checked(const RendererOptions& options, const Device& device) {
  check_options(options, std::min(device.limits().maxImageDimension2D, static_cast<std::uint32_t>(kMaxImageSide)));
  return options;
}

// Before anything of the frame is declared: a frame that is refused leaves no trace.
void check_lights(const Device& device, const SceneSnapshot& world) {
  const std::size_t count = world.lights.size();
  check_buffer_size(device, std::to_string(count) + " lights", count * sizeof(glsl::GpuLight));
}

// A debug view on its way to the host.
struct WantedView {
  std::string name;
  ImageDesc desc;
  ReadbackTicket ticket;
};

struct SceneCounts {
  std::uint64_t triangles = 0;
  std::uint64_t vertices = 0;
  std::uint64_t lights = 0;
};

}  // namespace

struct Renderer::State {
  State(Device& device_, const Scene& scene, const SceneSnapshot& snapshot, const RendererOptions& options_,
        std::uint32_t frames_in_flight_)
      : device(device_),
        options(checked(options_, device_)),
        frame_check(scene, snapshot),
        frames_in_flight(std::max(1u, frames_in_flight_)),
        executor(device_, frames_in_flight),
        world(device_, scene, snapshot, options_),
        view(world, "", options_) {}

  // The frame without what becomes of its parts.
  DeclaredView declare(FrameGraph& graph, const FrameView& frame_view, const PixelSample& sample);
  // Keeps what the frame just declared offers to look at; refuses what was wanted and is not there.
  void check_views(const DeclaredView& frame);
  std::vector<WantedView> want_views(FrameGraph& graph, const DeclaredView& frame);
  RenderStatistics collect_statistics(std::vector<PassStatistics> passes) const;
  // Records what was declared since `start`.
  void record(FrameGraph& graph, VkCommandBuffer commands, std::uint64_t completed, Clock::time_point start);

  Device& device;
  RendererOptions options;
  FrameCheck frame_check;
  std::uint32_t frames_in_flight;
  GraphExecutor executor;
  SharedWorld world;
  View view;
  std::unique_ptr<Submitter> submitter;  // of render(); a host that records submits by itself
  std::uint64_t last_frame = 0;
  bool last_steady = true;
  SceneCounts counts;  // of the last frame

  FirstFrame first_frame;
  PassClock clock;
  RenderStatistics statistics;
  std::vector<std::string> view_names;
  std::map<std::string, Image> debug_images;
};

Renderer::Renderer(Device& device, const Scene& scene, const SceneSnapshot& snapshot, const RendererOptions& options,
                   std::uint32_t frames_in_flight) {
  const Clock::time_point start = Clock::now();
  state_ = std::make_unique<State>(device, scene, snapshot, options, frames_in_flight);
  state_->first_frame.setup_ms = milliseconds_since(start);
}

Renderer::~Renderer() = default;

FrameReport Renderer::record(VkCommandBuffer commands, const FrameView& view, const RenderTarget& target,
                             std::uint64_t completed) {
  State& state = *state_;
  if (commands == VK_NULL_HANDLE) throw InputError("commands", "is VK_NULL_HANDLE");
  state.frame_check.check(view);
  check_lights(state.device, *view.snapshot);
  check_target(state.device, target);
  check_completed(completed, state.last_frame, state.frames_in_flight);
  const Clock::time_point start = Clock::now();
  FrameGraph graph(state.executor.context());
  const DeclaredView frame = state.declare(graph, view, {});
  const ImageHandle radiance = record_combine(graph, frame.gbuffer, frame.parts);
  ImageResource image(state.device, "render target",
                      {.format = target.format, .width = frame.gbuffer.width, .height = frame.gbuffer.height},
                      target.image, target.layout_before);
  ImageHandle display = graph.import_image(image, target.layout_after);
  record_tonemap(graph, radiance, target.exposure, display);
  state.record(graph, commands, completed, start);
  state.last_steady = frame.steady;
  return {state.last_frame, frame.steady};
}

DeclaredView Renderer::State::declare(FrameGraph& graph, const FrameView& frame_view, const PixelSample& sample) {
  std::vector<glm::vec3> points = frame_view.points_of_interest;
  if (points.empty()) points.push_back(frame_view.camera.position);
  WorldFrame world_frame(graph, world.world(), *frame_view.snapshot, frame_view.time, frame_view.cut, points);
  counts = {world_frame.scene.triangle_count, world_frame.scene.vertex_count, world_frame.lights.count};
  return view.declare(graph, world_frame, frame_view.camera, frame_view.cut, sample);
}

void Renderer::State::record(FrameGraph& graph, VkCommandBuffer commands, std::uint64_t completed,
                             Clock::time_point start) {
  const bool first = last_frame == 0;
  const double declare_ms = milliseconds_since(start);
  const PipelineCache& pipelines = device.pipelines();
  const std::size_t made_before = pipelines.made_count();
  const double making_ms_before = pipelines.making_time_ms();
  last_frame = executor.record(graph, commands, completed);
  if (!first) return;
  first_frame.declare_ms = declare_ms;
  first_frame.pipelines_ms = pipelines.making_time_ms() - making_ms_before;
  first_frame.pipelines = static_cast<std::uint32_t>(pipelines.made_count() - made_before);
  first_frame.record_ms = milliseconds_since(start) - declare_ms - first_frame.pipelines_ms;
}

void Renderer::State::check_views(const DeclaredView& frame) {
  view_names.clear();
  for (const DebugView& view : frame.views) view_names.emplace_back(view.name);
  for (const std::string& name : options.debug_views) {
    if (std::find(view_names.begin(), view_names.end(), name) == view_names.end())
      throw InputError("debug view",
                       "'" + name + "' is unknown to --aov and --debug-views; there are: " + join(view_names));
  }
}

std::vector<WantedView> Renderer::State::want_views(FrameGraph& graph, const DeclaredView& frame) {
  std::vector<WantedView> wanted;
  for (const std::string& name : options.debug_views) {
    const auto view = std::find_if(frame.views.begin(), frame.views.end(),
                                   [&](const DebugView& candidate) { return candidate.name == name; });
    LW_ASSERT(view != frame.views.end(), name);
    wanted.push_back({name, graph.desc(view->image), graph.read_back(view->image)});
  }
  return wanted;
}

RenderStatistics Renderer::State::collect_statistics(std::vector<PassStatistics> passes) const {
  RenderStatistics collected;
  collected.frames = 1;
  collected.steady = last_steady;
  collected.passes = std::move(passes);
  for (const PassStatistics& pass : collected.passes) collected.gpu_time_ms += pass.time_ms;
  for (const auto& [name, use] : device.memory().report()) {
    if (use.bytes > 0) collected.memory_bytes[name] = use.bytes;
  }
  collected.first_frame = first_frame;
  collected.triangles = counts.triangles;
  collected.vertices = counts.vertices;
  collected.lights = counts.lights;
  if (const TechniqueWorld* technique = view.technique_world()) collected.counts = technique->counts();
  return collected;
}

RenderStatistics Renderer::statistics_of(std::uint64_t frame) const {
  std::vector<PassStatistics> passes;
  for (const PassTime& pass : state_->executor.pass_times(frame)) {
    passes.push_back({pass.name, pass.time_ms, pass.count, 1});
  }
  return state_->collect_statistics(std::move(passes));
}

Picture Renderer::render(const FrameView& view, const std::function<void(int)>& progress) {
  State& state = *state_;
  state.frame_check.check(view);
  check_lights(state.device, *view.snapshot);
  const Clock::time_point start = Clock::now();
  const int wanted_frames = view.settle ? 0 : state.options.frames;
  const int film_frames = wanted_frames > 0 ? std::min(state.options.samples, wanted_frames) : state.options.samples;
  const auto samples = static_cast<std::uint32_t>(film_frames);
  if (!state.submitter) state.submitter = std::make_unique<Submitter>(state.device);
  const float footprint = 1.0f / std::sqrt(static_cast<float>(samples));
  state.clock = {};

  // Frames run until the technique is ready; the one that finds it so exposes the film first. All of them take turns in
  // the positions of the samples, so that what is gathered over frames is a mean over the pixel.
  int frames = 0;
  for (std::uint32_t sample = 0; true;) {
    const Clock::time_point frame_start = Clock::now();
    const bool first = state.last_frame == 0;
    FrameGraph graph(state.executor.context());
    const std::uint32_t turn = static_cast<std::uint32_t>(frames) % samples;
    const DeclaredView frame = state.declare(graph, view, {sample_position(turn, samples), footprint});
    ++frames;
    if (frames == 1) state.check_views(frame);  // before the long work
    const bool ready = sample > 0 || (wanted_frames > 0 ? frames > wanted_frames - film_frames
                                                        : frame.steady || frames >= kMaximumFrames);
    const bool last = ready && sample + 1 == samples;
    std::array<ReadbackTicket, 5> tickets;
    std::vector<WantedView> wanted;
    if (ready) {
      const Film film = record_film(graph, frame.gbuffer, frame.parts, sample == 0);
      if (last) {
        std::transform(film.images.begin(), film.images.end(), tickets.begin(),
                       [&](ImageHandle image) { return graph.read_back(image); });
        wanted = state.want_views(graph, frame);
      }
      ++sample;
    }
    state.submitter->run(
        [&](VkCommandBuffer commands) { state.record(graph, commands, state.last_frame, frame_start); });
    if (first) {
      FirstFrame& times = state.first_frame;
      times.wait_ms = milliseconds_since(frame_start) - times.declare_ms - times.pipelines_ms - times.record_ms;
    }
    state.executor.notice_completed(state.last_frame);
    state.clock.add_frame(state.executor.pass_times(state.last_frame));
    if (progress) progress(frames);
    if (!last) continue;

    state.debug_images.clear();
    for (const WantedView& wanted_view : wanted) {
      state.debug_images[wanted_view.name] =
          decode_texels(wanted_view.desc, state.executor.fetch(state.last_frame, wanted_view.ticket));
    }
    std::array<std::vector<std::byte>, 5> film_bytes;
    std::transform(tickets.begin(), tickets.end(), film_bytes.begin(),
                   [&](const ReadbackTicket& ticket) { return state.executor.fetch(state.last_frame, ticket); });
    state.last_steady = frame.steady;
    state.statistics = state.collect_statistics(state.clock.means());
    state.statistics.frames = frames;
    state.statistics.gpu_time_ms = state.clock.mean_frame_ms();
    state.statistics.wall_time_ms = milliseconds_since(start);
    return develop_film(film_bytes, state.options.width, state.options.height, film_frames, frame.eye_behind);
  }
}

const RenderStatistics& Renderer::statistics() const {
  return state_->statistics;
}
const std::map<std::string, Image>& Renderer::debug_images() const {
  return state_->debug_images;
}
std::vector<std::string> Renderer::debug_view_names() const {
  return state_->view_names;
}

}  // namespace lightwell
