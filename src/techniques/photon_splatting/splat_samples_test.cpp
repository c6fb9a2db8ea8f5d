// Light that is gathered at samples and spread from them, against light that is gathered at every pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <set>
#include <utility>

#include "techniques/photon_splatting/splat_test_screen.h"

namespace lightwell {
namespace {

// The inside of the cube from -1 to 1, with a thin wall that stands in it.
TestHit room(const glm::vec3& origin, const glm::vec3& direction) {
  TestHit hit;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0f) continue;
    const float distance = (sign_of(direction[axis]) - origin[axis]) / direction[axis];
    if (distance > 0.0f && (hit.distance == 0.0f || distance < hit.distance)) {
      hit = {distance, glm::vec3(0.0f)};
      hit.normal[axis] = -sign_of(direction[axis]);
    }
  }
  const float to_wall = (0.3f - origin.y) / direction.y;
  const glm::vec3 there = origin + to_wall * direction;
  if (to_wall > 0.0f && to_wall < hit.distance && there.x > 0.1f && there.z < 0.2f)
    hit = {to_wall, glm::vec3(0.0f, -sign_of(direction.y), 0.0f)};
  return hit;
}

class SplatSamplesTest : public SplatTest {
 protected:
  struct Light {
    std::vector<glm::vec4> gathered;
    std::vector<glm::vec4> spread;
  };

  static TestScreen make_screen() {
    WorldCamera camera;
    camera.position = glm::vec3(0.1f, -0.95f, 0.2f);
    camera.forward = glm::normalize(glm::vec3(0.1f, 1.0f, -0.1f));
    camera.up = glm::vec3(0.0f, 0.0f, 1.0f);
    camera.yfov = 1.4f;
    camera.znear = 0.01f;
    return {{77, 53}, camera, room};
  }

  // `down`: those alone that end on the floor.
  static TestSplats make_splats(int count, bool down) {
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    TestSplats splats(room);
    while (splats.splats().size() < static_cast<std::size_t>(count)) {
      glm::vec3 direction = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
      if (down) direction.z = -std::abs(direction.z);
      const glm::vec3 origin = 0.3f * glm::vec3(normal(random), normal(random), normal(random));
      if (std::abs(origin.x) > 0.9f || std::abs(origin.y) > 0.9f || std::abs(origin.z) > 0.9f) continue;
      const TestHit hit = room(origin, direction);
      if (down && hit.normal.z < 0.5f) continue;
      splats.add(make_splat(origin + hit.distance * direction, direction, 0.3f, hit.normal), true);
    }
    return splats;
  }

  Light light_of(const TestScreen& screen, const TestSplats& splats, const SplatSampling& sampling) {
    FrameGraph graph(executor().context());
    SplatScreen seen = screen.upload(graph);
    seen.sampling = sampling;
    const Splats uploaded = splats.upload(graph);
    const SplatLists lists =
        record_splat_lists(graph, seen, uploaded, SplatEstimate::kDensity, kMemory, std::make_shared<bool>(true));
    const ImageHandle gathered = record_splat_gather(graph, seen, uploaded, lists, {});
    const ReadbackTicket samples = graph.read_back(gathered);
    const ReadbackTicket pixels = graph.read_back(record_splat_spread(graph, seen, gathered));
    run(graph);
    return {fetch<glm::vec4>(samples), fetch<glm::vec4>(pixels)};
  }
};

// Samples are pixels of the full picture to the last bit, and in as many frames as a block has pixels each has its
// turn.
TEST_F(SplatSamplesTest, EveryPixelHasItsTurn) {
  const TestScreen screen = make_screen();
  const TestSplats splats = make_splats(300, false);
  const std::vector<glm::vec4> full = light_of(screen, splats, {}).gathered;
  for (const std::uint32_t stride : {2u, 4u}) {
    const glm::uvec2 count = (screen.size + stride - 1u) / stride;
    std::set<std::pair<std::uint32_t, std::uint32_t>> turns;
    for (std::uint32_t frame = 0; frame < stride * stride; ++frame) {
      const Light light = light_of(screen, splats, {stride, frame});
      ASSERT_EQ(light.gathered.size(), std::size_t{count.x} * count.y);
      const auto is_turn = [&](glm::uvec2 turn) {
        for (std::uint32_t y = 0; y < count.y; ++y)
          for (std::uint32_t x = 0; x < count.x; ++x) {
            const glm::uvec2 pixel = min(stride * glm::uvec2(x, y) + turn, screen.size - 1u);
            const std::size_t at = std::size_t{pixel.y} * screen.size.x + pixel.x;
            if (glm::vec3(light.gathered[std::size_t{y} * count.x + x]) != glm::vec3(full[at])) return false;
          }
        return true;
      };
      for (std::uint32_t i = 0; i < stride * stride; ++i)
        if (is_turn({i % stride, i / stride})) turns.insert({i % stride, i / stride});
      EXPECT_EQ(turns.size(), frame + 1);
    }
  }
}

// The mean over frames by weight has the light of the full picture, and no light crosses an edge for long.
TEST_F(SplatSamplesTest, LightIsSpreadOnItsOwnSurface) {
  const TestScreen screen = make_screen();
  const TestSplats splats = make_splats(300, true);
  const std::vector<glm::vec4> full = light_of(screen, splats, {}).gathered;
  for (const std::uint32_t stride : {2u, 4u}) {
    std::vector<glm::dvec4> sums(full.size(), glm::dvec4(0.0));
    for (std::uint32_t frame = 0; frame < stride * stride; ++frame) {
      const Light light = light_of(screen, splats, {stride, frame});
      for (std::size_t i = 0; i < full.size(); ++i) {
        const glm::vec4& e = light.spread[i];
        ASSERT_TRUE(e.w > 0.0f && e.w <= 1.0f);
        sums[i] += glm::dvec4(glm::vec3(e) * e.w, e.w);
      }
    }
    double light = 0.0, truth = 0.0, off = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < full.size(); ++i) {
      const double e = sums[i].x / sums[i].w;
      if (screen.points[i].normal.z < 0.5f) {
        EXPECT_LE(e, 1e-3 * splats.splats().size()) << "beside the floor";
        continue;
      }
      light += e;
      truth += full[i].x;
      off += (e - full[i].x) * (e - full[i].x);
      squares += full[i].x * full[i].x;
    }
    EXPECT_NEAR(light / truth, 1.0, 0.01) << "stride " << stride;
    EXPECT_LE(std::sqrt(off / squares), stride == 2 ? 0.1 : 0.2);
    std::printf("stride %u: energy %.4f, relative RMSE %.4f\n", stride, light / truth, std::sqrt(off / squares));
  }
}

}  // namespace
}  // namespace lightwell
