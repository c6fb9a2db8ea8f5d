#include "passes/camera/camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightwell {
namespace {

// Where a world position falls in the image, in pixels; z: depth.
glm::vec3 project(const glm::mat4& matrix, const glm::vec3& position, glm::uvec2 size) {
  const glm::vec4 clip = matrix * glm::vec4(position, 1.0f);
  const glm::vec3 ndc = glm::vec3(clip) / clip.w;
  return {(ndc.x * 0.5f + 0.5f) * static_cast<float>(size.x), (ndc.y * 0.5f + 0.5f) * static_cast<float>(size.y),
          ndc.z};
}

WorldCamera camera_at_origin() {
  WorldCamera camera;
  camera.yfov = 2.0f * std::atan(0.5f);  // the image is as high as it is far away
  camera.znear = 0.1f;
  return camera;
}

TEST(Camera, ProjectsLikeAPinhole) {
  const glm::uvec2 size(200, 100);
  const glsl::GpuCamera camera = make_gpu_camera(camera_at_origin(), size, {}, nullptr);
  const glm::vec3 center = project(camera.view_projection, {0, 0, -2}, size);
  EXPECT_NEAR(center.x, 100.0f, 1e-4f);
  EXPECT_NEAR(center.y, 50.0f, 1e-4f);
  EXPECT_NEAR(center.z, 0.05f, 1e-6f);  // near / distance
  // At 2 m one metre is 50 pixels; y points down in images.
  const glm::vec3 corner = project(camera.view_projection, {1, 0.5f, -2}, size);
  EXPECT_NEAR(corner.x, 150.0f, 1e-4f);
  EXPECT_NEAR(corner.y, 25.0f, 1e-4f);
}

// Seen from afar everything is where parallel rays put it, to half a thousandth of the picture's height.
TEST(Camera, OrthographicOnesAreFarAway) {
  const glm::uvec2 size(200, 100);
  for (const float scale : {1e-3f, 1.0f, 1e4f})
    for (const glm::vec3 position : {glm::vec3(0.0f), glm::vec3(1, 2, 30), glm::vec3(0, 0, -3)}) {
      WorldCamera camera;
      camera.position = scale * position;
      camera.half_height = 2.0f * scale;
      camera.znear = 0.5f * scale;
      const Bounds bounds{glm::vec3(-3 * scale), glm::vec3(3 * scale)};
      const EyeCamera eye = make_perspective(camera, bounds);
      const glsl::GpuCamera seen = make_gpu_camera(eye.camera, size, {}, nullptr);
      for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p = 3 * scale * glm::vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const glm::vec3 across = (p - camera.position) / camera.half_height;
        const glm::vec3 pixel = project(seen.view_projection, p, size);
        EXPECT_NEAR(pixel.x, 100.0f + 50.0f * across.x, 0.0011f * 50.0f * glm::length(across)) << scale;
        EXPECT_NEAR(pixel.y, 50.0f - 50.0f * across.y, 0.0011f * 50.0f * glm::length(across)) << scale;
        // Depth 1 is the camera's own near plane.
        const float depth = glm::dot(p - camera.position, camera.forward);
        EXPECT_TRUE(std::abs(depth - camera.znear) < 0.1f * scale || (pixel.z < 1.0f) == (depth > camera.znear));
      }
    }
}

TEST(Camera, SeesScenesOfMicrometres) {
  WorldCamera near_camera = camera_at_origin();
  near_camera.znear = 1e-7f;
  const glm::uvec2 size(200, 100);
  const glsl::GpuCamera camera = make_gpu_camera(near_camera, size, {}, nullptr);
  EXPECT_NEAR(project(camera.view_projection, {0, 0, -1e-6f}, size).z, 0.1f, 1e-6f);
}

TEST(Camera, JitterMovesTheImageAgainstTheSample) {
  const glm::uvec2 size(200, 100);
  const PixelSample sample{{0.25f, -0.5f}, 1.0f};
  const glsl::GpuCamera camera = make_gpu_camera(camera_at_origin(), size, sample, nullptr);
  const glm::vec3 steady = project(camera.steady_view_projection, {0.3f, 0.2f, -3}, size);
  const glm::vec3 moved = project(camera.view_projection, {0.3f, 0.2f, -3}, size);
  EXPECT_NEAR(moved.x - steady.x, -0.25f, 1e-4f);
  EXPECT_NEAR(moved.y - steady.y, 0.5f, 1e-4f);
}

TEST(Camera, RemembersTheLastOneWithoutItsJitter) {
  WorldCamera camera = camera_at_origin();
  const glsl::GpuCamera first = make_gpu_camera(camera, {64, 64}, {{0.5f, 0.5f}, 1.0f}, nullptr);
  camera.position.x = 1.0f;
  const glsl::GpuCamera second = make_gpu_camera(camera, {64, 64}, {}, &first);
  EXPECT_EQ(first.previous_view_projection, first.steady_view_projection);
  EXPECT_EQ(second.previous_view_projection, first.steady_view_projection);
}

}  // namespace
}  // namespace lightwell
