// Pieces of triangles inside a cube against polygon clipping in double precision (testing/clip_oracle.h).
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

#include "gpu/submit.h"
#include "graph/executor.h"
#include "graph/testing/device_test.h"
#include "kernels/passes/voxelize/testing/cut.comp.h"
#include "passes/voxelize/testing/clip_oracle.h"
#include "passes/voxelize/testing/cut.h"

namespace lightwell {
namespace {

struct Piece {
  double area = 0.0;
  glm::dvec3 center{0.0};
  glm::dvec3 low{1e9};
  glm::dvec3 high{-1e9};
};

Piece measure(const std::vector<glm::dvec3>& polygon) {
  Piece piece;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const double part = 0.5 * glm::length(glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
    piece.area += part;
    piece.center += part / 3.0 * (polygon[0] + polygon[i - 1] + polygon[i]);
  }
  if (piece.area > 0.0) piece.center /= piece.area;
  for (const glm::dvec3& p : polygon) {
    piece.low = glm::min(piece.low, p);
    piece.high = glm::max(piece.high, p);
  }
  return piece;
}

// Small, large and huge ones; level ones, on the cube's faces too; some with corners on a lattice, whose edges
// coincide with the cube's.
std::vector<glsl::CutCase> random_cases(std::mt19937& random, std::size_t count) {
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  std::vector<glsl::CutCase> cases;
  while (cases.size() < count) {
    const std::size_t kind = cases.size() % 8;
    const float size = std::pow(2.0f, -4.0f + 10.0f * uniform(random));
    glm::vec3 corners[3];
    const glm::vec3 first(uniform(random), uniform(random), uniform(random));
    for (glm::vec3& corner : corners) {
      corner = first + size * (glm::vec3(uniform(random), uniform(random), uniform(random)) - 0.5f);
      if (kind == 1) corner = glm::round(corner * 2.0f) * 0.5f;
      if (kind == 2) corner.y = first.y;
      if (kind == 3) corner = {std::round(corner.x), std::round(corner.y), first.z};
      if (kind == 4) corner.x = 0.0f;
      if (kind == 5) corner = {1.0f, std::round(corner.y), std::round(corner.z)};
    }
    const glm::vec3 normal = glm::vec3(
        glm::cross(glm::dvec3(corners[1]) - glm::dvec3(corners[0]), glm::dvec3(corners[2]) - glm::dvec3(corners[0])));
    if (glm::length(normal) < 1e-3f * size * size) continue;
    cases.push_back({glm::vec4(corners[0], 0), glm::vec4(corners[1], 0), glm::vec4(corners[2], 0),
                     glm::vec4(glm::normalize(normal), 0)});
  }
  return cases;
}

using CutByBoxTest = DeviceTest;

TEST_F(CutByBoxTest, PiecesEqualTheClippedPolygon) {
  constexpr std::uint32_t kSeed = 5;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  const std::vector<glsl::CutCase> cases = random_cases(random, 20000);
  GraphExecutor executor(device());
  Submitter submitter(device());
  FrameGraph graph(executor.context());
  BufferHandle results = graph.create_buffer("results", cases.size(), sizeof(glsl::CutResult));
  graph.compute("cut", kernels::voxelize_testing_cut_comp)
      .read("cases", graph.upload("cases", std::span<const glsl::CutCase>(cases)))
      .write("results", results)
      .push(glsl::CutParams{static_cast<std::uint32_t>(cases.size())})
      .dispatch_threads(static_cast<std::uint32_t>(cases.size()));
  const ReadbackTicket ticket = graph.read_back(results);
  std::uint64_t frame = 0;
  submitter.run([&](VkCommandBuffer commands) { frame = executor.record(graph, commands, 0); });
  const std::vector<std::byte> bytes = executor.fetch(frame, ticket);
  std::vector<glsl::CutResult> pieces(cases.size());
  std::memcpy(pieces.data(), bytes.data(), bytes.size());

  int cut = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const glsl::CutCase& t = cases[i];
    const Piece truth = measure(
        clip_to_unit_cube({glm::dvec3(glm::vec3(t.a)), glm::dvec3(glm::vec3(t.b)), glm::dvec3(glm::vec3(t.c))}));
    const glm::vec4& result = pieces[i].center_area;
    ASSERT_NEAR(result.w, truth.area, 2e-3) << "case " << i << " kind " << i % 8;
    if (truth.area < 1e-2) continue;
    ++cut;
    ASSERT_LT(glm::length(glm::dvec3(glm::vec3(result)) - truth.center), 2e-3) << "case " << i << " kind " << i % 8;
    // The bounds along the normal's axis may be those of the plane over the other two.
    const glm::dvec3 low(glm::vec3(pieces[i].low));
    const glm::dvec3 high(glm::vec3(pieces[i].high));
    const glm::vec3 n = glm::abs(glm::vec3(t.normal));
    const int main_axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_LT(low[axis], truth.low[axis] + 2e-3) << "case " << i;
      ASSERT_GT(high[axis], truth.high[axis] - 2e-3) << "case " << i;
      if (axis == main_axis) continue;
      ASSERT_NEAR(low[axis], truth.low[axis], 2e-3) << "case " << i;
      ASSERT_NEAR(high[axis], truth.high[axis], 2e-3) << "case " << i;
    }
  }
  EXPECT_GT(cut, 5000);
}

}  // namespace
}  // namespace lightwell
