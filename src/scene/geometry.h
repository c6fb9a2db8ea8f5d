// What every importer does to triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/scene.h"

namespace lightwell {

// Unit normal of a triangle, counter-clockwise seen from its tip; (0,0,1) if the triangle has no area.
glm::vec3 triangle_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

// The triangles `indices` of a primitive, each corner with a vertex of its own.
Primitive with_own_vertices(const Primitive& primitive, const std::vector<std::uint32_t>& indices);

// What importers of text subtract from vertices in double precision, and their mesh's node adds again: where all of
// them are far from 0, single precision would move them. 0 if they are not; positions that are not finite do not count.
class FarVertices {
 public:
  // False once it is known that they are not far.
  bool add(const glm::dvec3& position);
  glm::dvec3 base() const;

 private:
  glm::dvec3 minimum_{0.0}, maximum_{0.0};
  bool any_ = false, near_ = false;
};

// Gives every triangle vertices of its own and its geometric normal (glTF's rule where normals are missing). Morph
// targets get the offsets that turn it to the normal of their own shape.
void make_flat(Primitive& primitive);

// Makes normals unit length; where a file gives none or nonsense, takes the sum over the vertex's triangles.
void repair_normals(Primitive& primitive);

// Triangles of a strip or a fan, from its list of vertices, with the orientation of the first kept.
std::vector<std::uint32_t> triangles_of_strip(const std::vector<std::uint32_t>& strip);
std::vector<std::uint32_t> triangles_of_fan(const std::vector<std::uint32_t>& fan);

}  // namespace lightwell
