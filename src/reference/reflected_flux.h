// How much light a scene's surfaces reflect, bounce by bounce: the truth for methods that carry flux.
#pragma once

#include <cstdint>

#include <glm/ext/vector_double3.hpp>

#include "lightwell/scene.h"

namespace lightwell {

struct ReflectedFlux {
  glm::dvec3 first{0.0};    // W, reflected by the first surface that light meets
  glm::dvec3 further{0.0};  // W, reflected by the second to the last surface of those that are asked for, together
};

// The integral of pi times the reflected radiance over both sides of all triangles, at `samples` points that are spread
// evenly over their area. `surfaces`: that light meets at most, 1 at least. The error falls with 1 / sqrt(samples). The
// same result for the same arguments, whatever the number of threads.
ReflectedFlux integrate_reflected_flux(const Scene& scene, const SceneSnapshot& snapshot, int surfaces,
                                       std::uint32_t samples, std::uint32_t seed);

}  // namespace lightwell
