// Sampled direct light of emitters and of the environment against the path tracer and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "core/luminance.h"
#include "graph/testing/device_test.h"
#include "light_frames.h"
#include "lightwell/metrics.h"
#include "lightwell/path_tracer.h"
#include "renderer/test_scene.h"
#include "scene/builtin.h"

namespace lightwell {
namespace {

constexpr int kSide = 32;
constexpr float kHeight = 1.0f;  // of the light above the wall z = 0, m

using Corners = std::vector<glm::dvec3>;

// Irradiance at `p` on a surface with `normal` from a polygon of uniform radiance 1 above its horizon (Lambert 1760):
// half the sum over the edges of the angle that one subtends, times the cosine to the plane through it and p.
double polygon_irradiance(const Corners& corners, const glm::dvec3& p, const glm::dvec3& normal) {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 a = glm::normalize(corners[i] - p);
    const glm::dvec3 b = glm::normalize(corners[(i + 1) % corners.size()] - p);
    const glm::dvec3 axis = glm::cross(a, b);
    if (glm::length(axis) > 0.0)
      sum += std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)) * glm::dot(normal, glm::normalize(axis));
  }
  return 0.5 * std::abs(sum);
}

// The wall z = 0 seen from below the light: 2 x 2 m fill the picture.
constexpr float kCameraHeight = 0.9f * kHeight;

glm::dvec3 point_on_wall(int x, int y) {
  return {2.0 * (x + 0.5) / kSide - 1.0, 1.0 - 2.0 * (y + 0.5) / kSide, 0.0};
}

// A 1 x 1 m light that faces the wall.
const Corners kLight{{-0.5, -0.5, kHeight}, {-0.5, 0.5, kHeight}, {0.5, 0.5, kHeight}, {0.5, -0.5, kHeight}};

TestScene wall_under_light(const glm::vec3& radiance) {
  TestScene test;
  test.add_wall(test.add_material(glm::vec3(1.0f)));
  test.add_quad({-0.5f, -0.5f, kHeight}, {0, 1, 0}, {1, 0, 0}, test.add_material(glm::vec3(0.0f), radiance));
  return test;
}

double luminance_of(const float* rgb) {
  return luminance(glm::dvec3(rgb[0], rgb[1], rgb[2]));
}

class SampledLightTest : public DeviceTest {
 protected:
  static LightFrames frames_of(Scene scene, const SampledLights::Settings& settings = {}, int side = kSide) {
    return LightFrames(device(), std::move(scene), static_cast<std::uint32_t>(side), settings);
  }
  static LightFrames frames_of_wall(const TestScene& test, const SampledLights::Settings& settings = {}) {
    return LightFrames(device(), test.scene, kSide, settings, camera_before_wall(kCameraHeight, 2.0f));
  }

  static Image path_traced(const Scene& scene, const LightFrames& frames, int side, int samples) {
    PathTracerOptions options;
    options.width = side;
    options.height = side;
    options.samples = samples;
    options.max_bounces = 0;
    return PathTracer(scene, frames.world).render(frames.camera, options).direct;
  }

  static void expect_path_traced(const Scene& scene, int side, int samples) {
    LightFrames frames = frames_of(scene, {}, side);
    const Metrics direct = compute_metrics(frames.direct(64, 8), path_traced(scene, frames, side, samples));
    RecordProperty("energy", std::to_string(direct.energy));
    RecordProperty("ssim", std::to_string(direct.ssim));
    EXPECT_GT(direct.mean_reference, 0.0);
    EXPECT_NEAR(direct.energy, 1.0, 0.01);
    EXPECT_GE(direct.ssim, 0.97);
  }

  // Root mean square over the wall of (irradiance / truth - 1).
  template <class Truth>
  static double relative_error(const Image& irradiance, const Truth& truth) {
    double sum = 0.0;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const double error = luminance_of(irradiance.at(x, y)) / truth(point_on_wall(x, y)) - 1.0;
        sum += error * error;
      }
    }
    return std::sqrt(sum / (kSide * kSide));
  }

  static double light_irradiance(const glm::dvec3& p) { return polygon_irradiance(kLight, p, {0, 0, 1}); }
};

