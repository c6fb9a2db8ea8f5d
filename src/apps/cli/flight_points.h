// Fixed places on surfaces along a camera's path, and the light that they truly get.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/ext/vector_float3.hpp>

#include "apps/cli/render_methods.h"
#include "shaders/surface_point.h"

namespace lightwell {

struct FlightPlaces {
  std::vector<glsl::SurfacePoint> points;
  std::vector<double> irradiance;  // W/m^2 of light that has bounced, mean of the channels
  std::vector<double> noise;       // standard error of each of these
};

// `count` places that rays meet in random directions from random moments of the path, none on an emitter, in the world
// of its first moment. Their truth is gathered along `rays` rays each, with at most `bounces` bounces.
// `moment_at`: of frame 0 to `frames` - 1. Throws InputError where the path sees too few surfaces.
FlightPlaces find_flight_places(const Scene& scene, const std::function<Moment(int)>& moment_at, int frames, int count,
                                int rays, int bounces, std::uint32_t seed);

}  // namespace lightwell
