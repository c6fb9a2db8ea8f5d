// Preset `best` as a whole: closed forms, feedback that stays bounded, what moves, and that the same frame is the same
// bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "techniques/ray_traced_voxels/best.h"
#include "techniques/technique_frames.h"

namespace lightwell {
namespace {

using Options = RayTracedVoxelsBestOptions;

Scene built_in(const std::string& name) {
  return load_scene(LIGHTWELL_SOURCE_DIR "/scenes/" + name + ".gltf");
}

Options quick(LightInjection inject = LightInjection::kCamera, int rays = 1) {
  return {.cache = {.resolution = 32, .inject = inject}, .rays = rays};
}

struct CacheFrames : TechniqueFrames {
  CacheFrames(Device& device, Scene scene, const Options& options, std::uint32_t side = 48)
      : TechniqueFrames(device, std::move(scene), std::make_unique<RayTracedVoxelsBest>(options), side) {
    samples_sources = true;
  }
};

class LightCacheTest : public DeviceTest {};

bool same_bytes(const TechniquePicture& a, const TechniquePicture& b) {
  return std::memcmp(a.irradiance.data(), b.irradiance.data(), a.irradiance.size() * sizeof(glm::vec4)) == 0;
}

// A closed box of albedo 0.5 whose walls emit 1: of E = 2 pi, half has bounced.
TEST_F(LightCacheTest, FurnaceReachesTheClosedForm) {
  for (const LightInjection inject : {LightInjection::kCamera, LightInjection::kLight}) {
    for (const int rays : {0, 1}) {
      CacheFrames frames(device(), built_in("furnace"), quick(inject, rays));
      EXPECT_NEAR(mean_irradiance(frames.run_until_steady()), std::numbers::pi, 0.02 * std::numbers::pi)
          << "inject " << static_cast<int>(inject) << ", rays " << rays;
    }
  }
}

// A sphere of albedo 0.5 and radius 1 with a light of pi W/sr at its centre: direct E = pi, and the bounces add 1/2 +
// 1/4 + ... = 1 times that.
TEST_F(LightCacheTest, SphereReachesTheClosedForm) {
  for (const LightInjection inject : {LightInjection::kCamera, LightInjection::kLight}) {
    CacheFrames frames(device(), load_scene(LIGHTWELL_SOURCE_DIR "/scenes/sphere.glb"), quick(inject));
    EXPECT_NEAR(mean_irradiance(frames.run_until_steady()), std::numbers::pi, 0.03 * std::numbers::pi);
  }
}

// Radiance 1 / (1 - 0.95) = 20, of which 19 has bounced. Each frame gathers from the one before: 10,000 of them must
// not grow beyond the closed form. The box fills few voxels, so that all of its faces gather in little time.
TEST_F(LightCacheTest, FeedbackStaysBoundedOverTenThousandFrames) {
  Scene scene = built_in("furnace");
  for (Material& material : scene.materials) material.base_color = {0.95f, 0.95f, 0.95f, 1.0f};
  CacheFrames frames(device(), std::move(scene), quick(), 8);
  const glm::vec3 size = frames.world.bounds.maximum - frames.world.bounds.minimum;
  frames.grid_bounds = {frames.world.bounds.minimum - 3.1f * size, frames.world.bounds.maximum + 3.3f * size};
  double largest = 0.0;
  double last = 0.0;
  for (int frame = 1; frame <= 10000; ++frame) {
    last = mean_irradiance(frames.next());
    largest = std::max(largest, last);
  }
  const double truth = 19.0 * std::numbers::pi;
  EXPECT_NEAR(last, truth, 0.01 * truth);
  EXPECT_LE(largest, 1.02 * truth);
}

// Asked at the places that the pixels show, the cache gives what pixels that send no rays get.
TEST_F(LightCacheTest, PointsGetWhatPixelsThereGet) {
  CacheFrames frames(device(), built_in("cornell-spot"), quick(LightInjection::kCamera, 0));
  const TechniquePicture picture = frames.run_until_steady();
  const std::vector<glm::vec4> at_points = frames.irradiance_at(picture);
  ASSERT_EQ(at_points.size(), picture.irradiance.size());
  double points = 0.0;
  double pixels = 0.0;
  for (std::size_t i = 0; i < at_points.size(); ++i) {
    if (picture.position[i].w == 0.0f) {
      EXPECT_EQ(at_points[i].x, 0.0f);
    }
    points += at_points[i].x;
    pixels += picture.irradiance[i].x;
  }
  EXPECT_GT(pixels, 0.0);
  EXPECT_NEAR(points, pixels, 0.02 * pixels);
}

TEST_F(LightCacheTest, TheSameFramesAreTheSameBytes) {
  for (const LightInjection inject : {LightInjection::kCamera, LightInjection::kLight}) {
    CacheFrames first(device(), built_in("boxes"), quick(inject));
    CacheFrames second(device(), built_in("boxes"), quick(inject));
    for (int frame = 0; frame < 6; ++frame) {
      if (frame == 2) first.world.lights[0].position.x = second.world.lights[0].position.x += 0.1f;
      if (frame == 4) first.world.instances.back().to_world = second.world.instances.back().to_world *= 1.01f;
      ASSERT_TRUE(same_bytes(first.next(), second.next())) << frame;
    }
  }
}

// Faces keep their light while slots change under them: when something has moved and rests, the picture is that of a
// scene in which it had always been there.
TEST_F(LightCacheTest, WhatMovedEndsWhereItWouldHaveStarted) {
  CacheFrames moved(device(), built_in("boxes"), quick());
  CacheFrames placed(device(), built_in("boxes"), quick());
  for (int frame = 0; frame < 10; ++frame) {
    moved.world.instances.back().to_world[3].y += 0.02f;
    moved.next();
  }
  placed.world.instances.back().to_world = moved.world.instances.back().to_world;
  const double a = mean_irradiance(moved.run_until_steady());
  const double b = mean_irradiance(placed.run_until_steady());
  EXPECT_GT(b, 0.0);
  EXPECT_NEAR(a, b, 0.02 * b);
}

// What a light has brought fades with the bounces that carry it on: 1 % is left after 32 frames.
TEST_F(LightCacheTest, ALightThatGoesOutFades) {
  CacheFrames frames(device(), built_in("cornell-spot"), quick());
  const double lit = mean_irradiance(frames.run_until_steady());
  for (WorldLight& light : frames.world.lights) light.intensity = glm::vec3(0.0f);
  double left = lit;
  for (int frame = 0; frame < 32; ++frame) left = mean_irradiance(frames.next());
  EXPECT_GT(lit, 0.0);
  EXPECT_LE(left, 0.01 * lit);
  RecordProperty("left", std::to_string(left / lit));
}

// The room behind a wall of one cell, at eight alignments of wall and grid, against the lit room.
TEST_F(LightCacheTest, AWallOfOneCellKeepsTheLightOut) {
  for (const int rays : {0, 1}) {
    double leak = 0.0;
    for (int offset = 0; offset < 8; ++offset) {
      CacheFrames frames(device(), built_in("two-rooms"), quick(LightInjection::kCamera, rays), 24);
      const glm::vec3 shift(0.25f * static_cast<float>(offset) / 8.0f);
      frames.grid_bounds = {frames.world.bounds.minimum + shift, frames.world.bounds.maximum + shift};
      const auto look_from = [&](const char* name) {
        for (const WorldCamera& camera : frames.world.cameras)
          if (camera.name == name) frames.camera = camera;
        frames.restart = true;
        TechniquePicture picture;
        for (int frame = 0; frame < 24; ++frame) picture = frames.next();
        return mean_irradiance(picture);
      };
      const double lit = look_from("lit");
      EXPECT_GT(lit, 0.0);
      leak += look_from("sealed") / lit / 8.0;
    }
    EXPECT_LE(leak, 0.01) << "rays " << rays;
  }
}

// Nothing to gather from, nothing to gather with: dark or empty scenes are black.
TEST_F(LightCacheTest, NoLightIsBlack) {
  Scene scene = built_in("cornell-spot");
  scene.lights.clear();
  for (Node& node : scene.nodes) node.light = -1;
  CacheFrames frames(device(), std::move(scene), quick());
  for (int frame = 0; frame < 3; ++frame) EXPECT_EQ(mean_irradiance(frames.next()), 0.0);
}

}  // namespace
}  // namespace lightwell
