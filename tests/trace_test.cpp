// Rays through the front door (shaders/trace.glsl) against Embree: whether they meet something, where, and which
// triangle.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <tuple>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "passes/gpu_scene/gpu_scene_types.h"
#include "passes/trace/testing/trace_test_base.h"
#include "reference/ray_tracer.h"
#include "scene/builtin.h"

namespace lightwell {
namespace {

constexpr unsigned kSeed = 11;
constexpr std::uint32_t kNoTriangle = 0xffffffffu;
constexpr float kNoEnd = 1e30f;
const std::vector<std::string> kScenes{"soup", "room", "textured", "arena", "sponza"};
constexpr std::size_t kRays = 20000;
constexpr int kDoubtful = 2;  // rays of these that may go through an edge, where rounding decides

// Triangles anywhere in a cube, of many sizes: a third opaque, a third with a mask, a third with a mask that is a
// chequerboard of 32 texels.
Scene make_soup() {
  Scene scene;
  Texture texture;
  texture.width = texture.height = 128;
  texture.nearest = true;
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x)
      texture.rgba.insert(texture.rgba.end(), {255, 255, 255, static_cast<std::uint8_t>((x / 32 + y / 32) % 2 * 255)});
  scene.textures.push_back(texture);
  scene.materials.resize(3);
  scene.materials[1].alpha_mode = scene.materials[2].alpha_mode = AlphaMode::kMask;
  scene.materials[1].base_color.a = 0.3f;
  scene.materials[2].base_color_texture.texture = 0;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  const auto point = [&] { return 2.0f * glm::vec3(unit(random), unit(random), unit(random)) - 1.0f; };
  for (int material = 0; material < 3; ++material) {
    Primitive primitive;
    primitive.material = material;
    for (std::uint32_t i = 0; i < 300; ++i) {
      const glm::vec3 centre = point();
      const float size = std::exp2(-6.0f * unit(random));
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        primitive.positions.push_back(centre + size * point());
        primitive.indices.push_back(3 * i + corner);
      }
      primitive.texcoords[0].insert(primitive.texcoords[0].end(), {{0, 0}, {1, 0}, {0, 1}});
    }
    primitive.normals.assign(primitive.positions.size(), {0, 0, 1});
    Node node;
    node.mesh = static_cast<int>(scene.meshes.size());
    scene.meshes.emplace_back().primitives.push_back(std::move(primitive));
    scene.nodes.push_back(node);
  }
  return scene;
}

// From anywhere in and around the scene, in all directions, of lengths from 1/8 to 8; half of them end somewhere.
std::vector<glsl::ListedRay> make_rays(const Bounds& bounds, std::size_t count) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::normal_distribution<float> normal;
  const glm::vec3 extent = bounds.maximum - bounds.minimum;
  std::vector<glsl::ListedRay> rays(count);
  for (std::size_t i = 0; i < count; ++i) {
    glsl::ListedRay& ray = rays[i];
    ray.origin = bounds.minimum + (1.2f * glm::vec3(unit(random), unit(random), unit(random)) - 0.1f) * extent;
    const float length = std::exp2(6.0f * unit(random) - 3.0f);
    ray.direction = length * glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    ray.t_min = 0.0f;
    ray.t_max = i % 2 == 0 ? kNoEnd : unit(random) * glm::length(extent) / length;
  }
  return rays;
}

class RaysTest : public TraceTest, public ::testing::WithParamInterface<std::tuple<Tracing, std::string>> {
 protected:
  struct Answer {
    std::vector<glsl::ListedHit> hits;
    std::vector<glsl::ListedHit> blocked;
    std::vector<glsl::WorldVertex> vertices;
    std::vector<std::uint32_t> indices;
  };

