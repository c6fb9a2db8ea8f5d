// Our hierarchy against Embree: the same rays must meet the same triangles at the same distance.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "passes/gpu_scene/gpu_scene_types.h"
#include "passes/trace/testing/trace_test_base.h"
#include "reference/ray_tracer.h"
#include "scene/builtin.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kMiss = 0xffffffffu;
constexpr int kRays = 1000000;

// From anywhere in the bounds to anywhere.
std::vector<glsl::ListedRay> random_rays(const Bounds& bounds, int count, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  std::normal_distribution<float> normal;
  const auto next = [&](auto& distribution) {
    return glm::vec3(distribution(engine), distribution(engine), distribution(engine));
  };
  std::vector<glsl::ListedRay> rays(static_cast<std::size_t>(count));
  for (glsl::ListedRay& ray : rays) {
    ray.origin = glm::mix(bounds.minimum, bounds.maximum, next(uniform));
    ray.direction = glm::normalize(next(normal));
    ray.t_min = 0.0f;
    ray.t_max = std::numeric_limits<float>::infinity();
  }
  return rays;
}

struct Agreement {
  int hits = 0;         // of Embree
  int hit_or_miss = 0;  // rays on which the two disagree about whether there is anything
  int distance = 0;     // other distances
  int triangle = 0;     // other triangles, although nothing else is near
  int masked = 0;       // disagreements where one of the two met an alpha-masked triangle; none of the above
  int blocked = 0;      // any-hit rays that disagree with closest-hit rays
};

class TracingTest : public TraceTest {
 protected:
  // Triangles as the device has them.
  struct DeviceTriangles {
    std::vector<glsl::WorldVertex> vertices;
    std::vector<std::uint32_t> indices;

    // Whether one has the same corners as the reference's, which leaves out triangles and turns mirrored ones.
    bool is_same(std::uint32_t triangle, const FlatScene& flat, std::size_t theirs) const {
      for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec3 corner = flat.corner(theirs, i).position;
        float nearest = std::numeric_limits<float>::infinity();
        for (std::size_t j = 0; j < 3; ++j) {
          const glm::vec3 ours(vertices[indices[3 * std::size_t{triangle} + j]].position_material);
          nearest = std::min(nearest, glm::distance(corner, ours));
        }
        if (nearest > 1e-6f * glm::length(corner)) return false;
      }
      return true;
    }
  };

  // `flat` and `embree`: of the same snapshot.
  Agreement compare(Traced& traced, const SceneSnapshot& snapshot, const FlatScene& flat, const RayTracer& embree,
                    const std::vector<glsl::ListedRay>& rays) {
    FrameGraph graph(executor().context());
    const GpuScene::Frame frame = traced.gpu_scene.record(graph, snapshot);
    const Tracer::Frame hierarchy = traced.tracer.record(graph, frame);
    const ReadbackTicket closest_ticket = graph.read_back(add_rays(graph, frame, hierarchy, rays, false));
    const ReadbackTicket any_ticket = graph.read_back(add_rays(graph, frame, hierarchy, rays, true));
    const ReadbackTicket vertex_ticket = graph.read_back(frame.vertices);
    const ReadbackTicket index_ticket = graph.read_back(frame.indices);
    run(graph);
    const auto closest = fetch<glsl::ListedHit>(closest_ticket);
    const auto any = fetch<glsl::ListedHit>(any_ticket);
    const DeviceTriangles triangles{fetch<glsl::WorldVertex>(vertex_ticket), fetch<std::uint32_t>(index_ticket)};

    Agreement result;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const glsl::ListedHit& ours = closest[i];
      const std::optional<TriangleHit> theirs = embree.closest_triangle({rays[i].origin, rays[i].direction, 0.0f});
      const bool hit = ours.triangle != kMiss;
      result.blocked += (any[i].triangle != kMiss) != hit ? 1 : 0;
      result.hits += theirs ? 1 : 0;
      if (!theirs && !hit) continue;
      // Positions themselves are rounded: distances cannot agree better than that.
      const float rounding = 4.0f * 0x1p-23f * glm::length(rays[i].origin);
      const float apart = theirs && hit ? std::abs(theirs->t - ours.t) - rounding : 0.0f;
      const bool other_distance = theirs && hit && apart > 1e-4f * theirs->t;
      const bool other_triangle =
          theirs && hit && apart > 1e-5f * theirs->t && !triangles.is_same(ours.triangle, flat, theirs->triangle);
      if (theirs.has_value() == hit && !other_distance && !other_triangle) continue;
      if ((hit && ours.triangle >= frame.opaque_triangle_count) || (theirs && theirs->triangle >= flat.opaque_count)) {
        ++result.masked;
      } else {
        result.hit_or_miss += theirs.has_value() != hit ? 1 : 0;
        result.distance += other_distance ? 1 : 0;
        result.triangle += other_triangle ? 1 : 0;
      }
    }
    return result;
  }
};

struct TracingScene {
  const char* name;
  const char* file;  // below ../shared/scenes; built in where empty
  float scale;
  int masked_limit;  // rays whose mask may differ: textures of other sizes than the device's arrays are resampled
};

void PrintTo(const TracingScene& scene, std::ostream* out) {
  *out << scene.name;
}

class SceneTracingTest : public TracingTest, public ::testing::WithParamInterface<TracingScene> {};