// ---- pictures ----

TEST_F(SampledLightTest, AnAreaLightsPictureIsThePathTracers) {
  expect_path_traced(load_scene(resolve_scene("cornell-box")), 96, 256);
}

// A table on open ground.
Scene open_scene() {
  TestScene test;
  const int ground = test.add_material({0.5f, 0.6f, 0.7f});
  const int wood = test.add_material({0.7f, 0.5f, 0.3f});
  test.add_quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, ground);
  test.add_quad({-1, 1, 1}, {2, 0, 0}, {0, 0, -2}, wood);
  test.add_quad({-1, 0, -1}, {2, 0, 0}, {0, 1, 0}, wood);
  Camera camera;
  camera.yfov = 0.8f;
  Node node;
  node.camera = 0;
  node.translation = {1.5f, 2.5f, 5.0f};
  node.rotation = glm::quat(glm::vec3(-0.4f, 0.25f, 0.0f));
  test.scene.cameras.push_back(camera);
  test.scene.nodes.push_back(node);
  return test.scene;
}

TEST_F(SampledLightTest, AConstantSkysPictureIsThePathTracers) {
  Scene scene = open_scene();
  scene.environment.radiance = {0.8f, 1.0f, 1.2f};
  expect_path_traced(scene, 96, 256);
}

// A dim sky, darker at the horizon, with a sun of three by three texels that gives half of the light.
TEST_F(SampledLightTest, ASunnySkysPictureIsThePathTracers) {
  Scene scene = open_scene();
  scene.environment.radiance = glm::vec3(1.0f);
  scene.environment.map = Image(128, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) {
      const bool sun = std::abs(x - 40) <= 1 && std::abs(y - 18) <= 1;
      float* rgb = scene.environment.map.at(x, y);
      rgb[0] = sun ? 400.0f : 0.3f;
      rgb[1] = sun ? 350.0f : 0.4f;
      rgb[2] = sun ? 300.0f : 0.6f * static_cast<float>(64 - y) / 64.0f;
    }
  }
  expect_path_traced(scene, 96, 256);
}

TEST_F(SampledLightTest, TheMeasuredCornellBoxIsAnotherRenderers) {
  const std::string folder = std::string(LIGHTWELL_SHARED_DIR) + "/references/cornell_original/";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no reference images: " << folder << " is missing";
  LightFrames frames = frames_of(load_scene(folder + "cornell_original.glb"), {}, 128);
  const Image direct = frames.direct(64, 16);
  const Image full = load_image(folder + "cam0_direct.exr");
  const Image full_mask = load_image(folder + "cam0_mask.png");
  ASSERT_EQ(full.width, 256);
  Image reference(128, 128);
  Image mask(128, 128);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      for (int c = 0; c < 3; ++c) {
        reference.at(x / 2, y / 2)[c] += 0.25f * full.at(x, y)[c];
        mask.at(x / 2, y / 2)[c] += full_mask.at(x, y)[c] > 0.5f ? 0.25f : 0.0f;
      }
    }
  }
  for (float& value : mask.pixels) value = value > 0.9f ? 1.0f : 0.0f;
  const Metrics all = compute_metrics(direct, reference);
  const Metrics inside = compute_metrics(direct, reference, {.mask = &mask});
  RecordProperty("energy", std::to_string(inside.energy));
  RecordProperty("ssim", std::to_string(all.ssim));
  EXPECT_NEAR(all.energy, 1.0, 0.01);
  EXPECT_NEAR(inside.energy, 1.0, 0.01);
  EXPECT_GE(all.ssim, 0.97);
}

// ---- closed forms ----

// Every direction meets a wall of radiance 1: E = pi, for each pixel, however close the next wall.
TEST_F(SampledLightTest, InsideAFurnaceIrradianceIsPi) {
  LightFrames frames = frames_of(load_scene(resolve_scene("furnace")), {.samples = 16});
  for (int i = 0; i < 63; ++i) frames.next();
  const Image irradiance = frames.next();
  const auto [low, high] = std::minmax_element(irradiance.pixels.begin(), irradiance.pixels.end());
  EXPECT_GT(*low, 0.99 * std::numbers::pi);
  EXPECT_LT(*high, 1.01 * std::numbers::pi);
}