  Answer trace(const Scene& scene, const std::vector<glsl::ListedRay>& rays) {
    const SceneSnapshot snapshot = take_snapshot(scene);
    GpuScene gpu_scene(device(), scene, snapshot);
    Tracer tracer(device(), std::get<0>(GetParam()));
    FrameGraph graph(executor().context());
    const GpuScene::Frame frame = gpu_scene.record(graph, snapshot);
    const Tracer::Frame traced = tracer.record(graph, frame);
    const ReadbackTicket hits = graph.read_back(add_rays(graph, frame, traced, rays, false));
    const ReadbackTicket blocked = graph.read_back(add_rays(graph, frame, traced, rays, true));
    const ReadbackTicket vertices = graph.read_back(frame.vertices);
    const ReadbackTicket indices = graph.read_back(frame.indices);
    run(graph);
    return {fetch<glsl::ListedHit>(hits), fetch<glsl::ListedHit>(blocked), fetch<glsl::WorldVertex>(vertices),
            fetch<std::uint32_t>(indices)};
  }
};

Scene load(const std::string& name) {
  if (name == "soup") return make_soup();
  if (name == "sponza") return load_scene(LIGHTWELL_SHARED_DIR "/scenes/sponza-crytek/sponza-crytek.gltf");
  return load_scene(resolve_scene(name));
}

TEST_P(RaysTest, MeetWhatEmbreeMeets) {
  const auto [tracing, name] = GetParam();
  if (tracing == Tracing::kRayQuery && !device().has_ray_query())
    GTEST_SKIP() << device().summary().name << " has no ray queries";
  if (name == "sponza" && !std::filesystem::exists(LIGHTWELL_SHARED_DIR "/scenes/sponza-crytek"))
    GTEST_SKIP() << "no shared scenes";
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  const Scene scene = load(name);
  const SceneSnapshot snapshot = take_snapshot(scene);
  const FlatScene flat = flatten(scene, snapshot);
  const RayTracer oracle(flat);
  const float size = glm::length(snapshot.bounds.maximum - snapshot.bounds.minimum);
  const std::vector<glsl::ListedRay> rays = make_rays(snapshot.bounds, kRays);
  const Answer traced = trace(scene, rays);

  int met = 0, differ = 0, far_off = 0, elsewhere = 0, half_blocked = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const glsl::ListedRay& ray = rays[i];
    const glsl::ListedHit& hit = traced.hits[i];
    half_blocked += (hit.triangle == kNoTriangle) != (traced.blocked[i].triangle == kNoTriangle);
    const float length = glm::length(ray.direction);
    const auto expected = oracle.closest({ray.origin, ray.direction, 0.0f});
    const float expected_t =
        expected ? glm::dot(expected->position - ray.origin, ray.direction) / (length * length) : kNoEnd;
    if ((expected_t <= ray.t_max && expected) != (hit.triangle != kNoTriangle)) {
      ++differ;
      continue;
    }
    if (hit.triangle == kNoTriangle) continue;
    ++met;
    far_off += std::abs(hit.t - expected_t) * length > 1e-4f * size;
    // The triangle and the point on it that it names are where the ray is.
    ASSERT_LT(3 * hit.triangle + 2, traced.indices.size());
    const auto corner = [&](std::uint32_t c) {
      return glm::vec3(traced.vertices[traced.indices[3 * hit.triangle + c]].position_material);
    };
    const glm::vec3 point =
        corner(0) + hit.barycentrics.x * (corner(1) - corner(0)) + hit.barycentrics.y * (corner(2) - corner(0));
    elsewhere += glm::length(point - (ray.origin + hit.t * ray.direction)) > 1e-4f * size;
  }
  EXPECT_GT(met, 2000);
  EXPECT_LE(differ + far_off, kDoubtful);
  EXPECT_EQ(elsewhere, 0);
  EXPECT_EQ(half_blocked, 0);
}

INSTANTIATE_TEST_SUITE_P(RayQueries, RaysTest,
                         ::testing::Combine(::testing::Values(Tracing::kRayQuery), ::testing::ValuesIn(kScenes)),
                         [](const auto& info) { return std::get<1>(info.param); });
INSTANTIATE_TEST_SUITE_P(OwnHierarchy, RaysTest,
                         ::testing::Combine(::testing::Values(Tracing::kBvh), ::testing::ValuesIn(kScenes)),
                         [](const auto& info) { return std::get<1>(info.param); });

}  // namespace
}  // namespace lightwell
