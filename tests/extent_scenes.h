// Scenes that grids of voxels find hard, made in code: those of scripts/extent_scenes.py, which says more about them.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>

#include <glm/trigonometric.hpp>

#include "lightwell/scene.h"
#include "renderer/test_scene.h"
#include "scene/light_spec.h"
#include "scene/look_at.h"

namespace lightwell {

struct ExtentScene : TestScene {
  // Two-sided, as in the files: what a closed body sends inward must not add to its light.
  int add_material(const glm::vec3& albedo, const glm::vec3& emission = glm::vec3(0.0f)) {
    const int index = TestScene::add_material(albedo, emission);
    scene.materials[static_cast<std::size_t>(index)].double_sided = true;
    return index;
  }

  // Axis-aligned, faces outward.
  void add_box(const glm::vec3& low, const glm::vec3& high, int material, bool inward = false) {
    const glm::vec3 x(high.x - low.x, 0, 0), y(0, high.y - low.y, 0), z(0, 0, high.z - low.z);
    const auto face = [&](const glm::vec3& corner, const glm::vec3& a, const glm::vec3& b) {
      inward ? add_quad(corner, b, a, material) : add_quad(corner, a, b, material);
    };
    face(low, y, x);
    face(low, z, y);
    face(low, x, z);
    face(low + z, x, y);
    face(low + x, y, z);
    face(low + y, z, x);
  }

