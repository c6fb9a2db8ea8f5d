#include "scene/look_at.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace lightwell {

namespace {

constexpr float kFieldOfView = 45.0f;  // degrees
constexpr float kVertical = 0.9999f;   // of the height of a unit vector

}  // namespace

WorldCamera look_at(const glm::vec3& eye, const glm::vec3& target, const Bounds& bounds) {
  WorldCamera camera;
  camera.position = eye;
  const glm::vec3 direction = target - eye;
  const float distance = glm::length(direction);
  camera.forward = direction / distance;
  const bool vertical = std::abs(camera.forward.y) > kVertical;
  const glm::vec3 up = vertical ? glm::vec3(0.0f, 0.0f, -1.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
  camera.up = glm::normalize(up - glm::dot(up, camera.forward) * camera.forward);
  camera.yfov = glm::radians(kFieldOfView);
  camera.zfar = std::max(camera.zfar, 4.0f * glm::length(bounds.maximum - bounds.minimum) + distance);
  return camera;
}

}  // namespace lightwell
