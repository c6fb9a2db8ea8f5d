// Measures building and shadow rays in Crytek Sponza at 256^3 and prints tables; not part of the test run:
//   lightwell_passes_test --gtest_also_run_disabled_tests --gtest_filter='*SvoBench.*'
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <map>
#include <optional>
#include <random>

#include <glm/geometric.hpp>

#include "kernels/passes/trace/trace_rays.comp.h"
#include "passes/svo/testing/svo_test_base.h"
#include "passes/trace/trace_rays_types.h"
#include "passes/trace/tracer.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSeed = 21;
constexpr std::uint32_t kResolution = 256;  // of the ray tables

class DISABLED_SvoBench : public SvoTest {
 protected:
  void SetUp() override {
    SvoTest::SetUp();
    if (IsSkipped()) return;
    const std::string path = LIGHTWELL_SHARED_DIR "/scenes/sponza-crytek/sponza-crytek.gltf";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
    scene_.emplace(load_scene(path, {.scale = 0.01f}));
    snapshot_ = take_snapshot(*scene_);
    gpu_scene_.emplace(device(), *scene_, snapshot_);
    tracer_.emplace(device(), Tracing::kBvh);
  }

  struct Surface {
    glm::vec3 position;
    glm::vec3 normal;
  };

  static BufferHandle add_triangle_rays(FrameGraph& graph, const GpuScene::Frame& frame, const Tracer::Frame& hierarchy,
                                        const std::vector<glsl::ListedRay>& rays, bool any_hit) {
    BufferHandle hits = graph.create_buffer("hits", rays.size(), sizeof(glsl::ListedHit));
    dispatch_linear(trace_compute(graph, "triangles: rays", kernels::trace_trace_rays_comp, frame, hierarchy)
                        .read("rays", graph.upload<glsl::ListedRay>("rays", rays))
                        .write("hits", hits)
                        .push(glsl::RayParams{static_cast<std::uint32_t>(rays.size()), any_hit ? 1u : 0u}),
                    rays.size());
    return hits;
  }

  // What rays meet first.
  std::vector<Surface> surfaces(const std::vector<glsl::ListedRay>& rays) {
    FrameGraph graph(executor().context());
    const GpuScene::Frame frame = gpu_scene_->record(graph, snapshot_);
    const Tracer::Frame hierarchy = tracer_->record(graph, frame);
    const ReadbackTicket hit_ticket = graph.read_back(add_triangle_rays(graph, frame, hierarchy, rays, false));
    const ReadbackTicket vertex_ticket = graph.read_back(frame.vertices);
    const ReadbackTicket index_ticket = graph.read_back(frame.indices);
    run(graph);
    const auto hits = fetch<glsl::ListedHit>(hit_ticket);
    const auto vertices = fetch<glsl::WorldVertex>(vertex_ticket);
    const auto indices = fetch<std::uint32_t>(index_ticket);
    std::vector<Surface> result;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (hits[i].triangle == UINT32_MAX) continue;
      Corners corners;
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = glm::vec3(vertices[indices[3 * hits[i].triangle + k]].position_material);
      glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
      if (!(glm::dot(normal, normal) > 0.5f)) continue;
      if (glm::dot(normal, rays[i].direction) > 0.0f) normal = -normal;
      result.push_back({rays[i].origin + hits[i].t * rays[i].direction, normal});
    }
    return result;
  }

  // Milliseconds of processor time, all threads, of one ray pass: from the difference of frames with three and with
  // one. What a software device needs, however busy the machine.
  template <class Declare>
  double ray_pass_ms(Declare&& declare) {
    double least = 1e30;
    for (int repeat = 0; repeat < 4; ++repeat) {
      std::array<double, 2> ms{};
      for (const int passes : {1, 3}) {
        FrameGraph graph(executor().context());
        declare(graph, passes);
        const std::clock_t start = std::clock();
        run(graph);
        ms[passes == 3 ? 1 : 0] = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      }
      if (repeat > 0) least = std::min(least, 0.5 * (ms[1] - ms[0]));
    }
    return least;
  }

  static void print(const char* name, std::size_t rays, double ms, double blocked) {
    std::printf("  %-24s %8.2f ms %8.3f Mrays/s and core, %4.1f %% blocked\n", name, ms,
                1e-3 * static_cast<double>(rays) / ms, 100.0 * blocked / static_cast<double>(rays));
  }

  void print_rate(const char* name, const std::vector<glsl::SvoRay>& rays, std::uint32_t way, float epsilon) {
    ReadbackTicket ticket;
    const double ms = ray_pass_ms([&](FrameGraph& graph, int passes) {
      const GpuScene::Frame frame = gpu_scene_->record(graph, snapshot_);
      const Svo svo =
          record_svo(graph, frame, snapshot_.bounds, {.resolution = kResolution, .epsilon = epsilon}, is_built_);
      is_built_ = true;
      const BufferHandle list = graph.upload<glsl::SvoRay>("rays", rays);
      for (int i = 0; i < passes; ++i)
        ticket = graph.read_back(add_rays(graph, svo, list, static_cast<std::uint32_t>(rays.size()), way));
    });
    const auto blocked = fetch<std::uint32_t>(ticket);
    print(name, rays.size(), ms, static_cast<double>(std::count(blocked.begin(), blocked.end(), 1u)));
  }

  void print_triangle_rate(const char* name, const std::vector<glsl::SvoRay>& rays) {
    std::vector<glsl::ListedRay> listed;
    for (const glsl::SvoRay& ray : rays) {
      const glm::vec3 from(ray.from + 1e-3f * ray.from_normal), to(ray.to + 1e-3f * ray.to_normal);
      listed.push_back({from, 0.0f, to - from, 1.0f});
    }
    ReadbackTicket ticket;
    const double ms = ray_pass_ms([&](FrameGraph& graph, int passes) {
      const GpuScene::Frame frame = gpu_scene_->record(graph, snapshot_);
      const Tracer::Frame hierarchy = tracer_->record(graph, frame);
      for (int i = 0; i < passes; ++i)
        ticket = graph.read_back(add_triangle_rays(graph, frame, hierarchy, listed, true));
    });
    double blocked = 0.0;
    for (const glsl::ListedHit& hit : fetch<glsl::ListedHit>(ticket)) blocked += hit.triangle != UINT32_MAX ? 1.0 : 0.0;
    print(name, rays.size(), ms, blocked);
  }

  bool is_built_ = false;
  std::optional<Scene> scene_;
  SceneSnapshot snapshot_;
  std::optional<GpuScene> gpu_scene_;
  std::optional<Tracer> tracer_;
};

