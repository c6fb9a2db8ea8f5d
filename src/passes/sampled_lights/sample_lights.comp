// Irradiance at every visible surface from emissive triangles and the environment, estimated with a few rays.
//
// Light points x are sampled with density p_l (over solid angle), directions about the normal with p_c = cos / pi. A
// point's radiance L counts min(1, r / kShare) in the first estimate and the rest, max(0, 1 - r / kShare), in the second,
// r = p_l / p_c. The sum is right for any r that both agree on (Veach and Guibas 1995, Eq. 9). It makes the first
// pi L / max(r, kShare): light close by can no longer be a firefly; and the second has something to find within a short
// reach only (Kollig and Keller 2006), beyond which rays need not be traced.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sampled_lights/sample_lights_params.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint kEnvironment = kEnvironmentBlack;
layout(constant_id = 2) const bool kEmitters = true;
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) uniform sampler2D face;
layout(set = 0, binding = 3) uniform sampler2D environment;
layout(set = 0, binding = 4, rgba32f) writeonly uniform image2D irradiance;

#include "shaders/trace.glsl"

#include "passes/emitters/emitters_types.h"

layout(set = 0, binding = 5) readonly buffer EmitterBuffer { EmissiveTriangle data[]; } emitters;
layout(set = 0, binding = 6) readonly buffer GroupBuffer { EmitterGroup data[]; } groups;
layout(set = 0, binding = 7) readonly buffer EnvironmentTableBuffer { float data[]; } environment_table;

#include "shaders/receiver.glsl"
#include "shaders/environment.glsl"
#include "shaders/environment_table.glsl"
#include "shaders/hemisphere.glsl"
#include "shaders/luminance.glsl"
#include "passes/emitters/emitters.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/random.glsl"

const float kFar = 3e38;

// kShare of the text above, for emitters and for the environment.
const float kEmitterShare = 2.0;
const float kEnvironmentShare = 4.0;

// Independent sequences of points.
const uint kSetEmitters = 0;
const uint kSetEnvironment = 1;
const uint kSetCosine = 2;

vec3 estimate_emitters(Receiver receiver, vec2 u) {
  EmitterPoint point = sample_emitter(u);
  vec3 offset = point.position - receiver.position;
  float distance_squared = dot(offset, offset);
  vec3 direction = offset * inversesqrt(max(distance_squared, 1e-37));
  float cosine_there = -dot(point.front, direction);
  bool lit = (cosine_there > 0.0 || point.both_sides) && distance_squared > 0.0;
  float cosine = lit ? cosine_above(receiver, direction) : 0.0;
  float geometry = min(cosine * abs(cosine_there) / distance_squared,
                       largest_geometry_term(point.factor_luminance, kEmitterShare));
  vec3 estimate = geometry > 0.0 ? point.radiance * (geometry * point.inverse_density) : vec3(0.0);
  if (estimate == vec3(0.0)) return estimate;
  Ray ray;
  ray.origin = receiver.start;
  ray.direction = ray_start(point.position, cosine_there > 0.0 ? point.front : -point.front) - receiver.start;
  ray.t_min = 0.0;
  ray.t_max = 1.0;
  return is_blocked(ray) ? vec3(0.0) : estimate;
}

vec3 estimate_environment(Receiver receiver, vec2 u) {
  EnvironmentSample sampled = sample_environment(params.table_size, u);
  float cosine = sampled.density > 0.0 ? cosine_above(receiver, sampled.direction) : 0.0;
  if (cosine <= 0.0) return vec3(0.0);
  if (is_blocked(Ray(receiver.start, 0.0, sampled.direction, kFar))) return vec3(0.0);
  return environment_radiance(sampled.direction) * min(cosine / sampled.density, kPi / kEnvironmentShare);
}

// What a cosine-distributed ray finds of the light that the other estimates leave to it.
vec3 estimate_nearby(Receiver receiver, vec2 u, float reach) {
  vec3 direction = cosine_direction(frame_about(receiver.normal), disk_point(u));
  float cosine = cosine_above(receiver, direction);
  if (cosine <= 0.0) return vec3(0.0);
  Ray ray = Ray(receiver.start, 0.0, direction, reach);
  if (!kEmitters && is_blocked(ray)) return vec3(0.0);
  if (kEmitters) {
    RayHit hit = trace_closest(ray);
    if (hit.triangle != kNoTriangle) {
      Surface surface = surface_at(hit, direction);
      if (surface.emission == vec3(0.0)) return vec3(0.0);
      float factor_luminance = luminance(scene_material(surface.material).emission.xyz);
      float left = left_to_cosine_rays(factor_luminance, kEmitterShare, hit.t, cosine,
                                       -dot(surface.face_normal, direction));
      return surface.emission * (kPi * left);
    }
  }
  if (kEnvironment == kEnvironmentBlack) return vec3(0.0);
  float left = 1.0;
  if (kEnvironment == kEnvironmentMap)
    left -= environment_density(params.table_size, direction) * kPi / (cosine * kEnvironmentShare);
  return environment_radiance(direction) * (kPi * max(left, 0.0));
}

// How far light can be that is left to cosine-distributed rays; 0: none is in reach.
float nearby_reach(Receiver receiver) {
  if (kEnvironment != kEnvironmentBlack) return kFar;
  EmitterGroup whole = groups.data[(params.emitter_count + kEmitterGroup - 1) / kEmitterGroup];
  float reach = inversesqrt(largest_geometry_term(whole.least_luminance, kEmitterShare));
  vec3 to_bounds = max(max(whole.low - receiver.position, receiver.position - whole.high), vec3(0.0));
  return dot(to_bounds, to_bounds) < reach * reach ? reach : 0.0;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(params.size)))) return;
  vec4 place = texelFetch(position, pixel, 0);
  vec3 sum = vec3(0.0);
  if (place.w > 0.0) {
    Receiver receiver = make_receiver(place, texelFetch(normal, pixel, 0).xyz,
                                      from_octahedron(texelFetch(face, pixel, 0).xy), params.clearance);
    float reach = nearby_reach(receiver);
    for (uint i = 0; i < params.samples; ++i) {
      uint index = params.first_sample + i;
      if (kEmitters) sum += estimate_emitters(receiver, stratified_point(uvec2(pixel), index, kSetEmitters));
      if (kEnvironment == kEnvironmentMap)
        sum += estimate_environment(receiver, stratified_point(uvec2(pixel), index, kSetEnvironment));
      if (reach > 0.0) sum += estimate_nearby(receiver, stratified_point(uvec2(pixel), index, kSetCosine), reach);
    }
  }
  imageStore(irradiance, pixel, vec4(sum / float(params.samples), 1.0));
}
