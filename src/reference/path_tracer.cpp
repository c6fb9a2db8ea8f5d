#include "lightwell/path_tracer.h"

#include <cstdio>
#include <string>
#include <vector>

#include "core/log.h"
#include "core/luminance.h"
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

double total_luminance(const Image& image) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 2 < image.pixels.size(); i += 3)
    sum += luminance(glm::dvec3{image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]});
  return sum;
}

// The first part has the seed's own numbers, as a picture without parts has.
std::uint32_t seed_of_part(int seed, int part) {
  const auto own = static_cast<std::uint32_t>(seed);
  return part == 0 ? own : hash_combine(own, static_cast<std::uint32_t>(part));
}

void warn_of_cut_light(const std::vector<BounceEnergy>& tiles, const Image& emission,
                       const PathTracerOptions& options) {
  constexpr double kShare = 1e-3;
  if (options.max_bounces == 0) return;
  BounceEnergy all;
  for (const BounceEnergy& tile : tiles) all.merge(tile);
  const double share = all.share_beyond(options.max_bounces, total_luminance(emission) * options.samples);
  if (share <= kShare) return;
  char percent[32];
  std::snprintf(percent, sizeof(percent), "%.2g", 100.0 * share);
  log_warning("path tracer: about " + std::string(percent) + " % of the light comes from beyond " +
              std::to_string(options.max_bounces) + " bounces and is left out");
}

}  // namespace

void PathTracerOptions::describe(OptionVisitor& visitor) {
  visitor.visit({"samples", "Paths a pixel.", "", "time in proportion; noise falls with its square root"}, samples, 1,
                kMaxSamples);
  visitor.visit({"max-bounces",
                 "Most bounces of indirect light; 0 shows direct light only. Unlimited by default: chance ends paths.",
                 "", "time, at most in proportion"},
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

  const SampleParts parts(options.samples, options.variance);
  if (parts.count() > 1) picture.variance = Image(options.width, options.height, 3);

  const auto render_pixel = [&](int x, int y, BounceEnergy& energy) {
    PixelSum sum;
    MeanVariance variance(parts);
    const auto pixel =
        static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(options.width) + static_cast<std::uint32_t>(x);
    for (int i = 0; i < options.samples; ++i) {
      Sampler sampler(seed_of_part(options.seed, parts.part(i)), pixel, static_cast<std::uint32_t>(parts.index(i)));
      const glm::vec2 position = glm::vec2(x, y) + sampler.next_2d();
      const PathSample sample = sample_path(state_->world, rays.ray(position), options.max_bounces, sampler, &energy);
      sum.add(sample, camera);
      variance.add(parts.part(i),
                   glm::dvec3{sample.direct} + glm::dvec3{sample.indirect} + glm::dvec3{sample.emission});
    }
    store(picture, x, y, sum, options.samples);
    if (parts.count() > 1) store(picture.variance, x, y, variance.value());
  };

  const Tiles tiles(options.width, options.height);
  std::vector<BounceEnergy> energies(static_cast<std::size_t>(tiles.count()));
  ProgressSteps steps(progress, tiles.count());
  run_parallel(options.threads, tiles.count(), [&](int tile) {
    BounceEnergy& energy = energies[static_cast<std::size_t>(tile)];
    tiles.for_each_pixel(tile, [&](int x, int y) { render_pixel(x, y, energy); });
    steps.step();
  });
  warn_of_cut_light(energies, picture.emission, options);
  return picture;
}

}  // namespace lightwell