TEST_F(DISABLED_SvoBench, BuildByStage) {
  for (const std::uint32_t resolution : {128u, 256u}) {
    for (const SvoVoxels voxels : {SvoVoxels::kRasterised, SvoVoxels::kConservative}) {
      std::map<std::string, double> least;
      std::vector<std::uint32_t> counts;
      for (int repeat = 0; repeat < 4; ++repeat) {
        FrameGraph graph(executor().context());
        const GpuScene::Frame frame = gpu_scene_->record(graph, snapshot_);
        const Svo svo =
            record_svo(graph, frame, snapshot_.bounds, {.resolution = resolution, .voxels = voxels, .records = true});
        const ReadbackTicket ticket = graph.read_back(svo.counts);
        run(graph);
        counts = fetch<std::uint32_t>(ticket);
        for (const PassTime& pass : executor().pass_times(frame_)) {
          if (pass.name.rfind("svo: ", 0) != 0) continue;
          const auto [place, is_new] = least.emplace(pass.name, pass.time_ms);
          if (!is_new) place->second = std::min(place->second, pass.time_ms);
        }
      }
      std::printf("%u^3 %s: %u cells, %u nodes of %u, level %u\n", resolution,
                  voxels == SvoVoxels::kRasterised ? "rasterised" : "conservative", counts[glsl::kSvoFragments],
                  counts[glsl::kSvoNodesUsed], counts[glsl::kSvoNodesWanted], counts[glsl::kSvoLevelReached]);
      double sum = 0.0;
      for (const auto& [name, ms] : least) {
        std::printf("  %-20s %8.2f ms\n", name.c_str(), ms);
        sum += ms;
      }
      std::printf("  %-20s %8.2f ms\n", "all", sum);
    }
  }
}

