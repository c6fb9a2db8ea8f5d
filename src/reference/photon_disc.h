// How much of the disc of a photon estimate lies on surface.
#pragma once

#include <glm/ext/vector_float3.hpp>

#include "reference/path_integrator.h"
#include "reference/random.h"

namespace lightwell {

// The part of the disc of `radius` metres about `point` where a photon could have counted (lightwell::PhotonMap), in
// (0, 1], from a few rays along the normal. At an edge of a surface it is less than 1, and irradiance divided by it is
// right there, too.
float part_on_surface(const TracedWorld& world, const glm::vec3& point, const glm::vec3& normal, float radius,
                      Sampler& sampler);

}  // namespace lightwell