TEST_P(SceneTracingTest, MeetsWhatEmbreeMeets) {
  const TracingScene& chosen = GetParam();
  const std::string path =
      *chosen.file ? std::string(LIGHTWELL_SHARED_DIR "/scenes/") + chosen.file : resolve_scene(chosen.name);
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is missing";
  constexpr unsigned kSeed = 5;
  const Scene scene = load_scene(path, {.scale = chosen.scale});
  const SceneSnapshot snapshot = take_snapshot(scene);
  const FlatScene flat = flatten(scene, snapshot);
  const RayTracer embree(flat);
  Traced traced(scene, snapshot);
  const Agreement found = compare(traced, snapshot, flat, embree, random_rays(snapshot.bounds, kRays, kSeed));
  RecordProperty("hits", found.hits);
  RecordProperty("hit_or_miss", found.hit_or_miss);
  RecordProperty("distance", found.distance);
  RecordProperty("triangle", found.triangle);
  RecordProperty("masked", found.masked);
  EXPECT_GT(found.hits, kRays / 4) << "seed " << kSeed;
  EXPECT_LE(found.hit_or_miss, kRays / 100000);
  EXPECT_LE(found.distance, kRays / 100000);
  EXPECT_LE(found.triangle, kRays / 100000);
  EXPECT_LE(found.masked, chosen.masked_limit);
  EXPECT_EQ(found.blocked, 0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneTracingTest,
                         ::testing::Values(TracingScene{"sponza", "sponza-crytek/sponza-crytek.gltf", 0.01f, 0},
                                           TracingScene{"conference", "conference/conference.gltf", 1.0f, 0},
                                           TracingScene{"textured", "", 1.0f, 200}),
                         [](const auto& info) { return std::string(info.param.name); });

// A torus of 20000 triangles that is twisted and pulled apart further in every frame, on a floor that stands.
Scene make_twisting_torus() {
  constexpr std::uint32_t kAround = 200;
  constexpr std::uint32_t kAcross = 50;
  Primitive torus;
  MorphTarget twist;
  for (std::uint32_t i = 0; i < kAround; ++i) {
    for (std::uint32_t j = 0; j < kAcross; ++j) {
      const float u = glm::two_pi<float>() * static_cast<float>(i) / kAround;
      const float v = glm::two_pi<float>() * static_cast<float>(j) / kAcross;
      const glm::vec3 out(std::cos(u), 0.0f, std::sin(u));
      torus.positions.push_back((1.0f + 0.4f * std::cos(v)) * out + glm::vec3(0.0f, 0.4f * std::sin(v), 0.0f));
      torus.normals.push_back(std::cos(v) * out + glm::vec3(0.0f, std::sin(v), 0.0f));
      twist.positions.push_back(glm::vec3(std::sin(5.0f * u), std::cos(3.0f * u + v), std::sin(7.0f * v)));
      for (const auto& [a, b] : {std::pair(0u, 0u), {1u, 0u}, {0u, 1u}, {1u, 0u}, {1u, 1u}, {0u, 1u}})
        torus.indices.push_back((i + a) % kAround * kAcross + (j + b) % kAcross);
    }
  }
  twist.normals.resize(twist.positions.size(), glm::vec3(0.0f));
  torus.morph_targets.push_back(twist);
  Primitive floor;
  floor.positions = {{-3, -2, -3}, {3, -2, -3}, {3, -2, 3}, {-3, -2, 3}};
  floor.normals.assign(4, {0, 1, 0});
  floor.indices = {0, 2, 1, 0, 3, 2};
  Scene scene;
  scene.meshes.push_back({"torus", {torus}, {0.0f}});
  scene.meshes.push_back({"floor", {floor}, {}});
  for (int mesh = 0; mesh < 2; ++mesh) {
    Node node;
    node.mesh = mesh;
    scene.nodes.push_back(node);
  }
  return scene;
}

TEST_F(TracingTest, FollowsAMeshThatMoves) {
  const Scene scene = make_twisting_torus();
  SceneSnapshot snapshot = take_snapshot(scene);
  Traced traced(scene, snapshot);
  constexpr unsigned kSeed = 17;
  constexpr int kFrames = 20;  // a hierarchy is built again after 15 refits
  const Bounds around{glm::vec3(-2.0f), glm::vec3(2.0f)};
  Agreement all;
  for (int frame = 0; frame < kFrames; ++frame) {
    snapshot.instances[0].morph_weights = {0.04f * static_cast<float>(frame)};
    const FlatScene flat = flatten(scene, snapshot);
    const RayTracer embree(flat);
    const unsigned seed = kSeed + static_cast<unsigned>(frame);
    const Agreement found = compare(traced, snapshot, flat, embree, random_rays(around, kRays / kFrames, seed));
    EXPECT_GT(found.hits, kRays / kFrames / 10) << "frame " << frame;
    all.hit_or_miss += found.hit_or_miss;
    all.distance += found.distance;
    all.triangle += found.triangle;
    all.blocked += found.blocked;
  }
  EXPECT_LE(all.hit_or_miss, kRays / 100000) << "seeds " << kSeed << " and following";
  EXPECT_LE(all.distance, kRays / 100000);
  EXPECT_LE(all.triangle, kRays / 100000);
  EXPECT_EQ(all.blocked, 0);
}

}  // namespace
}  // namespace lightwell
