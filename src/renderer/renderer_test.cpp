#include "lightwell/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <glm/ext/matrix_transform.hpp>

#include "gpu/device.h"
#include "graph/testing/device_test.h"
#include "lightwell/error.h"
#include "renderer/options.h"
#include "renderer/sample_pattern.h"
#include "renderer/test_scene.h"
#include "shaders/lights.h"

namespace lightwell {
namespace {

using RendererTest = DeviceTest;

// Place on the wall that the centre of a pixel sees, with camera_before_wall(_, 2).
glm::vec3 place_on_wall(int x, int y, int side) {
  const float scale = 2.0f / static_cast<float>(side);
  return {(static_cast<float>(x) + 0.5f) * scale - 1.0f, 1.0f - (static_cast<float>(y) + 0.5f) * scale, 0.0f};
}

TEST_F(RendererTest, PointLightOnAWallFollowsTheInverseSquare) {
  TestScene test;
  test.add_wall(test.add_material({0.5f, 0.25f, 1.0f}));
  SceneSnapshot snapshot = take_snapshot(test.scene);
  snapshot.lights.push_back(point_light({0.2f, 0.1f, 0.7f}, {3, 2, 1}));
  Renderer renderer(device(), test.scene, snapshot, square_picture(32));
  const Picture picture = renderer.render({&snapshot, camera_before_wall(3, 2)});
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      const glm::vec3 to_light = snapshot.lights[0].position - place_on_wall(x, y, 32);
      const float squared = glm::dot(to_light, to_light);
      // albedo / pi * I * cos / d^2
      const float red = 0.5f / std::numbers::pi_v<float> * 3.0f * 0.7f / (squared * std::sqrt(squared));
      ASSERT_NEAR(picture.direct.at(x, y)[0], red, 2e-3f * red);
      ASSERT_NEAR(picture.direct.at(x, y)[1], red / 3.0f, 2e-3f * red);
      ASSERT_NEAR(picture.direct.at(x, y)[2], red * 2.0f / 3.0f, 2e-3f * red);
      ASSERT_EQ(picture.indirect.at(x, y)[0], 0.0f);
      ASSERT_EQ(picture.combined.at(x, y)[0], picture.direct.at(x, y)[0]);
    }
  }
}

TEST_F(RendererTest, MoreLightsThanABufferHoldsAreRefused) {
  TestScene test;
  test.add_wall(test.add_material(glm::vec3(0.5f)));
  SceneSnapshot snapshot = take_snapshot(test.scene);
  const SceneSnapshot dark = snapshot;
  const std::size_t most = device().limits().maxStorageBufferRange / sizeof(glsl::GpuLight);
  if (most > 4000000) GTEST_SKIP() << "this device's buffers hold " << most << " lights";
  snapshot.lights.resize(most + 1, point_light({0, 0, 1}, {1, 1, 1}));
  Renderer renderer(device(), test.scene, dark, square_picture(8));
  try {
    renderer.render({&snapshot, camera_before_wall(3, 2)});
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("scene: " + std::to_string(most + 1) + " lights need"))
        << error.what();
  }
  EXPECT_EQ(renderer.render({&dark, camera_before_wall(3, 2)}).combined.width, 8);
}

TEST_F(RendererTest, PartsOfThePicture) {
  TestScene test;
  test.add_wall(test.add_material({0.5f, 0.25f, 1.0f}));
  test.scene.environment.radiance = {1, 2, 3000};
  const Picture picture = test.render(device(), square_picture(16), camera_before_wall(3, 4));
  // The wall fills the middle half.
  EXPECT_NEAR(*picture.depth.at(8, 8), 3.0f, 1e-4f);
  EXPECT_EQ(picture.normal.at(8, 8)[2], 1.0f);
  EXPECT_NEAR(picture.albedo.at(8, 8)[1], 0.25f, 1e-3f);
  EXPECT_EQ(picture.emission.at(8, 8)[2], 0.0f);
  EXPECT_EQ(*picture.depth.at(0, 0), 0.0f);
  EXPECT_EQ(picture.albedo.at(0, 0)[0], 0.0f);
  EXPECT_EQ(picture.normal.at(0, 0)[2], 0.0f);
  EXPECT_EQ(picture.emission.at(0, 0)[2], 3000.0f);
  EXPECT_EQ(picture.combined.at(0, 0)[0], 1.0f);
}

