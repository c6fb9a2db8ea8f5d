#include "lightwell/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <string>

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>

#include "lightwell/error.h"
#include "reference/path_integrator.h"

namespace lightwell {
namespace {

constexpr int kTileSide = 16;
constexpr int kMaxSamples = 1 << 20;
constexpr int kMaxBounces = 1024;
constexpr int kMaxThreads = 1024;
constexpr int kMaxSeed = std::numeric_limits<int>::max();

void check_range(const char* name, int value, int minimum, int maximum) {
  if (value >= minimum && value <= maximum) return;
  throw InputError("path tracer", std::string(name) + " " + std::to_string(value) + " is not in [" +
                                      std::to_string(minimum) + ", " + std::to_string(maximum) + "]");
}

void check(const PathTracerOptions& options) {
  check_range("width", options.width, 1, kMaxImageSide);
  check_range("height", options.height, 1, kMaxImageSide);
  check_range("samples", options.samples, 1, kMaxSamples);
  check_range("max-bounces", options.max_bounces, 0, kMaxBounces);
  check_range("seed", options.seed, 0, kMaxSeed);
  check_range("threads", options.threads, 0, kMaxThreads);
}

// Rays of a perspective camera with square pixels.
class RayGenerator {
 public:
  RayGenerator(const WorldCamera& camera, int width, int height) : camera_(camera) {
    const float half_height = std::tan(0.5f * camera.yfov);
    pixel_side_ = 2.0f * half_height / static_cast<float>(height);
    top_left_ = {-0.5f * pixel_side_ * static_cast<float>(width), half_height};
    right_ = glm::cross(camera.forward, camera.up);
  }

  // `position` is in pixels from the picture's top left corner. One unit of t is one metre along `forward`.
  Ray ray(glm::vec2 position) const {
    const float x = top_left_.x + pixel_side_ * position.x;
    const float y = top_left_.y - pixel_side_ * position.y;
    return {camera_.position, camera_.forward + x * right_ + y * camera_.up, camera_.znear};
  }

 private:
  const WorldCamera& camera_;
  float pixel_side_;
  glm::vec2 top_left_;
  glm::vec3 right_;
};

// Sums of one pixel's samples in double precision.
struct PixelSum {
  glm::dvec3 direct{0.0}, indirect{0.0}, emission{0.0}, albedo{0.0}, normal{0.0};
  double depth = 0.0;
  int hits = 0;

  void add(const PathSample& sample, const WorldCamera& camera) {
    direct += sample.direct;
    indirect += sample.indirect;
    emission += sample.emission;
    if (!sample.hit) return;
    albedo += sample.albedo;
    normal += sample.normal;
    depth += glm::dot(glm::dvec3{sample.position} - glm::dvec3{camera.position}, glm::dvec3{camera.forward});
    ++hits;
  }
};

void store(Image& image, int x, int y, const glm::dvec3& value) {
  for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<float>(value[c]);
}

void store(Picture& picture, int x, int y, const PixelSum& sum, int samples) {
  const double scale = 1.0 / samples;
  store(picture.direct, x, y, sum.direct * scale);
  store(picture.indirect, x, y, sum.indirect * scale);
  store(picture.emission, x, y, sum.emission * scale);
  store(picture.combined, x, y, (sum.direct + sum.indirect + sum.emission) * scale);
  store(picture.albedo, x, y, sum.albedo * scale);
  store(picture.normal, x, y, sum.normal * scale);
  // The mean over what is seen: a mean with the background's 0 would be a depth where nothing is.
  *picture.depth.at(x, y) = sum.hits > 0 ? static_cast<float>(sum.depth / sum.hits) : 0.0f;
}

Picture make_picture(int width, int height) {
  Picture picture;
  for (Image* image :
       {&picture.combined, &picture.direct, &picture.indirect, &picture.emission, &picture.albedo, &picture.normal}) {
    *image = Image(width, height, 3);
  }
  picture.depth = Image(width, height, 1);
  return picture;
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

  const int tiles_x = (options.width + kTileSide - 1) / kTileSide;
  const int tiles_y = (options.height + kTileSide - 1) / kTileSide;
  const int tiles = tiles_x * tiles_y;
  std::mutex progress_mutex;
  int tiles_done = 0;
  const auto render_tile = [&](int tile) {
    const int left = tile % tiles_x * kTileSide;
    const int top = tile / tiles_x * kTileSide;
    for (int y = top; y < std::min(top + kTileSide, options.height); ++y) {
      for (int x = left; x < std::min(left + kTileSide, options.width); ++x) render_pixel(x, y);
    }
    if (!progress) return;
    const std::lock_guard lock(progress_mutex);
    progress(static_cast<float>(++tiles_done) / static_cast<float>(tiles));
  };

  const int cores = tbb::info::default_concurrency();
  tbb::task_arena arena(options.threads > 0 ? std::min(options.threads, cores) : cores);
  arena.execute([&] { tbb::parallel_for(0, tiles, render_tile, tbb::simple_partitioner{}); });
  return picture;
}

}  // namespace lightwell
