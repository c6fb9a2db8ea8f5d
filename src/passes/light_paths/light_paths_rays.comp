// First surfaces of the paths of all sources without maps: a ray leaves the source in proportion to its radiance, and
// what it meets is the first surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_paths/light_paths_params.h"
#include "shaders/light_point.h"
#include "shaders/lights.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kEnvironment = kSkyBlack;
layout(constant_id = 3) const bool kEmitters = true;
layout(constant_id = 6) const bool kGuided = false;
layout(set = 0, binding = 0) readonly buffer LightBuffer { GpuLight data[]; } lights;
layout(set = 0, binding = 1) readonly buffer PowerBuffer { float data[]; } map_powers;
layout(set = 0, binding = 2) readonly buffer SourceBuffer { float data[]; } sources;
layout(set = 0, binding = 3) buffer LightPointBuffer { LightPoint data[]; } points;
layout(set = 0, binding = 4) buffer SurvivalBuffer { float data[]; } survivals;
layout(set = 0, binding = 9) readonly buffer SobolBuffer { uint data[]; } sobol_matrices;
layout(set = 0, binding = 5) uniform sampler2D environment;
layout(set = 0, binding = 10) buffer AreaBuffer { float data[]; } areas;
layout(set = 0, binding = 11) readonly buffer GuideBuffer { float data[]; } guide;
layout(set = 0, binding = 12) writeonly buffer StratumBuffer { uint data[]; } strata;  // of paths
layout(set = 0, binding = 13) buffer PathCountBuffer { uvec2 data[]; } stratum_counts;  // x: paths

#include "shaders/trace.glsl"

#include "passes/emitters/emitters_types.h"

layout(set = 0, binding = 6) readonly buffer EmitterBuffer { EmissiveTriangle data[]; } emitters;
layout(set = 0, binding = 7) readonly buffer GroupBuffer { EmitterGroup data[]; } groups;
layout(set = 0, binding = 8) readonly buffer EnvironmentTableBuffer { float data[]; } environment_table;

#include "shaders/luminance.glsl"
#include "passes/emitters/emitters.glsl"
#include "passes/light_paths/aimed_rays.glsl"
#include "passes/light_paths/guide.glsl"
#include "passes/light_paths/light_rays.glsl"
#include "passes/light_paths/path_points.glsl"
#include "passes/light_paths/sequence.glsl"
#include "passes/light_paths/sources.glsl"
#include "shaders/environment.glsl"
#include "shaders/environment_table.glsl"
#include "shaders/linear_dispatch.glsl"

// From an emissive triangle, cosine-distributed; from one that emits from both sides, half of the rays from its back.
LightRay emitter_ray(vec2 u, vec2 place) {
  EmitterPoint point = sample_emitter(u);
  vec3 side = point.front;
  float sides = 1.0;
  if (point.both_sides) {
    sides = 2.0;
    if (place.x >= 0.5) side = -side;
    place.x = fract(2.0 * place.x);
  }
  LightRay ray;
  ray.inverse_range = 0.0;
  ray.direction = cosine_direction(frame_about(side), disk_point(place));
  ray.origin = ray_start(point.position, side);
  ray.flux = point.radiance * (sides * kPi * point.inverse_density);
  float cosine = max(dot(side, ray.direction), 1e-3);
  ray.angle = sides * kPi / cosine;
  ray.area = point.inverse_density * cosine;
  return ray;
}

LightRay environment_ray(vec2 u, vec2 place) {
  EnvironmentSample sampled;
  if (kEnvironment == kSkyMap) {
    sampled = sample_environment(params.table_size, u);
  } else {
    sampled = EnvironmentSample(cone_direction(vec3(0.0, 0.0, 1.0), 2.0, u), 1.0 / (4.0 * kPi));
  }
  LightRay ray;
  ray.inverse_range = 0.0;
  ray.direction = -sampled.direction;
  ray.origin = parallel_start(ray.direction, place, ray.area);
  ray.flux = vec3(0.0);
  ray.angle = 0.0;
  if (sampled.density > 0.0) ray.flux = environment_radiance(sampled.direction) * (ray.area / sampled.density);
  return ray;
}

// Whether a guide spreads the ray's place of entry, rather than the two numbers before.
bool is_guided_by_place(uint source) {
  return is_environment(source) ||
         (source < params.light_count && lights.data[source].type == kLightDirectional);
}

// Warps the source's numbers; gives the density over that without a guide.
float guide_numbers(uint path, uint source, inout vec2 u, inout vec2 place) {
  if (!kGuided) return 1.0;
  strata.data[path] = kNoStratum;
  if (source == kNoSource) return 1.0;
  bool by_place = is_guided_by_place(source);
  GuidedNumbers guided = guided_numbers(source, sources.data[params.light_count + 2], by_place ? place : u);
  if (by_place) place = guided.u;
  else u = guided.u;
  strata.data[path] = guided.stratum;
  atomicAdd(stratum_counts.data[guided.stratum].x, 1);
  return guided.density;
}

void main() {
  uint path = linear_invocation();
  if (path >= params.path_count) return;
  uint index = params.first_path + path;
  SourceChoice choice = choose_source(source_number(index));
  if (choice.source < params.light_count && map_powers.data[choice.source] >= 0.0) return;
  vec2 u = start_numbers(index, choice.place);
  vec2 place = place_numbers(index);
  float probability = choice.probability * guide_numbers(path, choice.source, u, place);
  LightRay start = LightRay(vec3(0.0), vec3(0.0, 1.0, 0.0), vec3(0.0), 0.0, 0.0, 0.0);
  if (choice.source < params.light_count) start = light_ray(lights.data[choice.source], u, place);
  if (kEmitters && is_emitters(choice.source)) start = emitter_ray(u, place);
  if (kEnvironment != kSkyBlack && is_environment(choice.source)) start = environment_ray(u, place);

  vec3 flux = max(max(start.flux.r, start.flux.g), start.flux.b) > 0.0
                  ? start.flux / (probability * float(params.path_count))
                  : vec3(0.0);
  RayHit hit = RayHit(0.0, kNoTriangle, vec2(0.0));
  if (flux != vec3(0.0)) hit = trace_closest(Ray(start.origin, 0.0, start.direction, kFarAway));
  if (hit.triangle == kNoTriangle) {
    store_nothing(path);
    return;
  }
  Surface surface = surface_at(hit, start.direction);
  flux *= range_fall_off(start.inverse_range, hit.t * hit.t);
  flux *= surface.albedo * shading_gain(surface.normal, surface.face_normal, start.direction);
  float area = (hit.t * hit.t * start.angle + start.area) / (probability * float(params.path_count));
  store_point(path, ray_start(surface.position, surface.face_normal), surface.face_normal, flux,
              survival_of(surface.albedo), area, -dot(surface.face_normal, start.direction));
}