// Vertex colours mix linearly, multiply the material's, and cut holes; what is cut is in no shadow map either.
TEST_F(RendererTest, VertexColorsMultiplyTheBaseColor) {
  for (const bool masked : {false, true}) {
    TestScene test;
    const int material = test.add_material({0.5f, 1.0f, 1.0f});
    if (masked) test.scene.materials.back().alpha_mode = AlphaMode::kMask;
    test.add_wall(material);
    // From left to right: black and see-through to white and opaque.
    const glm::vec4 left(0, 0, 0.25f, masked ? 0 : 1), right(1.0f);
    test.scene.meshes.back().primitives[0].colors = {left, right, right, left};
    const Picture picture = test.render(device(), square_picture(32), camera_before_wall(3, 2));
    for (const int x : {2, 10, 20, 30}) {
      const float part = (static_cast<float>(x) + 0.5f) / 32.0f;
      const bool hole = masked && part < 0.5f;
      EXPECT_NEAR(picture.albedo.at(x, 16)[0], hole ? 0.0f : 0.5f * part, 0.003f);
      EXPECT_NEAR(picture.albedo.at(x, 16)[2], hole ? 0.0f : 0.25f + 0.75f * part, 0.003f);
    }
  }
}

TEST_F(RendererTest, LightsOfARangeEndThere) {
  for (const int shadows : {0, 1}) {
    TestScene test;
    test.add_wall(test.add_material({1, 1, 1}));
    SceneSnapshot snapshot = take_snapshot(test.scene);
    snapshot.lights = {point_light({0, 0, 1}, glm::vec3(1.0f))};
    snapshot.lights[0].range = 1.25f;
    RendererOptions options = square_picture(32);
    options.shadows = shadows;
    const Picture picture =
        Renderer(device(), test.scene, snapshot, options).render({&snapshot, camera_before_wall(3, 2)});
    for (const int x : {16, 20, 24, 31}) {
      const float across = (static_cast<float>(x) + 0.5f) / 16.0f - 1.0f;
      const float square = across * across + 1.0f / 1024.0f + 1.0f;
      const float in_range = std::max(0.0f, 1.0f - square * square / std::pow(1.25f, 4.0f));
      const float expected = in_range / (square * std::sqrt(square)) / std::numbers::pi_v<float>;
      EXPECT_NEAR(picture.direct.at(x, 16)[0], expected, 0.002f) << shadows << " " << x;
    }
  }
}

