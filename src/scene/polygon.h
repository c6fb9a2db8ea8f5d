// Polygons to triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_float3.hpp>

namespace lightwell {

// The polygon's area vector by Newell's method (Sutherland et al. 1974), also of bent ones: its direction is the
// polygon's normal, its length twice the area.
glm::dvec3 polygon_area_vector(std::span<const glm::vec3> corners);

// Cuts the polygons of one file into triangles. Work is bounded by the file: very large concave polygons, of which only
// hostile files have many, become fans once it is used up.
class Triangulator {
 public:
  // Appends three places in `corners` a triangle, wound as the polygon. Convex polygons become fans about their first
  // corner; others are seen along their normal and lose one ear after the other (Meisters 1975), corners between
  // parallel edges included. Fewer than three corners give nothing.
  void triangulate(std::span<const glm::vec3> corners, std::vector<std::uint32_t>& triangles);

  // Of polygons that became fans though they are concave.
  std::size_t unfinished() const { return unfinished_; }

 private:
  std::uint64_t work_left_ = std::uint64_t{1} << 26;  // corners that are held against an ear: about half a second
  std::size_t unfinished_ = 0;
};

}  // namespace lightwell