TEST_F(SampledLightTest, AQuadLightsAWallAsItsFormFactorSays) {
  LightFrames frames = frames_of_wall(wall_under_light({1, 1, 1}));
  for (int i = 0; i < 63; ++i) frames.next();
  EXPECT_FALSE(frames.steady);
  const Image irradiance = frames.next();
  EXPECT_TRUE(frames.steady);
  EXPECT_LT(relative_error(irradiance, light_irradiance), 0.01);
}

// Random samples would leave a quarter of the error after 16 times as many.
TEST_F(SampledLightTest, UnblockedLightConvergesFasterThanRandomSamples) {
  std::vector<double> errors;
  LightFrames frames = frames_of_wall(wall_under_light({1, 1, 1}), {.filter = false});
  for (int i = 1; i <= 64; ++i) {
    const Image irradiance = frames.next();
    if (i == 1 || i == 4 || i == 64) errors.push_back(relative_error(irradiance, light_irradiance));
  }
  RecordProperty("error_1", std::to_string(errors[0]));
  RecordProperty("error_4", std::to_string(errors[1]));
  RecordProperty("error_64", std::to_string(errors[2]));
  EXPECT_LT(errors[1], errors[0] / 2.5);
  EXPECT_LT(errors[2], errors[1] / 12.0);
}

// A texture of one black and one white texel: the light is its half where y is positive.
TEST_F(SampledLightTest, ATexturedLightIsWhereItsTextureIs) {
  TestScene test = wall_under_light({1, 1, 1});
  Texture texture;
  texture.width = 2;
  texture.height = 1;
  texture.rgba = {0, 0, 0, 255, 255, 255, 255, 255};
  texture.nearest = true;
  texture.wrap_u = texture.wrap_v = Wrap::kClampToEdge;
  test.scene.textures.push_back(texture);
  test.scene.materials.back().emission_texture.texture = 0;
  // u runs along the first edge, which is y.
  const Corners half{{-0.5, 0.0, kHeight}, {-0.5, 0.5, kHeight}, {0.5, 0.5, kHeight}, {0.5, 0.0, kHeight}};
  LightFrames frames = frames_of_wall(test, {.samples = 16});
  for (int i = 0; i < 63; ++i) frames.next();
  const auto truth = [&](const glm::dvec3& p) { return polygon_irradiance(half, p, {0, 0, 1}); };
  EXPECT_LT(relative_error(frames.next(), truth), 0.02);
}

TEST_F(SampledLightTest, LightLeavesTheFrontOnly) {
  TestScene test;
  test.add_wall(test.add_material(glm::vec3(1.0f)));
  test.add_quad({-0.5f, -0.5f, kHeight}, {1, 0, 0}, {0, 1, 0}, test.add_material(glm::vec3(0.0f), {1, 1, 1}));
  LightFrames dark = frames_of_wall(test);
  for (int i = 0; i < 4; ++i) {
    const Image irradiance = dark.next();
    EXPECT_EQ(*std::max_element(irradiance.pixels.begin(), irradiance.pixels.end()), 0.0f);
  }
  test.scene.materials.back().double_sided = true;
  LightFrames lit = frames_of_wall(test);
  for (int i = 0; i < 63; ++i) lit.next();
  EXPECT_LT(relative_error(lit.next(), light_irradiance), 0.01);
}

// An instance turned over by a negative scale: its front is the mirror image of the front.
TEST_F(SampledLightTest, AMirroredLightShinesFromItsFront) {
  for (const bool towards : {true, false}) {
    TestScene test = wall_under_light({1, 1, 1});
    Node& light = test.scene.nodes.back();
    light.scale = towards ? glm::vec3(-1, 1, 1) : glm::vec3(1, 1, -1);
    if (!towards) light.translation = {0, 0, 2.0f * kHeight};
    LightFrames frames = frames_of_wall(test);
    for (int i = 0; i < 63; ++i) frames.next();
    const Image irradiance = frames.next();
    if (towards) {
      EXPECT_LT(relative_error(irradiance, light_irradiance), 0.01);
    } else {
      EXPECT_EQ(*std::max_element(irradiance.pixels.begin(), irradiance.pixels.end()), 0.0f);
    }
  }
}