TEST_F(RendererTest, OrthographicCamerasShowDepthWithoutPerspective) {
  TestScene test;
  const int material = test.add_material({1, 1, 1});
  test.add_quad({-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, material);
  test.add_quad({0, -1, -40}, {1, 0, 0}, {0, 1, 0}, material);
  WorldCamera camera;
  camera.position = {0, 0, 5};
  camera.half_height = 2.0f;
  const Picture picture = test.render(device(), square_picture(64), camera);
  const auto seen = [&](int x, int y) { return picture.albedo.at(x, y)[0] > 0.5f; };
  // A metre is 16 pixels, near and far.
  for (const int i : {1, 14}) {
    EXPECT_TRUE(seen(31 - i, 31 - i));
    EXPECT_TRUE(seen(32 + i, 32 + i));
  }
  EXPECT_FALSE(seen(14, 24));
  EXPECT_FALSE(seen(49, 40));
  EXPECT_FALSE(seen(40, 49));
  EXPECT_NEAR(*picture.depth.at(24, 24), 5.0f, 0.02f);
  EXPECT_NEAR(*picture.depth.at(40, 40), 45.0f, 0.02f);
  EXPECT_EQ(picture.normal.at(40, 40)[2], 1.0f);
}

TEST_F(RendererTest, EnvironmentMapSurroundsTheCamera) {
  TestScene test;
  test.scene.environment.radiance = glm::vec3(1.0f);
  // Red rises from straight up (0) to straight down (1); green rises with u.
  test.scene.environment.map = Image(64, 32, 3);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      test.scene.environment.map.at(x, y)[0] = (static_cast<float>(y) + 0.5f) / 32.0f;
      test.scene.environment.map.at(x, y)[1] = (static_cast<float>(x) + 0.5f) / 64.0f;
    }
  }
  const Picture picture = test.render(device(), square_picture(33), camera_before_wall(1, 1));
  EXPECT_NEAR(picture.emission.at(16, 16)[0], 0.5f, 1e-4f);  // along -z: v = 1/2, u = 1/2
  EXPECT_NEAR(picture.emission.at(16, 16)[1], 0.5f, 1e-4f);
  EXPECT_LT(picture.emission.at(16, 0)[0], 0.45f);
  EXPECT_GT(picture.emission.at(32, 16)[1], 0.55f);  // +x: u > 1/2
}

TEST_F(RendererTest, EmissionLeavesTheFrontUnlessDoubleSided) {
  for (const bool mirrored : {false, true}) {
    for (const bool double_sided : {false, true}) {
      TestScene test;
      const int material = test.add_material(glm::vec3(0.5f), glm::vec3(7.0f));
      test.scene.materials[0].double_sided = double_sided;
      test.add_wall(material);
      SceneSnapshot snapshot = take_snapshot(test.scene);
      if (mirrored) snapshot.instances[0].to_world = glm::scale(glm::mat4(1), glm::vec3(-1, 1, 1));
      WorldCamera front = camera_before_wall(3, 1);
      WorldCamera back = front;
      back.position.z = -3;
      back.forward.z = 1;
      Renderer renderer(device(), test.scene, snapshot, square_picture(4));
      EXPECT_EQ(renderer.render({&snapshot, front}).emission.at(2, 2)[0], 7.0f);
      const Picture seen_from_back = renderer.render({&snapshot, back, true});
      EXPECT_EQ(seen_from_back.emission.at(2, 2)[0], double_sided ? 7.0f : 0.0f);
      EXPECT_EQ(seen_from_back.normal.at(2, 2)[2], -1.0f);  // towards the camera
    }
  }
}

TEST_F(RendererTest, TexturesLieAsTheirCoordinatesSay) {
  TestScene test;
  const int material = test.add_material(glm::vec3(1.0f));
  Texture texture;  // red, green / blue, white; row 0 at v = 0, the lower edge of the wall
  texture.width = 2;
  texture.height = 2;
  texture.nearest = true;
  texture.rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};
  test.scene.textures.push_back(texture);
  test.scene.materials[0].base_color_texture.texture = 0;
  test.add_wall(material);
  const Picture picture = test.render(device(), square_picture(8), camera_before_wall(3, 2));
  const auto expect_color = [&](int x, int y, glm::vec3 color) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(picture.albedo.at(x, y)[c], color[c], 1e-3f) << x << ' ' << y;
  };
  expect_color(1, 6, {1, 0, 0});
  expect_color(6, 6, {0, 1, 0});
  expect_color(1, 1, {0, 0, 1});
  expect_color(6, 1, {1, 1, 1});
}

