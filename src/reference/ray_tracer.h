// What a ray meets: Embree's answer turned into a surface that light can leave again.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include <glm/ext/vector_float3.hpp>

#include "reference/flat_scene.h"

namespace lightwell {

struct Ray {
  glm::vec3 origin{0.0f};
  glm::vec3 direction{0.0f};  // any length; distances along the ray are in units of it
  float t_min = 0.0f;
};

// A point of a triangle, seen from where the ray came.
struct Surface {
  std::size_t triangle = 0;
  glm::vec3 position{0.0f};
  glm::vec3 geometric_normal{0.0f};  // unit, towards the ray
  glm::vec3 shading_normal{0.0f};    // unit, interpolated, on the same side as the geometric one
  glm::vec3 albedo{0.0f};
  glm::vec3 emission{0.0f};  // towards the ray, W/(sr m^2)
  float clearance = 0.0f;    // metres along the geometric normal that rounding errors may span here

  // Where rays start that leave on the ray's side.
  glm::vec3 start() const { return position + clearance * geometric_normal; }
};

// Metres of rounding error around a triangle: errors grow with its coordinates, not with its distance from the eye.
float clearance_of(const FlatScene& flat, std::size_t triangle);

// Where a ray meets a triangle.
struct TriangleHit {
  std::size_t triangle = 0;
  float t = 0.0f;  // in units of the ray's direction
  float u = 0.0f;  // weights of the second and third corner
  float v = 0.0f;
};

class RayTracer {
 public:
  // Builds the acceleration structure. `flat` must outlive the tracer and stay where it is. Throws InputError naming
  // Embree's complaint.
  explicit RayTracer(const FlatScene& flat);
  ~RayTracer();

  // The nearest surface; what its alpha cuts out is passed through.
  std::optional<Surface> closest(const Ray& ray) const;

  // The same without what it looks like.
  std::optional<TriangleHit> closest_triangle(const Ray& ray) const;

  // Whether anything opaque is on the way from `origin` to origin + t_max * direction.
  bool is_blocked(const glm::vec3& origin, const glm::vec3& direction, float t_max) const;

 private:
  struct Handles;
  const FlatScene& flat_;
  std::unique_ptr<Handles> handles_;
};

}  // namespace lightwell