// 5000 triangles, more than the sums over groups take in one slice each; the left ones are a hundred times brighter.
TEST_F(SampledLightTest, ManyEmittersAreChosenByTheirPower) {
  TestScene test;
  test.add_wall(test.add_material(glm::vec3(1.0f)));
  const int dim = test.add_material(glm::vec3(0.0f), glm::vec3(0.1f));
  const int bright = test.add_material(glm::vec3(0.0f), glm::vec3(10.0f));
  Primitive grids[2];
  for (int i = 0; i < 2500; ++i) {
    Primitive& grid = grids[i % 50 < 25 ? 0 : 1];
    const glm::vec3 corner{-0.5f + 0.02f * static_cast<float>(i % 50), -0.5f + 0.02f * static_cast<float>(i / 50),
                           kHeight};
    const auto first = static_cast<std::uint32_t>(grid.positions.size());
    for (const glm::vec3& offset : {glm::vec3{0, 0, 0}, {0, 0.02f, 0}, {0.02f, 0.02f, 0}, {0.02f, 0, 0}})
      grid.positions.push_back(corner + offset);
    for (const std::uint32_t j : {0, 1, 2, 0, 2, 3}) grid.indices.push_back(first + j);
  }
  for (int side = 0; side < 2; ++side) {
    grids[side].normals.assign(grids[side].positions.size(), {0, 0, -1});
    grids[side].material = side == 0 ? bright : dim;
    Node node;
    node.mesh = static_cast<int>(test.scene.meshes.size());
    test.scene.meshes.emplace_back().primitives.push_back(grids[side]);
    test.scene.nodes.push_back(node);
  }
  const Corners left{{-0.5, -0.5, kHeight}, {-0.5, 0.5, kHeight}, {0.0, 0.5, kHeight}, {0.0, -0.5, kHeight}};
  const Corners right{{0.0, -0.5, kHeight}, {0.0, 0.5, kHeight}, {0.5, 0.5, kHeight}, {0.5, -0.5, kHeight}};
  LightFrames frames = frames_of_wall(test, {.samples = 16});
  for (int i = 0; i < 63; ++i) frames.next();
  const auto truth = [&](const glm::dvec3& p) {
    return 10.0 * polygon_irradiance(left, p, {0, 0, 1}) + 0.1 * polygon_irradiance(right, p, {0, 0, 1});
  };
  EXPECT_LT(relative_error(frames.next(), truth), 0.015);
}

// ---- where rays start ----

class SkyOverGround : public SampledLightTest, public ::testing::WithParamInterface<float> {};

// Open ground far from the origin, seen from close by to the horizon: no ray may meet the ground that it starts from.
TEST_P(SkyOverGround, NothingBlocksIt) {
  const float scale = GetParam();
  TestScene test;
  const glm::vec3 place{3.7f, 11.3f, -5.1f};
  test.add_quad(scale * (place + glm::vec3(-100, 10, 100)), scale * glm::vec3(200, 7, 0),
                scale * glm::vec3(0, 13, -200), test.add_material(glm::vec3(0.5f)));
  test.scene.environment.radiance = {1, 1, 1};
  WorldCamera camera;
  camera.position = scale * (place + glm::vec3(0, 21.5f, 0));
  camera.znear = 0.01f * scale;
  LightFrames frames(device(), test.scene, 64, {.filter = false}, camera);
  const Image irradiance = frames.next();
  int lit = 0;
  int dark = 0;
  for (std::size_t i = 0; i < irradiance.pixels.size(); i += 3) {
    if (irradiance.pixels[i] == 0.0f) continue;
    ++lit;
    if (irradiance.pixels[i] < 0.999f * static_cast<float>(std::numbers::pi)) ++dark;
  }
  EXPECT_GT(lit, 1000);
  EXPECT_EQ(dark, 0);
}

INSTANTIATE_TEST_SUITE_P(Metres, SkyOverGround, ::testing::Values(1e-5f, 1.0f, 1e5f));