TEST_F(RendererTest, AlphaMasksLetSightAndLightThrough) {
  TestScene test;
  const int wall = test.add_material(glm::vec3(1.0f));
  const int screen = test.add_material({0, 1, 0});
  Texture texture;  // left half cut out
  texture.width = 2;
  texture.height = 1;
  texture.nearest = true;
  texture.rgba = {255, 255, 255, 0, 255, 255, 255, 255};
  test.scene.textures.push_back(texture);
  test.scene.materials[1].base_color_texture.texture = 0;
  test.scene.materials[1].alpha_mode = AlphaMode::kMask;
  test.add_wall(wall);
  test.add_quad({-1, -1, 0.5f}, {2, 0, 0}, {0, 2, 0}, screen);
  SceneSnapshot snapshot = take_snapshot(test.scene);
  WorldLight sun;
  sun.type = LightType::kDirectional;
  sun.intensity = glm::vec3(std::numbers::pi_v<float>);
  snapshot.lights.push_back(sun);
  // From the side of the light: through the cut-out half to the lit wall, or to the screen.
  Renderer renderer(device(), test.scene, snapshot, square_picture(16));
  const Picture picture = renderer.render({&snapshot, camera_before_wall(10, 1.8f)});
  EXPECT_NEAR(picture.direct.at(3, 8)[0], 1.0f, 1e-3f);
  EXPECT_NEAR(*picture.depth.at(3, 8), 10.0f, 1e-3f);
  EXPECT_EQ(picture.albedo.at(12, 8)[0], 0.0f);
  EXPECT_NEAR(*picture.depth.at(12, 8), 9.5f, 1e-3f);
  // From below the screen: only the part of the wall behind the cut-out half is lit.
  WorldCamera under = camera_before_wall(0.3f, 0.6f);
  under.position.x = -0.5f;
  EXPECT_NEAR(renderer.render({&snapshot, under, true}).direct.at(8, 8)[0], 1.0f, 1e-3f);
  under.position.x = 0.5f;
  EXPECT_EQ(renderer.render({&snapshot, under, true}).direct.at(8, 8)[0], 0.0f);
}

TEST_F(RendererTest, ShadowsFollowWhatMoves) {
  TestScene test;
  test.add_wall(test.add_material(glm::vec3(1.0f)));
  test.add_quad({-0.2f, -0.2f, 0.5f}, {0.4f, 0, 0}, {0, 0.4f, 0}, test.add_material(glm::vec3(1.0f)));
  SceneSnapshot snapshot = take_snapshot(test.scene);
  snapshot.lights.push_back(point_light({0, 0, 1}, glm::vec3(1)));
  WorldCamera camera = camera_before_wall(0.3f, 0.2f);  // between wall and blocker
  Renderer renderer(device(), test.scene, snapshot, square_picture(8));
  EXPECT_EQ(renderer.render({&snapshot, camera}).direct.at(4, 4)[0], 0.0f);
  snapshot.instances[1].to_world = glm::translate(glm::mat4(1), glm::vec3(0.8f, 0, 0));
  EXPECT_GT(renderer.render({&snapshot, camera}).direct.at(4, 4)[0], 0.1f);
  snapshot.lights[0].position.x = 0.8f;
  snapshot.instances[1].to_world = glm::translate(glm::mat4(1), glm::vec3(0.4f, 0, 0));
  EXPECT_EQ(renderer.render({&snapshot, camera}).direct.at(4, 4)[0], 0.0f);
}

TEST_F(RendererTest, MotionIsInPixels) {
  TestScene test;
  test.add_wall(test.add_material(glm::vec3(1.0f)));
  SceneSnapshot snapshot = take_snapshot(test.scene);
  RendererOptions options = square_picture(16);
  options.debug_views = {"motion"};
  Renderer renderer(device(), test.scene, snapshot, options);
  WorldCamera camera = camera_before_wall(3, 1);
  renderer.render({&snapshot, camera});
  EXPECT_NEAR(renderer.debug_images().at("motion").at(8, 8)[0], 0.0f, 1e-4f);
  // The wall goes an eighth of the picture up, then the camera as much to the left.
  snapshot.instances[0].to_world = glm::translate(glm::mat4(1), glm::vec3(0, 0.125f, 0));
  renderer.render({&snapshot, camera});
  EXPECT_NEAR(renderer.debug_images().at("motion").at(8, 8)[1], -2.0f, 1e-2f);
  camera.position.x -= 0.125f;
  renderer.render({&snapshot, camera});
  EXPECT_NEAR(renderer.debug_images().at("motion").at(8, 8)[0], 2.0f, 1e-2f);
  EXPECT_NEAR(renderer.debug_images().at("motion").at(8, 8)[1], 0.0f, 1e-2f);
}

