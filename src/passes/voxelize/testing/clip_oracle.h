// Triangles cut by the unit cube, in double precision (Sutherland and Hodgman 1974).
#pragma once

#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace lightwell {

inline std::vector<glm::dvec3> clip_to_unit_cube(std::vector<glm::dvec3> polygon) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      std::vector<glm::dvec3> kept;
      const auto distance = [&](const glm::dvec3& p) { return sign > 0 ? p[axis] : 1.0 - p[axis]; };
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& p = polygon[i];
        const glm::dvec3& q = polygon[(i + 1) % polygon.size()];
        if (distance(p) >= 0) kept.push_back(p);
        if ((distance(p) >= 0) != (distance(q) >= 0))
          kept.push_back(p + (q - p) * (distance(p) / (distance(p) - distance(q))));
      }
      polygon = kept;
    }
  }
  return polygon;
}

inline double polygon_area(const std::vector<glm::dvec3>& polygon) {
  double area = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    area += 0.5 * glm::length(glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
  return area;
}

}  // namespace lightwell
