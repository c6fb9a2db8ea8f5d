// Preset `best` as a whole: closed forms, energy, leaks, what moves, and that the same frame is the same bytes.
#include "techniques/light_volume/best.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/log.h"
#include "techniques/light_volume/best_test_frames.h"

namespace lightwell {
namespace {

Scene built_in(const std::string& name) {
  return load_scene(LIGHTWELL_SOURCE_DIR "/scenes/" + name + ".gltf");
}

bool same_bytes(const TechniquePicture& a, const TechniquePicture& b) {
  return std::memcmp(a.irradiance.data(), b.irradiance.data(), a.irradiance.size() * sizeof(glm::vec4)) == 0;
}

class LightVolumeBestTest : public DeviceTest {
 protected:
  // Least and largest irradiance (red) over all pixels.
  static std::pair<float, float> extremes(const TechniquePicture& picture) {
    const auto by_red = [](const glm::vec4& a, const glm::vec4& b) { return a.x < b.x; };
    const auto [least, most] = std::minmax_element(picture.irradiance.begin(), picture.irradiance.end(), by_red);
    return {least->x, most->x};
  }

  static WorldCamera camera_named(const SceneSnapshot& world, const std::string& name) {
    const auto camera = std::find_if(world.cameras.begin(), world.cameras.end(),
                                     [&](const WorldCamera& candidate) { return candidate.name == name; });
    EXPECT_NE(camera, world.cameras.end());
    return *camera;
  }

