// Lights inside the scene: punctual ones and emissive triangles.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>

#include "lightwell/scene.h"
#include "reference/flat_scene.h"
#include "reference/sampling.h"

namespace lightwell {

// What a point, spot or directional light sends to a point, were nothing in the way.
struct Illumination {
  glm::vec3 to_light;    // from the point to the light; for a directional light unit, the light beyond any distance
  float t_max;           // where along to_light the light is
  glm::vec3 direction;   // to_light, unit
  glm::vec3 irradiance;  // W/m^2 on a plane perpendicular to the direction
};
Illumination illuminate(const WorldLight& light, const glm::vec3& point);

// Part of its light that a point or spot light of a range (m) still sends so far: 1 - (d / range)^4, never negative
// (KHR_lights_punctual).
float range_falloff(float range, float distance_squared);

// Emissive triangles, chosen in proportion to area times mean luminance, then uniformly over their area.
class EmissiveTriangles {
 public:
  struct Sample {
    glm::vec3 position;  // just off the triangle, on the side of the point that is lit
    glm::vec3 radiance;  // towards that point, W/(sr m^2)
    float density;       // per steradian as seen from that point
  };

  struct AreaSample {
    std::size_t triangle;
    glm::vec3 position;
    glm::vec3 front;     // unit normal
    glm::vec3 radiance;  // that leaves the front, and of a double-sided material the back; W/(sr m^2)
    float density;       // per m^2
  };

  // `flat` must outlive this.
  explicit EmissiveTriangles(const FlatScene& flat);

  bool empty() const { return emitters_.empty(); }
  // Sum over the emitters of area times mean luminance, W/sr: pi times that leaves their fronts.
  double total_luminance() const { return choice_.total(); }
  // Needs !empty(). A point from which light leaves, whoever it is for; radiance 0 where alpha cuts the triangle out.
  AreaSample sample_area(float u_choice, glm::vec2 u_area) const;
  // Needs !empty(). Density 0: nothing arrives.
  Sample sample(float u_choice, glm::vec2 u_area, const glm::vec3& point) const;
  // Density per steradian, seen from `point`, with which sample() chooses `position` on `triangle` of unit normal
  // `normal`; 0 where sample() never goes.
  float density(std::size_t triangle, const glm::vec3& position, const glm::vec3& normal, const glm::vec3& point) const;

 private:
  const FlatScene& flat_;
  std::vector<std::size_t> emitters_;  // triangles
  DiscreteDistribution choice_;        // over emitters_
  std::vector<float> area_density_;    // per m^2, one a triangle of the scene; empty without emitters
};

}  // namespace lightwell
