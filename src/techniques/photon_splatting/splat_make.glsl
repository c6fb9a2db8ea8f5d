// Sends photons on to the surfaces where they become splats. Kernels include shaders/trace.glsl first, have
// PhotonParams and declare
//   LW_SPLATS_WRITE(0, n)
//   layout(set = 0, binding = n) writeonly buffer StartBuffer { PhotonStart data[]; } starts;
//   layout(set = 0, binding = n) readonly buffer PointCountBuffer { uint data[]; } point_counts;
//   layout(set = 0, binding = n) readonly buffer SobolBuffer { uint data[]; } sobol_matrices;
#ifndef LIGHTWELL_PHOTON_SPLATTING_SPLAT_MAKE_GLSL
#define LIGHTWELL_PHOTON_SPLATTING_SPLAT_MAKE_GLSL

#include "passes/light_paths/sobol_numbers.glsl"
#include "shaders/finite.glsl"
#include "shaders/hemisphere.glsl"
#include "shaders/light_point.glsl"

// The number, in the sequence of paths, of the path that left light point `index`.
uint path_of(uint index) {
  uint round_points = params.paths * params.bounces;
  return params.first_path + index / round_points * params.paths + index % params.paths;
}

// Half the side of the square across the ray that holds params.photons of those that arrive with this one. A photon's
// share of such a square is t^2 / (n p) + a: n photons leave with the density p = cos / pi, each from the area a, and
// fly for t.
float adaptive_half_width(LightPoint point, float area, float t, float cosine) {
  float leaving = max(cosine, 1e-3);
  float n = float(point_counts.data[kPointsOfBounce + min(point.bounces, params.bounces) - 1]) *
            (float(params.all_rounds) / float(params.rounds));
  float each = t * t * kPi / (leaving * max(n, 1.0)) + area / float(params.all_rounds) * leaving;
  // Farther across than along, a bundle says nothing: close to its start nothing else leaves as it does.
  return min(t, 0.5 * sqrt(min(params.photons * each, 1e30)));
}

// A bundle of photons leaves `point`, which has the flux of all, as one. `area`: m^2 that one of them stands for.
void make_splat(uint slot, LightPoint point, float bundled, float area, uint path) {
  const float kLeastCosine = 0.15;
  const float kDiagonal = 1.41421356;
  vec3 normal = unpack_unit_vector(point.normal);
  vec3 direction = cosine_direction(frame_about(normal), disk_point(sobol_bounce_numbers(path, point.bounces + 1).xy));
  direction = unpack_unit_vector(pack_unit_vector(direction));  // as it is stored: the center lies on its ray
  RayHit hit = trace_closest(Ray(point.position, 0.0, direction, kFarAway));
  Splat splat = Splat(vec3(0.0), params.least_half, vec3(0.0, 0.0, 1.0), params.least_half, vec3(0.0), bundled, 1.0,
                      slot, 0);
  float leaving = dot(normal, direction);
  if (hit.triangle != kNoTriangle) {
    Surface surface = surface_at(hit, direction);
    float half_width = params.half_width > 0.0 ? params.half_width : adaptive_half_width(point, area, hit.t, leaving);
    splat.half_width = clamp(half_width * sqrt(bundled), params.least_half, params.most_half);
    splat.half_width = short_to_float(nearest_short(splat.half_width));  // the reach follows from what is stored
    splat.center = surface.position;
    splat.direction = direction;
    splat.normal = pack_unit_vector(surface.face_normal);
    // The plane of the surface leaves the box at the farthest corner, or at its ends where the ray skims it.
    float cosine = max(-dot(surface.face_normal, direction), kLeastCosine);
    float slope = sqrt(max(1.0 - cosine * cosine, 0.0)) / cosine;
    splat.reach = params.step_back > 0.0 ? min(params.step_back, hit.t) : splat.half_width * (kDiagonal * slope + 1.0);
    if (is_finite(surface.position) && is_finite(surface.face_normal) && splat.reach > 0.0)
      splat.flux = point.flux / float(params.all_rounds);
  }
  store_splat(slot, splat);
  starts.data[slot] = PhotonStart(point.position, point.normal);
}

#endif
