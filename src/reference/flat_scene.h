// The scene as one list of world-space triangles: what the ray tracer and the light samplers see.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_float4.hpp>

#include "lightwell/scene.h"
#include "reference/texturing.h"

namespace lightwell {

struct FlatVertex {
  glm::vec3 position;
  glm::vec3 normal;  // unit, or 0 where the transform leaves none
  TexcoordSets texcoords;
};

struct FlatTriangle {
  std::array<std::uint32_t, 3> vertices;  // counter-clockwise seen from the front
  std::uint32_t material;
};

struct FlatScene {
  const Scene* scene = nullptr;
  std::vector<FlatVertex> vertices;
  std::vector<glm::vec4> colors;        // of the vertices, which multiply the base colour; empty: all white
  std::vector<FlatTriangle> triangles;  // those that may be cut out by their alpha come last
  std::size_t opaque_count = 0;
  std::vector<Material> materials;  // the scene's, then the default material

  const FlatVertex& corner(std::size_t triangle, std::size_t i) const {
    return vertices[triangles[triangle].vertices[i]];
  }
  const Material& material(std::size_t triangle) const { return materials[triangles[triangle].material]; }

  // (b - a) x (c - a): the front's normal, twice the area long.
  glm::vec3 area_normal(std::size_t triangle) const;
  // At barycentric weights u and v of the second and third corner.
  glm::vec3 position(std::size_t triangle, float u, float v) const;
  TexcoordSets texcoords(std::size_t triangle, float u, float v) const;
  glm::vec4 color(std::size_t triangle, float u, float v) const;
};

// Brings every instance to the world; morphed and skinned ones in their pose. Triangles without area
// are left out: they can neither be hit nor shine. Mirroring transforms keep the front side in front.
FlatScene flatten(const Scene& scene, const SceneSnapshot& snapshot);

}  // namespace lightwell
