// Where photons start: every light of the scene, in proportion to what it sends.
#pragma once

#include <limits>
#include <vector>

#include <glm/ext/vector_float3.hpp>

#include "reference/path_integrator.h"
#include "reference/random.h"
#include "reference/sampling.h"

namespace lightwell {

// The box around all triangles; empty scenes have one without extent.
Bounds triangle_bounds(const FlatScene& flat);

// A photon on its way into the scene.
struct PhotonStart {
  Ray ray;                                               // unit direction
  glm::vec3 flux{0.0f};                                  // W; 0: there is no photon
  float range = std::numeric_limits<float>::infinity();  // of its light, m: range_falloff() dims it where it arrives
};

// One photon stands for all light: the mean of `flux` over many photons is what all lights send together, and of those
// photons that meet a surface, what arrives there. The source is chosen in proportion to the luminance of its power,
// directions of punctual lights in proportion to their intensity, points and directions of emitters in proportion to
// emission and cosine. Suns and the environment send through the box around the scene, in proportion to the area that
// it shows them.
class PhotonSources {
 public:
  // `world` must outlive this.
  explicit PhotonSources(const TracedWorld& world);

  // Whether emit() ever starts a photon.
  bool empty() const { return !(choice_.total() > 0.0); }
  // Needs !empty(). Takes the same dimensions of the sampler whatever the source.
  PhotonStart emit(Sampler& sampler) const;

 private:
  PhotonStart from_light(const WorldLight& light, glm::vec2 u_position, glm::vec2 u_direction) const;
  PhotonStart from_triangle(float u_choice, float u_side, glm::vec2 u_position, glm::vec2 u_direction) const;
  PhotonStart from_environment(glm::vec2 u_position, glm::vec2 u_direction) const;
  PhotonStart through_box(const glm::vec3& direction, const glm::vec3& irradiance, glm::vec2 u) const;
  float light_power(const WorldLight& light) const;
  float environment_power() const;

  const TracedWorld& world_;
  Bounds bounds_;
  DiscreteDistribution choice_;  // punctual lights, then all emissive triangles together, then the environment
};

}  // namespace lightwell
