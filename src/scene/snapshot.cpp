#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lightwell/scene.h"
#include "scene/pose.h"

namespace lightwell {

namespace {

glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& fallback) {
  const float length = glm::length(v);
  return length > 0.0f && std::isfinite(length) ? v / length : fallback;
}

constexpr float kInfinity = std::numeric_limits<float>::infinity();

void grow(Bounds& bounds, const glm::vec3& point) {
  // Comparisons would pass over NaN.
  if (!std::isfinite(point.x + point.y + point.z)) bounds = {glm::vec3(-kInfinity), glm::vec3(kInfinity)};
  bounds.minimum = glm::min(bounds.minimum, point);
  bounds.maximum = glm::max(bounds.maximum, point);
}

void grow_by_instance(Bounds& bounds, const Scene& scene, const MeshInstance& instance) {
  for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
    if (is_skinned(primitive, instance) || !primitive.morph_targets.empty()) {
      for (const glm::vec3& p : pose_positions(primitive, instance)) grow(bounds, p);
    } else {
      for (const glm::vec3& p : primitive.positions) grow(bounds, glm::vec3(instance.to_world * glm::vec4(p, 1.0f)));
    }
  }
}

WorldLight place_light(const Light& light, const glm::mat4& to_world) {
  WorldLight placed;
  placed.type = light.type;
  placed.position = glm::vec3(to_world[3]);
  placed.direction = unit_or(-glm::vec3(to_world[2]), placed.direction);
  placed.intensity = light.intensity;
  placed.cos_inner = std::cos(light.inner_angle);
  placed.cos_outer = std::cos(light.outer_angle);
  placed.range = light.range;
  return placed;
}

WorldCamera place_camera(const Camera& camera, const Node& node, const glm::mat4& to_world) {
  WorldCamera placed;
  placed.name = camera.name.empty() ? node.name : camera.name;
  placed.position = glm::vec3(to_world[3]);
  placed.forward = unit_or(-glm::vec3(to_world[2]), placed.forward);
  const glm::vec3 up(to_world[1]);
  const glm::vec3 any_side = std::abs(placed.forward.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
  const glm::vec3 side = unit_or(glm::cross(placed.forward, up), glm::normalize(glm::cross(placed.forward, any_side)));
  placed.up = glm::cross(side, placed.forward);
  placed.yfov = camera.yfov;
  placed.half_height = camera.half_height;
  placed.znear = camera.znear;
  placed.zfar = camera.zfar;
  return placed;
}

}  // namespace

SceneSnapshot take_snapshot(const Scene& scene) {
  return take_snapshot(scene, scene.nodes);
}

SceneSnapshot take_snapshot(const Scene& scene, const std::vector<Node>& nodes) {
  SceneSnapshot snapshot;
  const std::vector<glm::dmat4> world = world_transforms(nodes, scene.origin);
  Bounds bounds{glm::vec3(kInfinity), glm::vec3(-kInfinity)};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node& node = nodes[i];
    if (node.mesh >= 0) {
      snapshot.instances.push_back(make_instance(scene, nodes, world, static_cast<int>(i)));
      grow_by_instance(bounds, scene, snapshot.instances.back());
    }
    if (node.light >= 0)
      snapshot.lights.push_back(place_light(scene.lights[static_cast<std::size_t>(node.light)], glm::mat4(world[i])));
    if (node.camera >= 0)
      snapshot.cameras.push_back(
          place_camera(scene.cameras[static_cast<std::size_t>(node.camera)], node, glm::mat4(world[i])));
  }
  if (bounds.minimum.x <= bounds.maximum.x) snapshot.bounds = bounds;
  return snapshot;
}

glm::dvec3 choose_origin(const Bounds& bounds) {
  constexpr double kFar = 16.0;     // times the half diagonal
  constexpr double kLeast = 512.0;  // m: nearer by, coordinates in single precision are exact to 0.03 mm
  const glm::dvec3 minimum(bounds.minimum), maximum(bounds.maximum);
  const glm::dvec3 center = 0.5 * (minimum + maximum);
  const double distance = glm::length(center);
  if (!std::isfinite(distance) || distance <= kLeast || distance <= kFar * 0.5 * glm::length(maximum - minimum))
    return glm::dvec3(0.0);
  return glm::round(center);
}

WorldCamera default_camera(const Bounds& bounds) {
  constexpr float kElevation = 0.2f;  // radians
  constexpr float kMargin = 1.05f;
  const glm::vec3 center = 0.5f * (bounds.minimum + bounds.maximum);
  const glm::vec3 half = 0.5f * (bounds.maximum - bounds.minimum);
  // A single point is shown from 1 m away.
  const float extent = glm::length(half);
  const float radius = extent > 1e-9f ? extent : 1.0f;

  WorldCamera camera;
  camera.forward = {0.0f, -std::sin(kElevation), -std::cos(kElevation)};
  camera.up = {0.0f, std::cos(kElevation), -std::sin(kElevation)};
  const float tan_half = std::tan(0.5f * camera.yfov);
  // The nearest distance from which every corner of the box is inside a square picture.
  float distance = 0.0f;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 c = half * glm::vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const float off_axis = std::max(std::abs(c.x), std::abs(glm::dot(c, camera.up)));
    distance = std::max(distance, off_axis / tan_half - glm::dot(c, camera.forward));
  }
  distance = std::max(distance * kMargin, radius);
  camera.position = center - distance * camera.forward;
  camera.znear = 1e-3f * radius;
  camera.zfar = distance + 2.0f * radius;
  return camera;
}

}  // namespace lightwell
