// Small scenes made in code. For tests only.
#pragma once

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "lightwell/renderer.h"
#include "lightwell/scene.h"

namespace lightwell {

struct TestScene {
  Scene scene;

  int add_material(const glm::vec3& albedo, const glm::vec3& emission = glm::vec3(0.0f)) {
    Material material;
    material.base_color = {albedo, 1.0f};
    material.emission = emission;
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
  }

  // Parallelogram corner, + a, + a + b, + b with texture coordinates (0,0), (1,0), (1,1), (0,1); its front is the side
  // that a x b points to. Returns its node.
  int add_quad(const glm::vec3& corner, const glm::vec3& a, const glm::vec3& b, int material) {
    Primitive quad;
    quad.positions = {corner, corner + a, corner + a + b, corner + b};
    quad.normals.assign(4, glm::normalize(glm::cross(a, b)));
    quad.texcoords[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    quad.indices = {0, 1, 2, 0, 2, 3};
    quad.material = material;
    Node node;
    node.mesh = static_cast<int>(scene.meshes.size());
    scene.meshes.emplace_back().primitives.push_back(std::move(quad));
    scene.nodes.push_back(node);
    return static_cast<int>(scene.nodes.size()) - 1;
  }

  // 2 x 2 m in the plane z = 0, centred, front towards +z.
  int add_wall(int material) { return add_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, material); }

  Picture render(Device& device, const RendererOptions& options, const WorldCamera& camera) const {
    const SceneSnapshot snapshot = take_snapshot(scene);
    return Renderer(device, scene, snapshot, options).render({&snapshot, camera});
  }
};

inline WorldLight point_light(const glm::vec3& position, const glm::vec3& intensity) {
  WorldLight light;
  light.position = position;
  light.intensity = intensity;
  return light;
}

// Looks from (0, 0, distance) along -z; the picture is `height` metres high at z = 0.
inline WorldCamera camera_before_wall(float distance, float height) {
  WorldCamera camera;
  camera.position = {0, 0, distance};
  camera.yfov = 2.0f * std::atan(0.5f * height / distance);
  return camera;
}

inline RendererOptions square_picture(int side) {
  RendererOptions options;
  options.width = side;
  options.height = side;
  options.samples = 1;
  return options;
}

}  // namespace lightwell
