// Preset `best` as a whole: closed forms, energy, leaks, what moves, and that the same frame is the same bytes.
#include "techniques/light_volume/surfel_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "lightwell/image.h"
#include "techniques/light_volume/surfel_test_frame.h"

namespace lightwell {
namespace {

Scene built_in(const std::string& name) {
  return load_scene(LIGHTWELL_SOURCE_DIR "/scenes/" + name + ".gltf");
}

class SurfelSolverTest : public DeviceTest {
 protected:
  static constexpr LightVolumeBestOptions kQuick{.resolution = 16, .links = 32, .links_per_frame = 32};

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
};

// In a closed box of albedo a whose walls emit L, radiance is L / (1 - a) everywhere: E = pi * 2 for a = 0.5, L = 1.
TEST_F(SurfelSolverTest, FurnaceReachesTheClosedForm) {
  for (const int resolution : {16, 31}) {
    SurfelFrames frames(device(), built_in("furnace"), {.resolution = resolution, .links = 32, .links_per_frame = 32});
    const TechniquePicture picture = frames.run_until_steady();
    const auto [least, most] = extremes(picture);
    EXPECT_NEAR(least, 2.0 * std::numbers::pi, 0.02);
    EXPECT_NEAR(most, 2.0 * std::numbers::pi, 0.02);
  }
}

// Without the light straight from the walls, E = pi L, what has bounced is left: E = pi (2 - 1) L.
TEST_F(SurfelSolverTest, FurnaceWithoutTheLightOfItsEmitters) {
  SurfelFrames frames(device(), built_in("furnace"), kQuick);
  frames.samples_sources = true;
  const auto [least, most] = extremes(frames.run_until_steady());
  EXPECT_NEAR(least, std::numbers::pi, 0.02);
  EXPECT_NEAR(most, std::numbers::pi, 0.02);
}

// Emitters that shadow rays are sent to and the environment: with and without them differ by their direct light, which
// is brightest where nothing has bounced yet.
TEST_F(SurfelSolverTest, SourcesAreTakenOutAndNothingElse) {
  Scene scene = built_in("cornell-box");
  scene.environment.radiance = glm::vec3(0.1f);
  for (Material& material : scene.materials) material.base_color = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
  SurfelFrames frames(device(), scene, kQuick);
  frames.samples_sources = true;
  EXPECT_EQ(extremes(frames.run_until_steady()), std::pair(0.0f, 0.0f));  // black walls: nothing bounces
  SurfelFrames all(device(), scene, kQuick);
  EXPECT_GT(mean_irradiance(all.run_until_steady()), 0.1);
}

// A sphere of albedo 0.5 and radius 1 with a light of pi W/sr at its centre: direct E = pi, and the bounces
// add 1/2 + 1/4 + ... = 1 times that.
TEST_F(SurfelSolverTest, SphereReachesTheClosedForm) {
  Scene scene = load_scene(LIGHTWELL_SOURCE_DIR "/scenes/sphere.glb");
  SurfelFrames frames(device(), std::move(scene), {.resolution = 32, .links = 64, .links_per_frame = 64});
  const TechniquePicture picture = frames.run_until_steady();
  EXPECT_NEAR(mean_irradiance(picture), std::numbers::pi, 0.05 * std::numbers::pi);
  const auto [least, most] = extremes(picture);
  EXPECT_NEAR(least, std::numbers::pi, 0.12 * std::numbers::pi);
  EXPECT_NEAR(most, std::numbers::pi, 0.12 * std::numbers::pi);
}

// An open plane under an environment of constant radiance L receives E = pi L.
TEST_F(SurfelSolverTest, AnOpenFloorReceivesTheEnvironment) {
  Scene scene;
  Primitive floor;
  floor.positions = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
  floor.normals.assign(4, {0, 1, 0});
  floor.indices = {0, 1, 2, 0, 2, 3};
  scene.meshes.push_back({.name = "floor", .primitives = {floor}, .morph_weights = {}});
  scene.nodes.push_back({.name = "floor", .mesh = 0});
  scene.environment.radiance = {1.0f, 2.0f, 4.0f};
  SurfelFrames frames(device(), std::move(scene), kQuick);
  frames.camera.position = {0.0f, 1.0f, 0.0f};
  frames.camera.forward = {0.0f, -1.0f, 0.0f};
  frames.camera.up = {0.0f, 0.0f, -1.0f};
  const TechniquePicture picture = frames.run_until_steady();
  const auto [least, most] = extremes(picture);
  EXPECT_NEAR(least, std::numbers::pi, 1e-3);
  EXPECT_NEAR(most, std::numbers::pi, 1e-3);
  EXPECT_NEAR(picture.irradiance[0].z, 4.0 * std::numbers::pi, 4e-3);
}

// Asked at the places that the pixels show, the points' answers are the pixels'.
TEST_F(SurfelSolverTest, PointsGetWhatPixelsThereGet) {
  SurfelFrames frames(device(), built_in("cornell-spot"), kQuick);
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

// Twice the light is twice the answer, to the last bit: all of it is linear, and 2 is a power of 2.
TEST_F(SurfelSolverTest, TwiceTheLightIsTwiceTheAnswer) {
  SurfelFrames once(device(), built_in("cornell-spot"), kQuick);
  SurfelFrames twice(device(), built_in("cornell-spot"), kQuick);
  for (WorldLight& light : twice.world.lights) light.intensity *= 2.0f;
  for (int frame = 0; frame < 3; ++frame) {
    const TechniquePicture a = once.next();
    const TechniquePicture b = twice.next();
    EXPECT_GT(mean_irradiance(a), 0.0);
    for (std::size_t i = 0; i < a.irradiance.size(); ++i) {
      ASSERT_EQ(2.0f * a.irradiance[i].x, b.irradiance[i].x);
      ASSERT_EQ(2.0f * a.irradiance[i].z, b.irradiance[i].z);
    }
  }
}

TEST_F(SurfelSolverTest, TheSameFramesAreTheSameBytes) {
  SurfelFrames first(device(), built_in("boxes"), kQuick);
  SurfelFrames second(device(), built_in("boxes"), kQuick);
  for (int frame = 0; frame < 4; ++frame) {
    if (frame == 2) first.world.lights[0].position.x = second.world.lights[0].position.x += 0.1f;
    const TechniquePicture a = first.next();
    const TechniquePicture b = second.next();
    ASSERT_EQ(std::memcmp(a.irradiance.data(), b.irradiance.data(), a.irradiance.size() * sizeof(glm::vec4)), 0);
  }
}

TEST_F(SurfelSolverTest, SteadyMeansThatNothingChangesAnyMore) {
  SurfelFrames frames(device(), built_in("cornell-spot"), kQuick);
  const TechniquePicture steady = frames.run_until_steady();
  const TechniquePicture later = frames.next();
  EXPECT_TRUE(later.steady);
  EXPECT_EQ(std::memcmp(steady.irradiance.data(), later.irradiance.data(), later.irradiance.size() * sizeof(glm::vec4)),
            0);
  frames.world.lights[0].position.x += 0.05f;
  const TechniquePicture moved = frames.next();
  EXPECT_FALSE(moved.steady);
  EXPECT_NE(std::memcmp(moved.irradiance.data(), later.irradiance.data(), later.irradiance.size() * sizeof(glm::vec4)),
            0);
}

// Once all links have been traced again, a scene in which something moved looks as if it had always been so.
TEST_F(SurfelSolverTest, WhatMovedEndsWhereItWouldHaveStarted) {
  const LightVolumeBestOptions options{.resolution = 16, .links = 32, .links_per_frame = 8};
  SurfelFrames moved(device(), built_in("boxes"), options);
  SurfelFrames placed(device(), built_in("boxes"), options);
  const auto shift_last = [](SceneSnapshot& world, float by) { world.instances.back().to_world[3].y += by; };
  for (int frame = 0; frame < 10; ++frame) {
    shift_last(moved.world, 0.02f);
    moved.next();
  }
  shift_last(placed.world, 10 * 0.02f);
  placed.world.instances.back().to_world = moved.world.instances.back().to_world;
  const TechniquePicture a = moved.run_until_steady();
  const TechniquePicture b = placed.run_until_steady();
  for (std::size_t i = 0; i < a.irradiance.size(); ++i)
    ASSERT_NEAR(a.irradiance[i].x, b.irradiance[i].x, 1e-4f + 1e-3f * b.irradiance[i].x);
}

// Where a post stands on part of a cell, the centre of the floor in it is inside the post and dark: pixels round the
// post must not be. (Gaps of a centimetre between stairs and wall really are.)
TEST_F(SurfelSolverTest, NoDarkSpotsWhereThingsStand) {
  SurfelFrames frames(device(), built_in("room"), {.resolution = 32, .links = 64, .links_per_frame = 64}, 256);
  frames.camera = camera_named(frames.world, "under-stairs");
  const TechniquePicture picture = frames.run_until_steady();
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
TEST_F(SurfelSolverTest, AWallOfOneCellKeepsTheLightOut) {
  double leak = 0.0;
  for (int offset = 0; offset < 8; ++offset) {
    SurfelFrames frames(device(), built_in("two-rooms"), {.resolution = 32, .links = 64, .links_per_frame = 64});
    const glm::vec3 shift(0.25f * static_cast<float>(offset) / 8.0f);
    frames.grid_bounds = {frames.world.bounds.minimum + shift, frames.world.bounds.maximum + shift};
    frames.camera = camera_named(frames.world, "lit");
    const double lit = mean_irradiance(frames.run_until_steady());
    frames.camera = camera_named(frames.world, "sealed");
    const double sealed = mean_irradiance(frames.next());
    EXPECT_GT(lit, 0.0);
    leak += sealed / lit / 8.0;
  }
  EXPECT_LE(leak, 0.01);
  RecordProperty("leak", std::to_string(leak));
}

}  // namespace
}  // namespace lightwell