  const LightCacheOptions quick_ = best_options(16, 32, 8);
};

// In a closed box of albedo a whose walls emit L, radiance is L / (1 - a) everywhere, of which L comes straight from
// the walls: E = pi (2 - 1) for a = 0.5, L = 1.
TEST_F(LightVolumeBestTest, FurnaceReachesTheClosedForm) {
  for (const int resolution : {16, 31}) {
    BestFrames frames(device(), built_in("furnace"), best_options(resolution, 32, 8));
    const auto [least, most] = extremes(frames.run_until_steady());
    EXPECT_NEAR(least, std::numbers::pi, 0.02) << resolution;
    EXPECT_NEAR(most, std::numbers::pi, 0.02) << resolution;
  }
}

// A sphere of albedo 0.5 and radius 1 with a light of pi W/sr at its centre: direct E = pi, and the bounces
// add 1/2 + 1/4 + ... = 1 times that.
TEST_F(LightVolumeBestTest, SphereReachesTheClosedForm) {
  Scene scene = load_scene(LIGHTWELL_SOURCE_DIR "/scenes/sphere.glb");
  BestFrames frames(device(), std::move(scene), best_options(32, 64, 8), 48);
  TechniquePicture picture;
  for (int frame = 0; frame < 16; ++frame) picture = frames.next();
  EXPECT_NEAR(mean_irradiance(picture), std::numbers::pi, 0.05 * std::numbers::pi);
  const auto [least, most] = extremes(picture);
  EXPECT_NEAR(least, std::numbers::pi, 0.12 * std::numbers::pi);
  EXPECT_NEAR(most, std::numbers::pi, 0.12 * std::numbers::pi);
}

// Two squares under an environment of radiance (1, 2, 4): a floor, y 0 and 2 m wide, and a wall on its edge at x -1,
// `height` m; and the camera that looks down on the floor.
Scene open_corner(float height) {
  Scene scene;
  const auto add = [&](const char* name, std::vector<glm::vec3> positions, glm::vec3 normal) {
    Primitive square;
    square.positions = std::move(positions);
    square.normals.assign(4, normal);
    square.indices = {0, 1, 2, 0, 2, 3};
    scene.nodes.push_back({.name = name, .mesh = static_cast<int>(scene.meshes.size())});
    scene.meshes.push_back({.name = name, .primitives = {square}, .morph_weights = {}});
  };
  add("floor", {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}}, {0, 1, 0});
  if (height > 0.0f) add("wall", {{-1, 0, 1}, {-1, 0, -1}, {-1, height, -1}, {-1, height, 1}}, {1, 0, 0});
  scene.environment.radiance = {1.0f, 2.0f, 4.0f};
  return scene;
}

void look_down(TechniqueFrames& frames) {
  frames.camera.position = {0.0f, 1.0f, 0.0f};
  frames.camera.forward = {0.0f, -1.0f, 0.0f};
  frames.camera.up = {0.0f, 0.0f, -1.0f};
}

// The part of a floor's hemisphere, by cosines, that a wall of height h fills which stands c away and reaches from the
// point sideways to b.
double wall_factor(double c, double h, double b) {
  const double r = std::hypot(c, h);
  return (std::atan2(b, c) - c / r * std::atan2(b, r)) / (2.0 * std::numbers::pi);
}

// All is white (the default material): radiance is the environment's everywhere, and what a point of the floor sees of
// the wall has bounced. Without a wall nothing has.
TEST_F(LightVolumeBestTest, AnOpenCornerUnderAnEnvironmentReachesTheClosedForm) {
  BestFrames open(device(), open_corner(0.0f), quick_);
  look_down(open);
  EXPECT_EQ(extremes(open.run_until_steady()), std::pair(0.0f, 0.0f));

  constexpr float kHeight = 1.5f;
  BestFrames frames(device(), open_corner(kHeight), best_options(32, 128, 8));
  look_down(frames);
  const TechniquePicture picture = frames.run_until_steady();
  double truth = 0.0, blue = 0.0;
  for (std::size_t i = 0; i < picture.irradiance.size(); ++i) {
    const glm::vec4& p = picture.position[i];
    const double c = p.x + 1.0;
    const double expected =
        std::numbers::pi * (wall_factor(c, kHeight, 1.0 - p.z) + wall_factor(c, kHeight, 1.0 + p.z));
    truth += expected;
    blue += picture.irradiance[i].z;
    EXPECT_NEAR(picture.irradiance[i].x, expected, 0.3 * expected + 0.02) << p.x << ' ' << p.z;
  }
  std::printf("corner: %.4f of the closed form\n", blue / (4.0 * truth));
  EXPECT_NEAR(blue, 4.0 * truth, 0.03 * 4.0 * truth);
}

// Light straight from sources is not in it: with black walls there is nothing.
TEST_F(LightVolumeBestTest, BlackWallsSendNothingOn) {
  Scene scene = built_in("cornell-box");
  scene.environment.radiance = glm::vec3(0.1f);
  for (Material& material : scene.materials) material.base_color = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
  BestFrames frames(device(), scene, quick_);
  EXPECT_EQ(extremes(frames.run_until_steady()), std::pair(0.0f, 0.0f));
}

// Asked at the places that the pixels show, the points' answers are the pixels'.
TEST_F(LightVolumeBestTest, PointsGetWhatPixelsThereGet) {
  BestFrames frames(device(), built_in("cornell-spot"), quick_);
  const TechniquePicture picture = frames.run_until_steady();
  const std::vector<glm::vec4> at_points = frames.irradiance_at(picture);
  ASSERT_EQ(at_points.size(), picture.irradiance.size());
  double mean = 0.0;
  for (std::size_t i = 0; i < at_points.size(); ++i) {
    mean += at_points[i].x;
    if (picture.position[i].w == 0.0f) {
      EXPECT_EQ(at_points[i].x, 0.0f);
    } else {
      ASSERT_NEAR(at_points[i].x, picture.irradiance[i].x, 1e-5f + 1e-4f * picture.irradiance[i].x) << i;
    }
  }
  EXPECT_GT(mean, 0.0);
}

// All of it is linear, but for the rounding of a face's sums: to units of 2^-20 W/m^2.
TEST_F(LightVolumeBestTest, TwiceTheLightIsTwiceTheAnswer) {
  BestFrames once(device(), built_in("cornell-spot"), quick_);
  BestFrames twice(device(), built_in("cornell-spot"), quick_);
  for (WorldLight& light : twice.world.lights) light.intensity *= 2.0f;
  for (int frame = 0; frame < 3; ++frame) {
    const TechniquePicture a = once.next();
    const TechniquePicture b = twice.next();
    EXPECT_GT(mean_irradiance(a), 0.0);
    for (std::size_t i = 0; i < a.irradiance.size(); ++i)
      for (const int channel : {0, 2}) ASSERT_NEAR(2.0f * a.irradiance[i][channel], b.irradiance[i][channel], 0x1p-18f);
  }
}

TEST_F(LightVolumeBestTest, TheSameFramesAreTheSameBytes) {
  BestFrames first(device(), built_in("boxes"), quick_);
  BestFrames second(device(), built_in("boxes"), quick_);
  for (int frame = 0; frame < 6; ++frame) {
    if (frame == 2) first.world.lights[0].position.x = second.world.lights[0].position.x += 0.1f;
    if (frame == 4) first.world.instances.back().to_world = second.world.instances.back().to_world *= 1.01f;
    ASSERT_TRUE(same_bytes(first.next(), second.next())) << frame;
  }
}

TEST_F(LightVolumeBestTest, SteadyMeansThatNothingChangesAnyMore) {
  BestFrames frames(device(), built_in("cornell-spot"), quick_);
  const TechniquePicture steady = frames.run_until_steady();
  const TechniquePicture later = frames.next();
  EXPECT_TRUE(later.steady);
  EXPECT_TRUE(same_bytes(steady, later));
  frames.world.lights[0].position.x += 0.05f;
  EXPECT_FALSE(frames.next().steady);  // faces look for direct light; it bounces in the next frame
  const TechniquePicture moved = frames.next();
  EXPECT_FALSE(moved.steady);
  EXPECT_FALSE(same_bytes(moved, later));
}

// Once all links have been traced again, a scene in which something moved looks as if it had always been so.
TEST_F(LightVolumeBestTest, WhatMovedEndsWhereItWouldHaveStarted) {
  BestFrames moved(device(), built_in("boxes"), best_options(16, 64, 8));
  BestFrames placed(device(), built_in("boxes"), best_options(16, 64, 8));
  for (int frame = 0; frame < 10; ++frame) {
    moved.world.instances.back().to_world[3].y += 0.02f;
    moved.next();
  }
  placed.world.instances.back().to_world = moved.world.instances.back().to_world;
  const TechniquePicture a = moved.run_until_steady();
  const TechniquePicture b = placed.run_until_steady();
  double squares = 0.0, reference = 0.0;
  for (std::size_t i = 0; i < a.irradiance.size(); ++i) {
    squares += std::pow(a.irradiance[i].x - b.irradiance[i].x, 2.0);
    reference += std::pow(b.irradiance[i].x, 2.0);
  }
  std::printf("moved: mean %.5f of the other, RMS difference %.5f\n", mean_irradiance(a) / mean_irradiance(b),
              std::sqrt(squares / reference));
  EXPECT_NEAR(mean_irradiance(a), mean_irradiance(b), 0.01 * mean_irradiance(b));
  EXPECT_LE(std::sqrt(squares / reference), 0.04);
}

// Three small squares in each of 12^3 cells: more faces than there is room for at first. The light of those that had
// room stays when there is room for all.
TEST_F(LightVolumeBestTest, LightStaysWhenRoomGrows) {
  constexpr int kSide = 12;
  Scene scene;
  Primitive squares;
  for (int i = 0; i < 3 * kSide * kSide * kSide; ++i) {
    const int axis = i % 3, cell = i / 3;
    const glm::vec3 middle = glm::vec3(cell % kSide, cell / kSide % kSide, cell / (kSide * kSide)) + 0.5f;
    glm::vec3 u(0.0f), v(0.0f), normal(0.0f);
    u[(axis + 1) % 3] = v[(axis + 2) % 3] = 0.2f;
    normal[axis] = 1.0f;
    const auto first = static_cast<std::uint32_t>(squares.positions.size());
    for (const glm::vec3& corner : {-u - v, u - v, u + v, v - u}) squares.positions.push_back(middle + corner);
    squares.normals.insert(squares.normals.end(), 4, normal);
    for (const std::uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) squares.indices.push_back(first + index);
  }
  scene.nodes.push_back({.name = "squares", .mesh = 0});
  scene.meshes.push_back({.name = "squares", .primitives = {std::move(squares)}, .morph_weights = {}});
  scene.environment.radiance = glm::vec3(1.0f);
  BestFrames frames(device(), std::move(scene), best_options(kSide, 32, 8));
  int grown = 0;
  double last = 0.0;
  for (int frame = 0; frame < 12; ++frame) {
    const TechniquePicture picture = frames.next();
    const double mean = mean_irradiance(picture);
    EXPECT_EQ(picture.times_ms.count("light cache: clear"), frame == 0 ? 1u : 0u) << frame;
    if (picture.times_ms.count("light cache: carry") > 0) {
      ++grown;
      EXPECT_NEAR(mean, last, 0.1 * last) << frame;
    }
    last = mean;
  }
  EXPECT_EQ(grown, 1);
}

// Room for the links of 1,536 faces, and some hundred more are asked for: one warning, the same bytes whoever comes
// first, and light from the coarser level where there are no links in the finer one.
TEST_F(LightVolumeBestTest, WhereLinksHaveNoRoomTheCoarserLevelAnswers) {
  LightCacheOptions options = best_options(16, 512, 8);
  options.memory = 18;
  options.finest_cell = 0.02f;
  const WarningCapture log;
  BestFrames first(device(), built_in("cornell-spot"), options);
  BestFrames second(device(), built_in("cornell-spot"), options);
  TechniquePicture picture;
  for (int frame = 0; frame < 40; ++frame) {
    picture = first.next();
    if (frame < 8) {
      ASSERT_TRUE(same_bytes(picture, second.next())) << frame;
    }
  }
  options.memory = 1024;
  BestFrames all(device(), built_in("cornell-spot"), options);
  TechniquePicture truth;
  for (int frame = 0; frame < 40; ++frame) truth = all.next();
  std::printf("few links: %.4f of the light\n", mean_irradiance(picture) / mean_irradiance(truth));
  EXPECT_EQ(log.warnings().size(), 1u);
  EXPECT_NEAR(mean_irradiance(picture), mean_irradiance(truth), 0.2 * mean_irradiance(truth));
}

// Where a light moves in a scene that stands, faces keep what their rays met and look for direct light alone.
TEST_F(LightVolumeBestTest, AMovingLightIsFollowedAlongOldLinks) {
  const LightCacheOptions options = best_options(16, 128, 8);
  BestFrames moved(device(), built_in("cornell-spot"), options);
  BestFrames placed(device(), built_in("cornell-spot"), options);
  const double all_rays = moved.next().times_ms["light cache: gather"];
  moved.run_until_steady();
  double shadow_rays = 0.0;
  TechniquePicture lit;
  for (int frame = 0; frame < 24; ++frame) {
    moved.world.lights[0].position.x += 0.01f;
    lit = moved.next();
    shadow_rays = lit.times_ms["light cache: gather"];
  }
  placed.world.lights[0].position = moved.world.lights[0].position;
  const TechniquePicture rested = moved.run_until_steady();
  const double truth = mean_irradiance(placed.run_until_steady());
  std::printf("light: %.4f of the truth in motion, %.4f at rest; gather %.1f ms, from nothing %.1f ms\n",
              mean_irradiance(lit) / truth, mean_irradiance(rested) / truth, shadow_rays, all_rays);
  EXPECT_NEAR(mean_irradiance(lit), truth, 0.06 * truth);
  // Direct light of a face is of one point a frame, of 48 in all.
  EXPECT_NEAR(mean_irradiance(rested), truth, 0.04 * truth);
}

// Where a post stands on part of a cell, part of its floor is inside the post and dark: pixels round the post must not
// be. (Gaps of a centimetre between stairs and wall really are.)
TEST_F(LightVolumeBestTest, NoDarkSpotsWhereThingsStand) {
  BestFrames frames(device(), built_in("room"), best_options(32, 64, 8), 256);
  frames.camera = camera_named(frames.world, "under-stairs");
  TechniquePicture picture;
  for (int frame = 0; frame < 16; ++frame) picture = frames.next();
  const double mean = mean_irradiance(picture);
  long dark = 0;
  long floor = 0;
  for (std::size_t i = 0; i < picture.irradiance.size(); ++i) {
    if (picture.position[i].w == 0.0f || picture.normal[i].y < 0.9f) continue;
    ++floor;
    dark += picture.irradiance[i].x < 0.05 * mean ? 1 : 0;
  }
  EXPECT_GT(floor, 1000);
  EXPECT_EQ(dark, 0);
}

// The room behind a wall of one cell, at eight alignments of wall and grid, against the lit room.
TEST_F(LightVolumeBestTest, AWallOfOneCellKeepsTheLightOut) {
  double leak = 0.0;
  for (int offset = 0; offset < 8; ++offset) {
    BestFrames frames(device(), built_in("two-rooms"), best_options(32, 64, 4), 24);
    const glm::vec3 shift(0.25f * static_cast<float>(offset) / 8.0f);
    frames.grid_bounds = {frames.world.bounds.minimum + shift, frames.world.bounds.maximum + shift};
    const auto look_from = [&](const char* name) {
      frames.camera = camera_named(frames.world, name);
      TechniquePicture picture;
      for (int frame = 0; frame < 12; ++frame) picture = frames.next();
      return mean_irradiance(picture);
    };
    const double lit = look_from("lit");
    EXPECT_GT(lit, 0.0);
    leak += look_from("sealed") / lit / 8.0;
  }
  EXPECT_LE(leak, 0.01);
  RecordProperty("leak", std::to_string(leak));
}

}  // namespace
}  // namespace lightwell
