#include "lightwell/path_tracer.h"

#include "reference/camera_rays.h"
#include "reference/option_ranges.h"
#include "reference/parallel.h"
#include "reference/path_integrator.h"
#include "reference/pixel_sum.h"

namespace lightwell {
namespace {

constexpr const char* kSubject = "path tracer";

void check(const PathTracerOptions& options) {
  check_range(kSubject, "width", options.width, 1, kMaxImageSide);
  check_range(kSubject, "height", options.height, 1, kMaxImageSide);
  check_range(kSubject, "samples", options.samples, 1, kMaxSamples);
  check_range(kSubject, "max-bounces", options.max_bounces, 0, kMaxBounces);
  check_range(kSubject, "seed", options.seed, 0, kMaxSeed);
  check_range(kSubject, "threads", options.threads, 0, kMaxThreads);
}

}  // namespace

void PathTracerOptions::describe(OptionVisitor& visitor) {
  visitor.visit({"samples", "Paths a pixel.", "", "time in proportion; noise falls with its square root"}, samples, 1,
                kMaxSamples);
  visitor.visit(
      {"max-bounces", "Most bounces of indirect light; 0 shows direct light only.", "", "time, at most in proportion"},
      max_bounces, 0, kMaxBounces);
  visitor.visit({"seed", "Chooses the random numbers; the same seed gives the same picture.", "", ""}, seed, 0,
                kMaxSeed);
  visitor.visit({"threads", "CPU threads, 0 for all cores and never more; the picture does not depend on it.", "", ""},
                threads, 0, kMaxThreads);
}

struct PathTracer::State {
  TracedWorld world;
};

PathTracer::PathTracer(const Scene& scene, const SceneSnapshot& snapshot)
    : state_(new State{TracedWorld(scene, snapshot)}) {}
PathTracer::~PathTracer() = default;
PathTracer::PathTracer(PathTracer&&) noexcept = default;
PathTracer& PathTracer::operator=(PathTracer&&) noexcept = default;

Picture PathTracer::render(const WorldCamera& camera, const PathTracerOptions& options,
                           const std::function<void(float)>& progress) const {
  check(options);
  Picture picture = make_picture(options.width, options.height);
  const RayGenerator rays(camera, options.width, options.height);

  const auto render_pixel = [&](int x, int y) {
    PixelSum sum;
    const auto pixel =
        static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(options.width) + static_cast<std::uint32_t>(x);
    for (int i = 0; i < options.samples; ++i) {
      Sampler sampler(static_cast<std::uint32_t>(options.seed), pixel, static_cast<std::uint32_t>(i));
      const glm::vec2 position = glm::vec2(x, y) + sampler.next_2d();
      sum.add(sample_path(state_->world, rays.ray(position), options.max_bounces, sampler), camera);
    }
    store(picture, x, y, sum, options.samples);
  };

  const Tiles tiles(options.width, options.height);
  ProgressSteps steps(progress, tiles.count());
  run_parallel(options.threads, tiles.count(), [&](int tile) {
    tiles.for_each_pixel(tile, render_pixel);
    steps.step();
  });
  return picture;
}

}  // namespace lightwell
