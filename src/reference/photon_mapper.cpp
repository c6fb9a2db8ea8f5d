#include "lightwell/photon_mapper.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "reference/camera_rays.h"
#include "reference/option_ranges.h"
#include "reference/parallel.h"
#include "reference/path_integrator.h"
#include "reference/photon_disc.h"
#include "reference/photon_map.h"
#include "reference/photon_tracing.h"
#include "reference/pixel_sum.h"

namespace lightwell {
namespace {

constexpr const char* kSubject = "photon mapper";
constexpr int kMaxPhotons = 100'000'000;
constexpr int kMaxNeighbors = 100'000;
constexpr int kMaxIterations = 1 << 20;
constexpr float kAlpha = 2.0f / 3.0f;   // Knaus and Zwicker 2011: error falls fastest
constexpr float kLargestDisc = 0.125f;  // radius over the diagonal of the scene's box
constexpr int kSamplesAtOnce = 64;      // of a pixel

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

void check(const PhotonMapperOptions& options) {
  check_range(kSubject, "width", options.width, 1, kMaxImageSide);
  check_range(kSubject, "height", options.height, 1, kMaxImageSide);
  check_range(kSubject, "photons", options.photons, 0, kMaxPhotons);
  check_range(kSubject, "k", options.k, 2, kMaxNeighbors);
  check_range(kSubject, "progressive", options.progressive, 1, kMaxIterations);
  check_range(kSubject, "samples", options.samples, 1, kMaxSamples);
  check_range(kSubject, "max-bounces", options.max_bounces, 0, kMaxBounces);
  check_range(kSubject, "seed", options.seed, 0, kMaxSeed);
  check_range(kSubject, "threads", options.threads, 0, kMaxThreads);
}

// Work of all cores together.
struct Tally {
  std::atomic<std::int64_t> camera_ns{0};
  std::atomic<std::int64_t> query_ns{0};
  std::atomic<std::int64_t> queries{0};
  std::atomic<std::int64_t> photons{0};
};

// A pixel over all iterations. Where its disc is not known yet, the iteration finds it.
struct PixelState {
  PixelSum sum;
  float area = 0.0f;  // of the disc in the first iteration over pi, m^2; 0: not known
};

class Rendering {
 public:
  Rendering(const TracedWorld& world, const WorldCamera& camera, const PhotonMapperOptions& options,
            const std::function<void(float)>& progress)
      : world_(world),
        sources_(world),
        camera_(camera),
        options_(options),
        rays_(camera, options.width, options.height),
        tiles_(options.width, options.height),
        pixels_(static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height)),
        steps_(progress, std::int64_t{options.progressive} * (photon_blocks(photons()) + tiles_.count())) {
    const Bounds bounds = triangle_bounds(world.flat);
    max_radius_ = kLargestDisc * glm::distance(bounds.minimum, bounds.maximum);
    statistics_.threads = core_count(options.threads);
  }

  PhotonMapping run() {
    float shrinking = 1.0f;
    for (int iteration = 0; iteration < options_.progressive; ++iteration) {
      const PhotonMap map = make_map(iteration);
      run_parallel(options_.threads, tiles_.count(), [&](int tile) {
        PhotonMap::Scratch scratch;
        tiles_.for_each_pixel(tile, [&](int x, int y) { render_pixel(map, iteration, shrinking, x, y, scratch); });
        steps_.step();
      });
      shrinking *= (static_cast<float>(iteration + 1) + kAlpha) / static_cast<float>(iteration + 2);
    }
    return finish();
  }

 private:
  // What a camera ray meets, and the random numbers that are left for it.
  struct Visible {
    PathSample sample;
    Sampler sampler;
  };

  // Without bounces there is no light for photons to bring.
  int photons() const { return options_.max_bounces > 0 && !sources_.empty() ? options_.photons : 0; }

  PhotonMap make_map(int iteration) {
    const Clock::time_point start = Clock::now();
    PhotonTracing tracing;
    tracing.count = photons();
    tracing.first = static_cast<std::uint64_t>(iteration) * static_cast<std::uint64_t>(photons());
    tracing.max_bounces = options_.max_bounces;
    tracing.seed = static_cast<std::uint32_t>(options_.seed);
    tracing.threads = options_.threads;
    std::vector<Photon> arrivals = trace_photons(world_, sources_, tracing, [this] { steps_.step(); });
    const Clock::time_point traced = Clock::now();
    PhotonMap map(std::move(arrivals));
    statistics_.emission_ms += milliseconds(traced - start);
    statistics_.tree_ms += milliseconds(Clock::now() - traced);
    statistics_.emitted += tracing.count;
    statistics_.stored += static_cast<std::int64_t>(map.size());
    if (map.photon_bytes() > statistics_.photon_bytes) {
      statistics_.photons_kept = static_cast<std::int64_t>(map.size());
      statistics_.photon_bytes = map.photon_bytes();
      statistics_.tree_bytes = map.tree_bytes();
    }
    return map;
  }