// A closed room, corners and all: not a ray gets out. Where the rasteriser rounds corners to a coarse grid, a few
// pixels along edges may show points beyond a wall's end.
TEST_F(SampledLightTest, AClosedRoomSeesNoSky) {
  Scene scene = load_scene(resolve_scene("boxes"));
  scene.environment.radiance = {1, 1, 1};
  LightFrames frames = frames_of(scene, {.samples = 4, .filter = false}, 128);
  const Image irradiance = frames.next();
  const bool fine = device().limits().subPixelPrecisionBits >= 8;
  EXPECT_LE(std::count_if(irradiance.pixels.begin(), irradiance.pixels.end(), [](float e) { return e != 0.0f; }),
            fine ? 0 : static_cast<std::ptrdiff_t>(irradiance.pixels.size() / 1000));
}

// Vertex normals tilted away from the face: light below the face does not come through it.
TEST_F(SampledLightTest, LightBelowTheFaceGivesNothing) {
  TestScene test;
  test.add_wall(test.add_material(glm::vec3(1.0f)));
  test.scene.meshes[0].primitives[0].normals.assign(4, glm::normalize(glm::vec3(2, 0, 1)));
  // Beside the wall and behind its plane, but before the tilted normal's.
  test.add_quad({1.5f, -0.5f, -0.9f}, {0, 0, 0.8f}, {0, 1, 0}, test.add_material(glm::vec3(0.0f), {1, 1, 1}));
  test.scene.materials.back().double_sided = true;
  LightFrames frames = frames_of_wall(test, {.samples = 16});
  const Image irradiance = frames.next();
  EXPECT_EQ(*std::max_element(irradiance.pixels.begin(), irradiance.pixels.end()), 0.0f);
}

// ---- time ----

// What the filter takes from one pixel it gives to another, and it leaves the picture nearer to the truth.
TEST_F(SampledLightTest, TheFilterKeepsTheLightAndTakesTheNoise) {
  const Scene scene = load_scene(resolve_scene("cornell-box"));
  LightFrames rough = frames_of(scene, {.filter = false}, 96);
  LightFrames smooth = frames_of(scene, {}, 96);
  LightFrames long_run = frames_of(scene, {.samples = 16, .filter = false}, 96);
  Image truth;
  for (int i = 0; i < 32; ++i) truth = long_run.next();
  // A rasteriser with a coarse grid puts points of an edge between two walls behind one of them, where no light is:
  // what such pixels should show is nobody's to say.
  const bool fine = device().limits().subPixelPrecisionBits >= 8;
  Image counted(96, 96, 1);
  for (std::size_t k = 0; k < counted.pixels.size(); ++k)
    counted.pixels[k] = fine || truth.pixels[3 * k] > 0.0f ? 1.0f : 0.0f;
  MetricOptions options;
  options.mask = &counted;
  for (int i = 1; i <= 16; ++i) {
    const Image noisy = rough.next();
    const Image filtered = smooth.next();
    if ((i & (i - 1)) != 0) continue;
    EXPECT_NEAR(compute_metrics(noisy, truth).energy, 1.0, 0.01) << i << " frames";
    EXPECT_NEAR(compute_metrics(filtered, truth).energy, 1.0, 0.01) << i << " frames";
    const double without = compute_metrics(noisy, truth, options).rel_mse;
    const double with = compute_metrics(filtered, truth, options).rel_mse;
    // Where little noise is left, softened edges of shadows may weigh as much.
    EXPECT_LT(with, (i == 1 ? 0.3 : i < 8 ? 1.0 : 1.5) * without) << i << " frames";
  }
}

