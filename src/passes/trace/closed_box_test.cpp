// No ray leaves a closed box, wherever in it and on its walls it starts.
#include <algorithm>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "passes/trace/testing/trace_test_base.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kMiss = 0xffffffffu;
constexpr unsigned kSeed = 17;

// From -1 to 1 along each axis. Walls share no vertices.
Scene make_box() {
  Primitive box;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      const auto first = static_cast<std::uint32_t>(box.positions.size());
      glm::vec3 normal(0.0f);
      normal[axis] = -side;
      for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
        glm::vec3 position(side);
        position[(axis + 1) % 3] = corner.x;
        position[(axis + 2) % 3] = corner.y;
        box.positions.push_back(position);
        box.normals.push_back(normal);
      }
      for (const std::uint32_t i : {0, 1, 2, 0, 2, 3}) box.indices.push_back(first + i);
    }
  Scene scene;
  scene.meshes.push_back({"box", {box}, {}});
  Node node;
  node.mesh = 0;
  scene.nodes.push_back(node);
  return scene;
}

using ClosedBoxTest = TraceTest;

// Half of the rays aim at edges, a sixth of these at corners. None runs within a wall's plane.
TEST_F(ClosedBoxTest, LetsNoRayOut) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 engine(kSeed);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  const float insets[] = {0.0f, 1e-7f, 4e-6f, 1e-4f, 1e-3f, 1e-2f, 0.1f, 1.0f};  // m, from a wall
  std::vector<glsl::ListedRay> rays;
  while (rays.size() < 300000) {
    const auto side = [&] { return engine() % 2 == 0 ? -1.0f : 1.0f; };
    const auto axis = static_cast<int>(engine() % 3);
    glm::vec3 from(uniform(engine), uniform(engine), uniform(engine));
    for (int i = 0; i < 3; ++i)
      if (i != axis) from[i] = side() * (1.0f - insets[engine() % std::size(insets)]);
    glm::vec3 direction(uniform(engine), uniform(engine), uniform(engine));
    if (rays.size() % 2 == 0) {
      glm::vec3 target(side(), side(), side());
      if (rays.size() % 12 != 0) target[static_cast<int>(engine() % 3)] = uniform(engine);
      direction = target - from;
    }
    const float length = glm::length(direction);
    const glm::vec3 off_wall = glm::abs(direction) + (1.0f - glm::abs(from));
    if (std::min({off_wall.x, off_wall.y, off_wall.z}) == 0.0f) continue;
    rays.push_back({from, 0.0f, direction / (rays.size() % 4 < 2 ? length : 1.0f), 1e30f});
  }
  const Scene scene = make_box();
  const SceneSnapshot snapshot = take_snapshot(scene);
  Traced traced(scene, snapshot);
  for (const bool any_hit : {false, true}) {
    const std::vector<glsl::ListedHit> hits = trace(traced, snapshot, rays, any_hit);
    EXPECT_EQ(std::count_if(hits.begin(), hits.end(), [](const auto& hit) { return hit.triangle == kMiss; }), 0)
        << "any hit " << any_hit;
  }
}

}  // namespace
}  // namespace lightwell
