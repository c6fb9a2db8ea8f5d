// One surface further: cosine-distributed about the normal of the last one, if Russian roulette lets the path go on.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_paths/light_paths_params.h"
#include "shaders/light_point.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) buffer LightPointBuffer { LightPoint data[]; } points;
layout(set = 0, binding = 1) buffer SurvivalBuffer { float data[]; } survivals;
layout(set = 0, binding = 2) readonly buffer SobolBuffer { uint data[]; } sobol_matrices;
layout(set = 0, binding = 3) buffer AreaBuffer { float data[]; } areas;

#include "shaders/trace.glsl"

#include "passes/light_paths/path_points.glsl"
#include "passes/light_paths/sequence.glsl"
#include "shaders/hemisphere.glsl"
#include "shaders/linear_dispatch.glsl"

void main() {
  uint path = linear_invocation();
  if (path >= params.path_count) return;
  uint element = (params.bounce - 2) * params.path_count + path;
  LightPoint from = points.data[element];
  float survival = survivals.data[path];
  vec3 numbers = bounce_numbers(params.first_path + path);
  RayHit hit = RayHit(0.0, kNoTriangle, vec2(0.0));
  vec3 direction = cosine_direction(frame_about(unpack_unit_vector(from.normal)), disk_point(numbers.xy));
  if (numbers.z < survival) hit = trace_closest(Ray(from.position, 0.0, direction, kFarAway));
  if (hit.triangle == kNoTriangle) {
    store_nothing(path);
    return;
  }
  Surface surface = surface_at(hit, direction);
  vec3 flux = from.flux / survival * surface.albedo *
              shading_gain(surface.normal, surface.face_normal, direction);
  // As many paths as leave the area spread out with the density cos / pi.
  float area = 0.0;
  if (kAreas) {
    float leaving = max(dot(unpack_unit_vector(from.normal), direction), 1e-3);
    area = (hit.t * hit.t * kPi / (leaving * float(params.path_count)) + areas.data[element] * leaving) / survival;
  }
  store_point(path, ray_start(surface.position, surface.face_normal), surface.face_normal, flux,
              survival_of(surface.albedo), area, -dot(surface.face_normal, direction));
}
