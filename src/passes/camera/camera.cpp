#include "passes/camera/camera.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lightwell {
namespace {

constexpr float kNearestPlane = 1e-12f;  // m; a plane at 0 would leave no depth

// Row `row` of a matrix from a world position p to dot(axis, p - origin) / scale.
void set_row(glm::mat4& matrix, int row, const glm::vec3& axis, const glm::vec3& origin, float scale) {
  for (int column = 0; column < 3; ++column) matrix[column][row] = axis[column] / scale;
  matrix[3][row] = -glm::dot(axis, origin) / scale;
}

}  // namespace

glsl::GpuCamera make_gpu_camera(const WorldCamera& camera, glm::uvec2 size, const PixelSample& sample,
                                const glsl::GpuCamera* previous) {
  glsl::GpuCamera out{};
  out.position = camera.position;
  out.forward = camera.forward;
  out.right = glm::normalize(glm::cross(camera.forward, camera.up));
  out.up = glm::cross(out.right, out.forward);
  out.tan_half_y = std::tan(0.5f * camera.yfov);
  out.tan_half_x = out.tan_half_y * static_cast<float>(size.x) / static_cast<float>(size.y);
  out.znear = std::max(camera.znear, kNearestPlane);
  out.jitter = sample.jitter;
  out.footprint = sample.footprint;
  out.size = size;

  // Depth is znear / distance (reversed, without a far plane); y points down.
  glm::mat4 steady(0.0f);
  set_row(steady, 0, out.right, out.position, out.tan_half_x);
  set_row(steady, 1, -out.up, out.position, out.tan_half_y);
  set_row(steady, 3, out.forward, out.position, 1.0f);
  steady[3][2] = out.znear;
  out.steady_view_projection = steady;

  // Sampling at centre + jitter moves the picture the other way.
  const glm::vec2 shift = -2.0f * sample.jitter / glm::vec2(size);
  out.view_projection = steady;
  for (int column = 0; column < 4; ++column) {
    out.view_projection[column][0] += shift.x * steady[column][3];
    out.view_projection[column][1] += shift.y * steady[column][3];
  }
  out.previous_view_projection = previous != nullptr ? previous->steady_view_projection : steady;
  return out;
}

EyeCamera make_perspective(const WorldCamera& camera, const Bounds& bounds) {
  if (!(camera.half_height > 0.0f)) return {camera, 0.0f};
  // Something at depth z from the middle is shown 1 / (1 + z / distance) times as large as it should be.
  constexpr float kDistances = 1000.0f;
  const glm::vec3 half = 0.5f * (bounds.maximum - bounds.minimum);
  const glm::vec3 center = 0.5f * (bounds.maximum + bounds.minimum);
  const float depth = glm::dot(glm::abs(camera.forward), half);
  const float middle = glm::dot(camera.forward, center - camera.position);
  EyeCamera eye{camera, 0.0f};
  const float distance = kDistances * std::max(depth, camera.half_height);
  eye.behind = std::max(distance - middle, distance);
  eye.camera.position = camera.position - eye.behind * camera.forward;
  eye.camera.yfov = 2.0f * std::atan(camera.half_height / (eye.behind + middle));
  eye.camera.half_height = 0.0f;
  eye.camera.znear = eye.behind + camera.znear;
  return eye;
}

float pixel_clearance(const glsl::GpuCamera& camera) {
  constexpr float kPixels = 0.02f;
  return kPixels * 2.0f * camera.tan_half_y / static_cast<float>(camera.size.y);
}

float pixel_tangent(const glsl::GpuCamera& camera) {
  return 2.0f * camera.tan_half_y / static_cast<float>(camera.size.y);
}

}  // namespace lightwell