TEST_F(RendererTest, SamplesSmoothEdgesAndCountFrames) {
  TestScene test;
  test.add_quad({0, -1, 0}, {1, 0, 0}, {0, 2, 0}, test.add_material({1, 0, 0}));
  // The edge x = 0 runs through the middle of the centre column.
  RendererOptions options = square_picture(9);
  options.samples = 64;
  const SceneSnapshot snapshot = take_snapshot(test.scene);
  Renderer renderer(device(), test.scene, snapshot, options);
  const Picture picture = renderer.render({&snapshot, camera_before_wall(3, 2)});
  // Drivers round corners to a grid in the pixel: the edge may lie half a step beside its place.
  const float snap = 0.5f / static_cast<float>(1u << device().limits().subPixelPrecisionBits);
  EXPECT_NEAR(picture.albedo.at(4, 4)[0], 0.5f, snap + 1.0f / 64.0f);
  EXPECT_NEAR(*picture.depth.at(4, 4), 3.0f, 1e-4f);  // of what is seen, not mixed with nothing
  EXPECT_EQ(picture.albedo.at(3, 4)[0], 0.0f);
  EXPECT_EQ(renderer.statistics().frames, 64);
  EXPECT_EQ(renderer.statistics().triangles, 2u);
  EXPECT_GT(renderer.statistics().memory_bytes.at("position"), 9u * 9 * 16 - 1);
}

TEST_F(RendererTest, SameInputsGiveTheSameBytes) {
  TestScene test;
  test.add_wall(test.add_material({0.3f, 0.6f, 0.9f}));
  test.add_quad({-0.2f, -0.2f, 0.5f}, {0.4f, 0.1f, 0}, {0, 0.4f, 0.2f}, test.add_material(glm::vec3(1.0f)));
  SceneSnapshot snapshot = take_snapshot(test.scene);
  snapshot.lights.push_back(point_light({0.3f, 0.2f, 1}, glm::vec3(1)));
  test.scene.environment.radiance = glm::vec3(0.5f);
  for (const char* technique : {"none", "light-volume"}) {
    for (const int shadows : {0, 1}) {
      RendererOptions options = square_picture(32);
      options.technique = technique;
      if (options.technique == "light-volume") options.technique_options = {"resolution=8"};
      options.shadows = shadows;
      options.samples = 3;
      options.frames = 5;
      const auto render = [&] {
        return Renderer(device(), test.scene, snapshot, options).render({&snapshot, camera_before_wall(2, 2)});
      };
      EXPECT_EQ(render().combined.pixels, render().combined.pixels) << technique << ", shadows " << shadows;
    }
  }
}

TEST_F(RendererTest, EmptySceneIsBlack) {
  const Picture picture = TestScene().render(device(), square_picture(4), camera_before_wall(1, 1));
  for (const float value : picture.combined.pixels) EXPECT_EQ(value, 0.0f);
}

