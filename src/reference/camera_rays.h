// Rays of a camera with square pixels.
#pragma once

#include <cmath>

#include <glm/ext/vector_float2.hpp>
#include <glm/geometric.hpp>

#include "lightwell/scene.h"
#include "reference/ray_tracer.h"

namespace lightwell {

class RayGenerator {
 public:
  // `camera` must outlive this.
  RayGenerator(const WorldCamera& camera, int width, int height) : camera_(camera) {
    const float half_height = orthographic() ? camera.half_height : std::tan(0.5f * camera.yfov);
    pixel_side_ = 2.0f * half_height / static_cast<float>(height);
    top_left_ = {-0.5f * pixel_side_ * static_cast<float>(width), half_height};
    right_ = glm::cross(camera.forward, camera.up);
  }

  // `position` is in pixels from the picture's top left corner. One unit of t is one metre along `forward`.
  Ray ray(glm::vec2 position) const {
    const float x = top_left_.x + pixel_side_ * position.x;
    const float y = top_left_.y - pixel_side_ * position.y;
    const glm::vec3 across = x * right_ + y * camera_.up;
    if (orthographic()) return {camera_.position + across, camera_.forward, camera_.znear};
    return {camera_.position, camera_.forward + across, camera_.znear};
  }

 private:
  bool orthographic() const { return camera_.half_height > 0.0f; }

  const WorldCamera& camera_;
  float pixel_side_;
  glm::vec2 top_left_;
  glm::vec3 right_;
};

}  // namespace lightwell
