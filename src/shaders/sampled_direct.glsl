// Light straight from lights, emitters and the environment at a receiver, with one shadow ray: one sample of each kind
// is looked at, and one of these is chosen in proportion to what it brings if nothing is in between (resampling, Talbot
// et al. 2005). The including kernel declares, before including this file (shaders/lights.h and shaders/trace.glsl come
// first),
//   layout(set = 0, binding = n) uniform sampler2D environment;
//   layout(set = 0, binding = n) readonly buffer LightBuffer { GpuLight data[]; } lights;
//   layout(set = 0, binding = n) readonly buffer EmitterBuffer { EmissiveTriangle data[]; } emitters;
//   layout(set = 0, binding = n) readonly buffer GroupBuffer { EmitterGroup data[]; } groups;
//   layout(set = 0, binding = n) readonly buffer EnvironmentTableBuffer { float data[]; } environment_table;
// and has params.table_size, params.emitter_count, params.light_count. Host side: passes/sampled_lights/
// direct_sources.h.
#ifndef LIGHTWELL_SAMPLED_DIRECT_GLSL
#define LIGHTWELL_SAMPLED_DIRECT_GLSL

#include "shaders/environment.glsl"
#include "shaders/environment_kind.h"
#include "shaders/environment_table.glsl"
#include "shaders/hemisphere.glsl"
#include "shaders/lights.glsl"
#include "shaders/luminance.glsl"
#include "passes/emitters/emitters.glsl"
#include "shaders/receiver.glsl"

layout(constant_id = 0) const uint kEnvironment = kEnvironmentBlack;
layout(constant_id = 2) const bool kEmitters = true;

// A reservoir of one (weighted, in proportion to luminance).
struct DirectChoice {
  vec3 light;
  Ray ray;
  float all_weight;
  float u;  // uniform random number; what is left of it after a decision is uniform again
};

void offer(inout DirectChoice choice, vec3 light, Ray ray) {
  float weight = luminance(light);
  if (!(weight > 0.0)) return;
  float before = choice.all_weight;
  choice.all_weight += weight;
  float at = choice.u * choice.all_weight;
  bool takes = at >= before;
  choice.u = clamp(takes ? (at - before) / weight : at / max(before, 1e-37), 0.0, 0.99999994);
  if (!takes) return;
  choice.light = light;
  choice.ray = ray;
}

// All lights where they are few; else every n-th from a random one on, n times as bright.
void offer_lights(inout DirectChoice choice, Receiver receiver, float u) {
  const uint kMost = 32;
  const float kLightClearance = 1e-4;  // of the distance
  uint stride = (params.light_count + kMost - 1) / kMost;
  for (uint i = uint(u * float(stride)); i < params.light_count; i += stride) {
    GpuLight light = lights.data[i];
    vec3 to_light;
    vec3 e = unshadowed_irradiance(light, receiver.position, to_light);
    e *= cosine_above(receiver, to_light) * float(stride);
    bool parallel = light.type == kLightDirectional;
    offer(choice, e,
          Ray(receiver.start, 0.0, parallel ? to_light : light.position - receiver.start,
              parallel ? kFarAway : 1.0 - kLightClearance));
  }
}

void offer_emitter(inout DirectChoice choice, Receiver receiver, float share, vec2 u) {
  EmitterPoint point = sample_emitter(u);
  vec3 offset = point.position - receiver.position;
  float squared = dot(offset, offset);
  vec3 direction = offset * inversesqrt(max(squared, 1e-37));
  float cosine_there = -dot(point.front, direction);
  bool lit = (cosine_there > 0.0 || point.both_sides) && squared > 0.0;
  float geometry = lit ? cosine_above(receiver, direction) * abs(cosine_there) / squared : 0.0;
  if (share > 0.0) geometry = min(geometry, largest_geometry_term(point.factor_luminance, share));
  vec3 end = ray_start(point.position, cosine_there > 0.0 ? point.front : -point.front);
  offer(choice, point.radiance * (geometry * point.inverse_density),
        Ray(receiver.start, 0.0, end - receiver.start, 1.0));
}

void offer_environment(inout DirectChoice choice, Receiver receiver, vec2 u) {
  EnvironmentSample sampled = EnvironmentSample(cosine_direction(frame_about(receiver.normal), disk_point(u)), 0.0);
  float cosine = cosine_above(receiver, sampled.direction);
  float inverse_density = kPi / max(dot(receiver.normal, sampled.direction), 1e-6);
  if (kEnvironment == kEnvironmentMap) {
    sampled = sample_environment(params.table_size, u);
    cosine = cosine_above(receiver, sampled.direction);
    inverse_density = sampled.density > 0.0 ? 1.0 / sampled.density : 0.0;
  }
  offer(choice, environment_radiance(sampled.direction) * (cosine * inverse_density),
        Ray(receiver.start, 0.0, sampled.direction, kFarAway));
}

// Irradiance (W/m^2), an unbiased sample of it. The three points of [0,1)^2 are independent of each other. `share`: of
// largest_geometry_term() for emitters, 0 where nobody brings what that leaves to cosine-distributed rays.
vec3 sampled_direct(Receiver receiver, float share, vec2 u, vec2 u_emitter, vec2 u_environment) {
  DirectChoice choice = DirectChoice(vec3(0.0), Ray(receiver.start, 0.0, receiver.face, 0.0), 0.0, u.x);
  offer_lights(choice, receiver, u.y);
  if (kEmitters) offer_emitter(choice, receiver, share, u_emitter);
  if (kEnvironment != kEnvironmentBlack) offer_environment(choice, receiver, u_environment);
  if (!(choice.all_weight > 0.0) || is_blocked(choice.ray)) return vec3(0.0);
  return choice.light * (choice.all_weight / luminance(choice.light));
}

#endif