TEST_F(RendererTest, BadOptionsAreNamed) {
  const auto message = [&](const RendererOptions& options) -> std::string {
    try {
      TestScene().render(device(), options, camera_before_wall(1, 1));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  RendererOptions options = square_picture(0);
  EXPECT_EQ(message(options).find("size: 0x0"), 0u);
  options = square_picture(100000);
  EXPECT_EQ(message(options).find("size: 100000x100000"), 0u);
  options = square_picture(4);
  options.technique = "magic";
  EXPECT_EQ(message(options).find("technique: 'magic' is unknown; there are: none"), 0u);
  options.technique = "none";
  options.samples = 0;
  EXPECT_EQ(message(options).find("samples: 0"), 0u);
  options.samples = 1;
  options.tracing = 3;
  EXPECT_EQ(message(options).find("tracing: 3 is not in 0 to 2"), 0u);
  options.tracing = 0;
  options.debug_views = {"nothing"};
  EXPECT_EQ(message(options).find("debug view: 'nothing' is unknown"), 0u);
}

TEST_F(RendererTest, TracingIsWhatTheOptionSays) {
  EXPECT_EQ(fixed_tracing(device(), 0), std::nullopt);
  EXPECT_EQ(fixed_tracing(device(), 1), Tracing::kBvh);
  if (device().has_ray_query()) {
    EXPECT_EQ(fixed_tracing(device(), 2), Tracing::kRayQuery);
    return;
  }
  try {
    fixed_tracing(device(), 2);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.what(), "tracing: " + device().summary().name + " has no ray queries");
  }
}

// Choosing compiles and measures, which takes seconds on software devices.
TEST_F(RendererTest, ShadowMapsAreThereOnlyForWhoReadsThem) {
  TestScene test;
  test.add_wall(test.add_material(glm::vec3(0.5f)));
  SceneSnapshot snapshot = take_snapshot(test.scene);
  snapshot.lights.push_back(point_light({0, 0, 1}, {1, 1, 1}));
  for (const bool rays : {true, false}) {
    RendererOptions options = square_picture(8);
    options.shadows = rays ? 1 : 0;
    Renderer renderer(device(), test.scene, snapshot, options);
    renderer.render({&snapshot, camera_before_wall(3, 2)});
    const RenderStatistics& statistics = renderer.statistics();
    const bool drawn = std::any_of(statistics.passes.begin(), statistics.passes.end(),
                                   [](const PassStatistics& pass) { return pass.name.starts_with("shadow maps"); });
    EXPECT_EQ(drawn, !rays);
    EXPECT_EQ(statistics.memory_bytes.contains("shadow atlas"), !rays);
  }
}

TEST_F(RendererTest, WhoTracesIsChosenOnlyWhereSomethingTraces) {
  if (!device().has_ray_query()) GTEST_SKIP() << device().summary().name << " has no ray queries";
  const std::optional<bool> measured = std::exchange(device().prefers_ray_query, {});
  TestScene test;
  test.add_wall(test.add_material(glm::vec3(1.0f)));
  test.render(device(), square_picture(4), camera_before_wall(1, 1));
  EXPECT_FALSE(device().prefers_ray_query.has_value());
  test.scene.environment.radiance = glm::vec3(1.0f);
  test.render(device(), square_picture(4), camera_before_wall(1, 1));
  EXPECT_TRUE(device().prefers_ray_query.has_value());
  device().prefers_ray_query = measured;
}

TEST(SamplePattern, IsStratifiedAndCentred) {
  EXPECT_EQ(sample_position(0, 1), glm::vec2(0.0f));
  for (const std::uint32_t count : {2u, 16u, 64u, 100u}) {
    glm::vec2 sum(0.0f);
    for (std::uint32_t i = 0; i < count; ++i) {
      const glm::vec2 position = sample_position(i, count);
      EXPECT_LE(std::abs(position.x), 0.5f);
      EXPECT_LE(std::abs(position.y), 0.5f);
      sum += position;
    }
    EXPECT_NEAR(sum.x / static_cast<float>(count), 0.0f, 1e-5f);
    EXPECT_NEAR(sum.y / static_cast<float>(count), 0.0f, count == 100 ? 0.05f : 1e-5f);
  }
}

}  // namespace
}  // namespace lightwell