  // Looks from `eye` to `target`; `degrees`: field of view.
  WorldCamera camera(const glm::vec3& eye, const glm::vec3& target, float degrees) const {
    WorldCamera camera = look_at(eye, target, take_snapshot(scene).bounds);
    camera.yfov = glm::radians(degrees);
    return camera;
  }
};

// A room of 4 x 2.8 x 4 m on a square of `ground` m; `door`: width of an opening towards +x, 0: sealed. A sun and a
// sky, or, in a sealed room, a lamp and neither of them.
inline ExtentScene room_on_ground(float ground, float door, bool lamp) {
  ExtentScene s;
  const int white = s.add_material(glm::vec3(0.7f));
  s.add_quad({-ground / 2, 0, ground / 2}, {ground, 0, 0}, {0, 0, -ground}, s.add_material(glm::vec3(0.5f)));
  constexpr float kLow = 0.1f, kHigh = 3.1f;  // walls end inside floor and ceiling
  s.add_box({-2.2f, -0.1f, -2.2f}, {2.2f, 0.2f, 2.2f}, white);
  s.add_box({-2.2f, 3.0f, -2.2f}, {2.2f, 3.2f, 2.2f}, white);
  s.add_box({-2.19f, kLow, -2.19f}, {2.19f, kHigh, -2.0f}, white);
  s.add_box({-2.19f, kLow, 2.0f}, {2.19f, kHigh, 2.19f}, white);
  s.add_box({-2.18f, kLow, -2.1f}, {-2.0f, kHigh, 2.1f}, white);
  if (door > 0.0f) {
    s.add_box({2.0f, kLow, -2.1f}, {2.18f, kHigh, -door / 2}, white);
    s.add_box({2.0f, kLow, door / 2}, {2.18f, kHigh, 2.1f}, white);
    s.add_box({2.0f, 2.2f, -door / 2 - 0.1f}, {2.18f, kHigh, door / 2 + 0.1f}, white);
  } else {
    s.add_box({2.0f, kLow, -2.1f}, {2.18f, kHigh, 2.1f}, white);
  }
  if (lamp) {
    add_light(s.scene, "point pos=0,2.7,0 intensity=3");
  } else {
    add_sun(s.scene, "-0.25,-0.9,-0.38 10");
    s.scene.environment.radiance = {0.5f, 0.6f, 0.8f};
  }
  return s;
}

inline WorldCamera inside_room(const ExtentScene& s) {
  return s.camera({-1.7f, 1.6f, 1.7f}, {0.3f, 1.35f, -0.3f}, 70.0f);
}

inline WorldCamera outside_room(const ExtentScene& s) {
  return s.camera({7.0f, 3.0f, 6.0f}, {0.0f, 1.2f, 0.0f}, 50.0f);
}

// A closed room of 4 x 2.6 x 4 m with a black cube of `size` m that sends out 37.7 W; `shaded`: in a lampshade that is
// open above and below.
inline ExtentScene room_with_emitter(float size, bool shaded) {
  ExtentScene s;
  s.add_box({-2, 0, -2}, {2, 2.6f, 2}, s.add_material(glm::vec3(0.7f)), true);
  if (shaded) {
    const int sheet = s.add_material({0.8f, 0.75f, 0.6f});
    constexpr int kSides = 16;
    const auto at = [](int i) {
      const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / kSides;
      return glm::vec3(0.25f * std::cos(angle), 1.2f, 0.25f * std::sin(angle));
    };
    for (int i = 0; i < kSides; ++i) s.add_quad(at(i), {0, 0.4f, 0}, at(i + 1) - at(i), sheet);
  }
  const int lamp = s.add_material(glm::vec3(0.0f), glm::vec3(2.0f / (size * size)));
  const glm::vec3 middle(0, 1.4f, 0), half(size / 2);
  s.add_box(middle - half, middle + half, lamp);
  return s;
}

inline WorldCamera view_of_emitter(const ExtentScene& s) {
  return s.camera({-1.8f, 1.3f, 1.8f}, {0.8f, 1.19f, -1.24f}, 80.0f);
}

// A lit and a dark room with a wall without thickness between them, turned about +Y.
inline ExtentScene rooms_with_thin_wall(float degrees) {
  ExtentScene s;
  const int white = s.add_material(glm::vec3(0.75f));
  constexpr float kX = 4.0f, kY = 3.5f, kZ = 2.25f, kThick = 0.25f;
  s.add_box({-kX, 0, -kZ}, {kX, kThick, kZ}, white);
  s.add_box({-kX, kY - kThick, -kZ}, {kX, kY, kZ}, white);
  for (const float z : {-kZ + 0.01f, kZ - kThick})
    s.add_box({-kX + 0.1f, 0.1f, z}, {kX - 0.1f, kY - 0.1f, z + kThick - 0.01f}, white);
  for (const float x : {-kX + 0.01f, kX - kThick})
    s.add_box({x, 0.1f, -kZ + 0.1f}, {x + kThick - 0.01f, kY - 0.1f, kZ - 0.1f}, white);
  const float angle = glm::radians(degrees);
  const float end = (kZ - kThick / 2) / std::cos(angle);  // in the middle of the walls
  const glm::vec3 along(-std::sin(angle) * end, 0, std::cos(angle) * end);
  s.add_quad(glm::vec3(0.09f, 0.1f, 0) + along, -2.0f * along, {0, kY - 0.2f, 0}, white);
  add_light(s.scene, "point pos=-1.6,2.6,0.4 intensity=6");
  return s;
}

// The rooms' views: of the lit one, or of the sealed one.
inline WorldCamera view_of_rooms(const ExtentScene& s, bool lit) {
  const float side = lit ? -1.0f : 1.0f;
  return s.camera({3.4f * side, 1.9f, -1.3f * side}, {0.4f * side, 1.4f, 0.6f * side}, 65.0f);
}

// So many separate cubes of 0.6 m, a metre apart, all instances of one mesh; a sun.
inline ExtentScene separate_cubes(int count) {
  ExtentScene s;
  s.add_box(glm::vec3(-0.3f), glm::vec3(0.3f), s.add_material(glm::vec3(0.8f)));
  Mesh cube{.name = "cube", .primitives = {}, .morph_weights = {}};
  for (Mesh& face : s.scene.meshes) cube.primitives.push_back(std::move(face.primitives[0]));
  s.scene.meshes = {std::move(cube)};
  s.scene.nodes.clear();
  const int side = static_cast<int>(std::ceil(std::cbrt(static_cast<float>(count)) - 1e-4f));
  for (int i = 0; i < count; ++i) {
    Node node;
    node.mesh = 0;
    node.translation = glm::vec3(i % side, i / side % side, i / (side * side));
    s.scene.nodes.push_back(node);
  }
  add_sun(s.scene, "0.3,-1,-0.4 5");
  return s;
}

inline WorldCamera view_of_cubes(const ExtentScene& s) {
  const Bounds bounds = take_snapshot(s.scene).bounds;
  const glm::vec3 middle = 0.5f * (bounds.minimum + bounds.maximum);
  const float side = bounds.maximum.x - bounds.minimum.x;
  return s.camera({middle.x, middle.y, 2.5f * side}, middle, glm::degrees(0.8f));
}

}  // namespace lightwell