  void render_pixel(const PhotonMap& map, int iteration, float shrinking, int x, int y, PhotonMap::Scratch& scratch) {
    const auto index =
        static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(options_.width) + static_cast<std::uint32_t>(x);
    PixelState& pixel = pixels_[index];
    const float radius = std::sqrt(shrinking * pixel.area);
    float area_sum = 0.0f;
    int hits = 0;
    std::vector<Visible> visible;
    for (int first = 0; first < options_.samples; first += kSamplesAtOnce) {
      const Clock::time_point start = Clock::now();
      visible.clear();
      for (int i = first; i < std::min(first + kSamplesAtOnce, options_.samples); ++i) {
        const auto number = static_cast<std::uint32_t>(iteration) * static_cast<std::uint32_t>(options_.samples) +
                            static_cast<std::uint32_t>(i);
        Sampler sampler(static_cast<std::uint32_t>(options_.seed), index, number);
        const glm::vec2 position = glm::vec2(x, y) + sampler.next_2d();
        const PathSample sample = sample_path(world_, rays_.ray(position), 0, sampler);
        visible.push_back({sample, sampler});
      }
      const Clock::time_point seen = Clock::now();
      for (Visible& point : visible) {
        if (!point.sample.hit) continue;
        area_sum += add_indirect(map, radius, point, scratch);
        ++hits;
      }
      tally_.camera_ns += std::chrono::nanoseconds(seen - start).count();
      tally_.query_ns += std::chrono::nanoseconds(Clock::now() - seen).count();
      for (const Visible& point : visible) pixel.sum.add(point.sample, camera_);
    }
    tally_.queries += hits;
    if (pixel.area == 0.0f && hits > 0) pixel.area = area_sum / (static_cast<float>(hits) * shrinking);
  }

  // Fills in the sample's indirect light; returns the square of the disc's radius. Radius 0: it is to be found.
  float add_indirect(const PhotonMap& map, float radius, Visible& point, PhotonMap::Scratch& scratch) {
    PathSample& sample = point.sample;
    const PhotonMap::Estimate estimate =
        radius > 0.0f ? map.within(sample.position, sample.geometric_normal, radius)
                      : map.nearest(sample.position, sample.geometric_normal, options_.k, max_radius_, scratch);
    // Lambert: radiance = albedo / pi * irradiance.
    sample.indirect = sample.albedo / kPi * estimate.irradiance;
    // Edges would be dark as long as discs are wide, and those shrink slowly.
    if (options_.progressive > 1 && estimate.photons > 0)
      sample.indirect /=
          part_on_surface(world_, sample.position, sample.geometric_normal, estimate.radius, point.sampler);
    tally_.photons += estimate.photons;
    return estimate.radius * estimate.radius;
  }

  PhotonMapping finish() {
    PhotonMapping result;
    result.picture = make_picture(options_.width, options_.height);
    for (int y = 0; y < options_.height; ++y) {
      for (int x = 0; x < options_.width; ++x) {
        const std::size_t index =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(options_.width) + static_cast<std::size_t>(x);
        store(result.picture, x, y, pixels_[index].sum, options_.progressive * options_.samples);
      }
    }
    const double query_ns = static_cast<double>(tally_.query_ns);
    statistics_.camera_ms = static_cast<double>(tally_.camera_ns) * 1e-6 / statistics_.threads;
    statistics_.query_ms = query_ns * 1e-6 / statistics_.threads;
    statistics_.queries = tally_.queries;
    const double queries = static_cast<double>(std::max<std::int64_t>(1, statistics_.queries));
    statistics_.us_per_query = query_ns * 1e-3 / queries;
    statistics_.photons_per_query = static_cast<double>(tally_.photons) / queries;
    statistics_.wall_time_ms = milliseconds(Clock::now() - begin_);
    result.statistics = statistics_;
    return result;
  }

  const Clock::time_point begin_ = Clock::now();
  const TracedWorld& world_;
  const PhotonSources sources_;
  const WorldCamera& camera_;
  const PhotonMapperOptions& options_;
  const RayGenerator rays_;
  const Tiles tiles_;
  std::vector<PixelState> pixels_;
  ProgressSteps steps_;
  float max_radius_ = 0.0f;
  Tally tally_;
  PhotonMapperStatistics statistics_;
};

}  // namespace

void PhotonMapperOptions::describe(OptionVisitor& visitor) {
  visitor.visit({"photons", "Photons that lights send, in each iteration.", "", "time and memory in proportion"},
                photons, 0, kMaxPhotons);
  visitor.visit({"k", "Photons of one estimate of irradiance: more are less noise and more blur.", "",
                 "time of a query, in proportion"},
                k, 2, kMaxNeighbors);
  visitor.visit(
      {"progressive", "Iterations with photons of their own, over ever smaller discs: the mean converges to the truth.",
       "", "time in proportion"},
      progressive, 1, kMaxIterations);
  visitor.visit({"samples", "Camera rays a pixel and iteration.", "", "time of camera rays and queries in proportion"},
                samples, 1, kMaxSamples);
  visitor.visit(
      {"max-bounces", "Most bounces of indirect light; 0 shows direct light only.", "", "time, at most in proportion"},
      max_bounces, 0, kMaxBounces);
  visitor.visit({"seed", "Chooses the random numbers; the same seed gives the same picture.", "", ""}, seed, 0,
                kMaxSeed);
  visitor.visit({"threads", "CPU threads, 0 for all cores and never more; the picture does not depend on it.", "", ""},
                threads, 0, kMaxThreads);
}

struct PhotonMapper::State {
  TracedWorld world;
};

PhotonMapper::PhotonMapper(const Scene& scene, const SceneSnapshot& snapshot)
    : state_(new State{TracedWorld(scene, snapshot)}) {}
PhotonMapper::~PhotonMapper() = default;
PhotonMapper::PhotonMapper(PhotonMapper&&) noexcept = default;
PhotonMapper& PhotonMapper::operator=(PhotonMapper&&) noexcept = default;

PhotonMapping PhotonMapper::render(const WorldCamera& camera, const PhotonMapperOptions& options,
                                   const std::function<void(float)>& progress) const {
  check(options);
  return Rendering(state_->world, camera, options, progress).run();
}

}  // namespace lightwell