// From what a camera in the hall sees to what a sun lights. Pixel after pixel, each with another light point; sorted,
// with neighbouring rays to neighbouring light points.
TEST_F(DISABLED_SvoBench, ShadowRays) {
  std::mt19937 random(kSeed);
  std::printf("seed %u\n", kSeed);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  const glm::vec3 low = snapshot_.bounds.minimum;
  const glm::vec3 size = snapshot_.bounds.maximum - low;
  const WorldCamera camera = snapshot_.cameras.empty() ? default_camera(snapshot_.bounds) : snapshot_.cameras[0];

  std::vector<glsl::ListedRay> camera_rays;
  constexpr int kWidth = 320, kHeight = 180;
  const glm::vec3 right = glm::cross(camera.forward, camera.up);
  const float tangent = std::tan(0.5f * camera.yfov);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const glm::vec2 at((2.0f * static_cast<float>(x) + 1.0f) / kWidth - 1.0f,
                         1.0f - (2.0f * static_cast<float>(y) + 1.0f) / kHeight);
      const glm::vec3 direction = camera.forward + tangent * (at.x * kWidth / kHeight * right + at.y * camera.up);
      camera_rays.push_back({camera.position, 0.0f, glm::normalize(direction), 1e30f});
    }
  }
  const std::vector<Surface> receivers = surfaces(camera_rays);
  std::vector<glsl::ListedRay> sun_rays;
  const glm::vec3 sun = glm::normalize(glm::vec3(0.25f, -1.0f, 0.15f));
  while (sun_rays.size() < 4000) {
    const glm::vec3 top = low + size * glm::vec3(uniform(random), 1.0f, uniform(random));
    sun_rays.push_back({top - 0.1f * size.y * sun, 0.0f, sun, 1e30f});
  }
  std::vector<Surface> lit = surfaces(sun_rays);
  // Only what lies in the open hall, not the roof.
  std::erase_if(lit, [&](const Surface& s) { return s.position.y > low.y + 0.8f * size.y; });
  std::printf("%zu receivers, %zu light points\n", receivers.size(), lit.size());
  ASSERT_GT(lit.size(), 100u);
  if (lit.size() > 1024) lit.resize(1024);

  struct Pair {
    std::uint32_t receiver, light;
  };
  std::vector<Pair> pairs;
  while (pairs.size() < 400000) {
    const Pair pair{static_cast<std::uint32_t>(pairs.size() % receivers.size()),
                    static_cast<std::uint32_t>(uniform(random) * static_cast<float>(lit.size()) * 0.9999f)};
    const Surface &r = receivers[pair.receiver], &l = lit[pair.light];
    const glm::vec3 way = l.position - r.position;
    if (glm::dot(way, r.normal) <= 0.0f || glm::dot(way, l.normal) >= 0.0f) {
      // Keep the counter moving through the receivers.
      pairs.push_back({pair.receiver, UINT32_MAX});
      continue;
    }
    pairs.push_back(pair);
  }
  std::erase_if(pairs, [](const Pair& p) { return p.light == UINT32_MAX; });
  std::vector<Pair> sorted = pairs;
  // Light points by place, 8 to a cluster; within it by receiver.
  std::vector<std::uint32_t> rank(lit.size());
  {
    std::vector<std::uint32_t> order(lit.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      const auto key = [&](std::uint32_t i) {
        const glm::uvec3 c(8.0f * (lit[i].position - low) / size.x);
        return (c.z * 64 + c.y) * 64 + c.x;
      };
      return key(a) != key(b) ? key(a) < key(b) : a < b;
    });
    for (std::uint32_t i = 0; i < order.size(); ++i) rank[order[i]] = i / 8;
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Pair& a, const Pair& b) { return rank[a.light] < rank[b.light]; });

  const auto measure = [&](const char* name, const std::vector<Pair>& list) {
    std::vector<glsl::SvoRay> rays;
    for (const Pair& p : list)
      rays.push_back({glm::vec4(receivers[p.receiver].position, 0), glm::vec4(receivers[p.receiver].normal, 0),
                      glm::vec4(lit[p.light].position, 0), glm::vec4(lit[p.light].normal, 0)});
    std::printf("%s, %zu rays\n", name, rays.size());
    print_rate("restart, published", rays, glsl::kSvoRestart, 1.8f);
    print_rate("voxels between surfaces", rays, glsl::kVoxelsBetween, 0.0f);
    print_triangle_rate("triangles", rays);
    // The same segments for both traversals: outside of the cells of their own surfaces.
    const VoxelGrid grid = fit_voxel_grid(snapshot_.bounds, kResolution);
    for (glsl::SvoRay& ray : rays) {
      const auto leave = [&](const glm::vec4& normal) {
        return 1.01f * grid.cell_size * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)) * normal;
      };
      ray.from += leave(ray.from_normal);
      ray.to += leave(ray.to_normal);
    }
    print_rate("restart, above surfaces", rays, glsl::kSvoRestart, 0.0f);
    print_rate("voxels, above surfaces", rays, glsl::kVoxels, 0.0f);
  };
  measure("unsorted", pairs);
  measure("sorted by light point", sorted);
}

}  // namespace
}  // namespace lightwell
