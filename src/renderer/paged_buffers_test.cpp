// Scenes beyond what a descriptor reaches: on a device whose descriptors are made to reach less, pictures stay the
// same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "lightwell/error.h"
#include "renderer/test_scene.h"

namespace lightwell {
namespace {

constexpr std::uint64_t kRange = std::uint64_t{1} << 20;

// A wavy floor of side x side quads below a lamp, with a wall at its end.
TestScene make_terrain(std::uint32_t side) {
  TestScene test;
  const int gray = test.add_material({0.6f, 0.5f, 0.4f});
  test.add_quad({-1, -0.5f, -1}, {2, 0, 0}, {0, 2, 0}, test.add_material({0.2f, 0.6f, 0.3f}, glm::vec3(0.5f)));
  Primitive floor;
  for (std::uint32_t z = 0; z <= side; ++z) {
    for (std::uint32_t x = 0; x <= side; ++x) {
      const glm::vec2 p = glm::vec2(x, z) * (2.0f / static_cast<float>(side)) - 1.0f;
      floor.positions.emplace_back(p.x, 0.1f * std::sin(9.0f * p.x) * std::cos(7.0f * p.y) - 0.5f, p.y);
      floor.normals.emplace_back(0, 1, 0);
    }
  }
  for (std::uint32_t z = 0; z < side; ++z) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t a = z * (side + 1) + x;
      const std::uint32_t c = a + side + 1;
      floor.indices.insert(floor.indices.end(), {a, c, a + 1, a + 1, c, c + 1});
    }
  }
  floor.material = gray;
  Node node;
  node.mesh = static_cast<int>(test.scene.meshes.size());
  test.scene.meshes.emplace_back().primitives.push_back(std::move(floor));
  test.scene.nodes.push_back(node);
  return test;
}

class PagedBuffersTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device on this machine";
  }

  // With a device of its own, whose range is another one, and our own hierarchy: choosing would measure with more rays.
  static Picture render(const TestScene& test, RendererOptions options, std::uint64_t range) {
    options.tracing = 1;
    Device device({.device = "", .validation = true});
    if (range != 0) device.limit_descriptor_range(range);
    SceneSnapshot snapshot = take_snapshot(test.scene);
    snapshot.lights.push_back(point_light({0.3f, 0.8f, 0.2f}, glm::vec3(3)));
    WorldCamera camera = camera_before_wall(2.5f, 2);
    Picture picture = Renderer(device, test.scene, snapshot, options).render({&snapshot, camera});
    for (const std::string& message : device.validation_messages()) ADD_FAILURE() << message;
    return picture;
  }

  static void expect_same(const Image& paged, const Image& whole) {
    ASSERT_EQ(paged.pixels.size(), whole.pixels.size());
    for (std::size_t i = 0; i < paged.pixels.size(); ++i) ASSERT_EQ(paged.pixels[i], whole.pixels[i]) << "value " << i;
  }

  static void expect_same_pictures(const TestScene& test, const RendererOptions& options) {
    const Picture whole = render(test, options, 0);
    const Picture paged = render(test, options, kRange);
    expect_same(paged.direct, whole.direct);
    expect_same(paged.indirect, whole.indirect);
    double light = 0.0;
    for (const float value : whole.direct.pixels) light += value;
    EXPECT_GT(light, 0.0);
  }
};

// Vertices in three pages, the hierarchy's nodes in three and its triangles in four; the builder's boxes in three.
TEST_F(PagedBuffersTest, RaysAndLightVolume) {
  RendererOptions options = square_picture(32);
  options.technique = "light-volume";
  options.technique_options = {"resolution=8", "links=32"};
  options.shadows = 1;
  options.light_samples = 1;
  options.frames = 6;
  expect_same_pictures(make_terrain(185), options);
}

// 50,000 faces would take 5 MiB of one buffer that is not in pages: there is room for as many as it holds.
TEST_F(PagedBuffersTest, FacesOfTheLightVolume) {
  RendererOptions options = square_picture(32);
  options.technique = "light-volume";
  options.technique_options = {"resolution=32", "links=32"};
  options.light_samples = 0;
  options.frames = 6;
  const TestScene test = make_terrain(100);
  expect_same_pictures(test, options);
  const Picture picture = render(test, options, kRange);
  EXPECT_GT(*std::max_element(picture.indirect.pixels.begin(), picture.indirect.pixels.end()), 0.0f);
}

// Vertices in four pages, indices in two.
TEST_F(PagedBuffersTest, ShadowMaps) {
  RendererOptions options = square_picture(32);
  options.light_samples = 0;
  expect_same_pictures(make_terrain(250), options);
}

TEST_F(PagedBuffersTest, MoreThanItsPagesHoldIsRefused) {
  try {
    render(make_terrain(300), square_picture(8), kRange);
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "scene: object vertices need 4 MiB; on this device 'world vertices' reaches 3 MiB");
  }
}

}  // namespace
}  // namespace lightwell
