// Scenes with known answers, made in code. For tests only.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>

#include "lightwell/path_tracer.h"
#include "lightwell/scene.h"
#include "reference/sampling.h"

namespace lightwell {

// A scene under construction: every primitive becomes a mesh with one instance that stands where it was modelled.
struct TestScene {
  Scene scene;
  SceneSnapshot snapshot;

  int add_material(const glm::vec3& albedo, const glm::vec3& emission = glm::vec3{0.0f}) {
    Material material;
    material.base_color = {albedo, 1.0f};
    material.emission = emission;
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
  }

  void add_primitive(Primitive primitive) {
    Mesh mesh;
    mesh.primitives.push_back(std::move(primitive));
    scene.meshes.push_back(std::move(mesh));
    MeshInstance instance;
    instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
    snapshot.instances.push_back(instance);
  }

  // Parallelogram corner, corner + a, corner + a + b, corner + b with texture coordinates (0,0), (1,0), (1,1), (0,1);
  // its front is the side that a x b points to.
  void add_quad(const glm::vec3& corner, const glm::vec3& a, const glm::vec3& b, int material) {
    Primitive quad;
    quad.positions = {corner, corner + a, corner + a + b, corner + b};
    quad.normals.assign(4, glm::normalize(glm::cross(a, b)));
    quad.texcoords[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    quad.indices = {0, 1, 2, 0, 2, 3};
    quad.material = material;
    add_primitive(std::move(quad));
  }

  // Axis-aligned cube whose fronts face inwards.
  void add_box_seen_from_inside(const glm::vec3& center, float half, int material) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const float side : {-1.0f, 1.0f}) {
        glm::vec3 n{0.0f}, a{0.0f}, b{0.0f};
        n[axis] = side * half;
        a[(axis + 1) % 3] = 2.0f * half;
        b[(axis + 2) % 3] = side < 0.0f ? 2.0f * half : -2.0f * half;
        add_quad(center + n - 0.5f * (a + b), a, b, material);
      }
    }
  }

  // Latitude-longitude sphere with interpolated normals; `inwards`: its front faces the centre.
  void add_sphere(const glm::vec3& center, float radius, int rings, bool inwards, int material) {
    Primitive sphere;
    const int segments = 2 * rings;
    for (int i = 0; i <= rings; ++i) {
      for (int j = 0; j <= segments; ++j) {
        const float theta = kPi * static_cast<float>(i) / static_cast<float>(rings);
        const float phi = 2.0f * kPi * static_cast<float>(j % segments) / static_cast<float>(segments);
        const glm::vec3 d{std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)};
        sphere.positions.push_back(center + radius * d);
        sphere.normals.push_back(inwards ? -d : d);
      }
    }
    const auto index = [segments](int i, int j) { return static_cast<std::uint32_t>(i * (segments + 1) + j); };
    for (int i = 0; i < rings; ++i) {
      for (int j = 0; j < segments; ++j) {
        std::vector<std::uint32_t> quad{index(i, j), index(i + 1, j),     index(i + 1, j + 1),
                                        index(i, j), index(i + 1, j + 1), index(i, j + 1)};
        if (inwards) quad = {quad[0], quad[2], quad[1], quad[3], quad[5], quad[4]};
        sphere.indices.insert(sphere.indices.end(), quad.begin(), quad.end());
      }
    }
    sphere.material = material;
    add_primitive(std::move(sphere));
  }

  // An emission or base colour texture of one row of texels.
  int add_texture(std::vector<std::uint8_t> rgba, bool nearest) {
    Texture texture;
    texture.width = static_cast<int>(rgba.size() / 4);
    texture.height = 1;
    texture.rgba = std::move(rgba);
    texture.nearest = nearest;
    scene.textures.push_back(texture);
    return static_cast<int>(scene.textures.size()) - 1;
  }

  Picture render(const WorldCamera& camera, const PathTracerOptions& options) const {
    return PathTracer(scene, snapshot).render(camera, options);
  }
};

inline WorldCamera camera_at(const glm::vec3& eye, const glm::vec3& target, const glm::vec3& up, float yfov) {
  WorldCamera camera;
  camera.position = eye;
  camera.forward = glm::normalize(target - eye);
  camera.up = glm::normalize(up - glm::dot(up, camera.forward) * camera.forward);
  camera.yfov = yfov;
  camera.znear = 0.0f;
  return camera;
}

// A small square picture.
inline PathTracerOptions test_options(int side, int samples, int max_bounces) {
  PathTracerOptions options;
  options.width = side;
  options.height = side;
  options.samples = samples;
  options.max_bounces = max_bounces;
  return options;
}

inline glm::dvec3 mean_of(const Image& image) {
  glm::dvec3 sum{0.0};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) sum += glm::dvec3{image.at(x, y)[0], image.at(x, y)[1], image.at(x, y)[2]};
  }
  return sum / (static_cast<double>(image.width) * image.height);
}

}  // namespace lightwell