// A hole in the ceiling that one ray in a hundred leaves through: what a pixel's rays miss, its neighbours' rays find.
TEST_F(SampledLightTest, FewPixelsStayBlackWhereLightIsRare) {
  TestScene test;
  const int white = test.add_material(glm::vec3(1.0f));
  test.add_wall(white);
  constexpr float kHole = 0.1f;  // half of its side, m
  constexpr float kFar = 200.0f;
  test.add_quad({-kFar, kHole, kHeight}, {0, kFar, 0}, {2 * kFar, 0, 0}, white);
  test.add_quad({-kFar, -kFar, kHeight}, {0, kFar - kHole, 0}, {2 * kFar, 0, 0}, white);
  test.add_quad({-kFar, -kHole, kHeight}, {0, 2 * kHole, 0}, {kFar - kHole, 0, 0}, white);
  test.add_quad({kHole, -kHole, kHeight}, {0, 2 * kHole, 0}, {kFar, 0, 0}, white);
  test.scene.environment.radiance = glm::vec3(1.0f);
  LightFrames frames = frames_of_wall(test);
  for (int i = 0; i < 23; ++i) frames.next();
  const Image irradiance = frames.next();
  int black = 0;
  for (int i = 0; i < kSide * kSide; ++i) black += irradiance.pixels[static_cast<std::size_t>(3 * i)] == 0.0f ? 1 : 0;
  RecordProperty("black", black);
  EXPECT_LT(black, kSide * kSide / 50);
}

// Frame by frame the light moves 2 cm: the picture is that of a few frames ago, and nothing of the way there is left
// when the light has stood still for 64 frames.
TEST_F(SampledLightTest, AMovingLightIsFollowed) {
  const TestScene test = wall_under_light({1, 1, 1});
  LightFrames frames = frames_of_wall(test);
  const auto truth_at = [](double moved) {
    return [moved](const glm::dvec3& p) { return light_irradiance(p - glm::dvec3(moved, 0, 0)); };
  };
  for (int i = 0; i < 32; ++i) frames.next();
  Image irradiance;
  for (int i = 1; i <= 25; ++i) {
    frames.world.instances[1].to_world = glm::translate(glm::mat4(1.0f), {0.02f * static_cast<float>(i), 0, 0});
    irradiance = frames.next();
  }
  EXPECT_FALSE(frames.steady);
  const double lag = relative_error(irradiance, truth_at(0.5));
  RecordProperty("lag_error", std::to_string(lag));
  EXPECT_LT(lag, 0.25);
  EXPECT_LT(relative_error(irradiance, truth_at(0.5 - 8 * 0.02)), 0.05);
  for (int i = 0; i < 64; ++i) irradiance = frames.next();
  EXPECT_TRUE(frames.steady);
  EXPECT_LT(relative_error(irradiance, truth_at(0.5)), 0.02);
}

// The camera glides by a sixth of a pixel a frame: the history goes along, neither lost nor smeared.
TEST_F(SampledLightTest, TheHistoryFollowsTheCamera) {
  LightFrames frames = frames_of_wall(wall_under_light({1, 1, 1}), {.filter = false});
  const double first = relative_error(frames.next(), light_irradiance);
  Image irradiance;
  for (int i = 1; i <= 32; ++i) {
    frames.camera.position.x = 0.01f * static_cast<float>(i);
    irradiance = frames.next();
  }
  EXPECT_FALSE(frames.steady);
  double sum = 0.0;
  int seen = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide - 6; ++x) {  // farther right the wall ends, or came into view only now
      const double error =
          luminance_of(irradiance.at(x, y)) / light_irradiance(point_on_wall(x, y) + glm::dvec3(0.32, 0, 0)) - 1.0;
      sum += error * error;
      ++seen;
    }
  }
  RecordProperty("error_1", std::to_string(first));
  RecordProperty("error_33", std::to_string(std::sqrt(sum / seen)));
  EXPECT_LT(std::sqrt(sum / seen), first / 10.0);
}

TEST_F(SampledLightTest, TheSameFramesAreTheSameBytes) {
  const Scene scene = load_scene(resolve_scene("cornell-box"));
  LightFrames first = frames_of(scene);
  LightFrames second = frames_of(scene);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(first.next().pixels, second.next().pixels);
}

TEST_F(SampledLightTest, WithoutEmittersAndSkyThereIsNothingToDo) {
  LightFrames frames = frames_of(load_scene(resolve_scene("cornell-spot")));
  const Image irradiance = frames.next();
  EXPECT_TRUE(frames.steady);
  EXPECT_EQ(*std::max_element(irradiance.pixels.begin(), irradiance.pixels.end()), 0.0f);
  EXPECT_EQ(frames.times_ms.count("sample lights"), 0u);
}

}  // namespace
}  // namespace lightwell
