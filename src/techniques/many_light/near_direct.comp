// Light straight from lights, emitters and the environment at receivers, with one shadow ray each: one sample of each
// kind is looked at, and one of these is chosen in proportion to what it brings if nothing is in between.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/environment_kind.h"
#include "shaders/lights.h"
#include "techniques/many_light/many_light_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint kEnvironment = kEnvironmentBlack;
layout(constant_id = 2) const bool kEmitters = true;
LW_PUSH_CONSTANTS(NearDirectParams, LW_NEAR_DIRECT_PARAMS)
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) uniform sampler2D face;
layout(set = 0, binding = 3) uniform sampler2D environment;
layout(set = 0, binding = 4) readonly buffer LightBuffer { GpuLight data[]; } lights;
layout(set = 0, binding = 5, rgba32f) writeonly uniform image2D irradiance;

#include "shaders/trace.glsl"

#include "passes/emitters/emitters_types.h"

layout(set = 0, binding = 6) readonly buffer EmitterBuffer { EmissiveTriangle data[]; } emitters;
layout(set = 0, binding = 7) readonly buffer GroupBuffer { EmitterGroup data[]; } groups;
layout(set = 0, binding = 8) readonly buffer EnvironmentTableBuffer { float data[]; } environment_table;

#include "shaders/environment.glsl"
#include "shaders/environment_table.glsl"
#include "shaders/hemisphere.glsl"
#include "shaders/lights.glsl"
#include "shaders/luminance.glsl"
#include "passes/emitters/emitters.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/random.glsl"
#include "shaders/receiver.glsl"

// A reservoir of one (weighted, in proportion to luminance).
vec3 chosen_light = vec3(0.0);
Ray chosen_ray;
float all_weight = 0.0;
float choice = 0.0;  // uniform random number; what is left of it after a decision is uniform again

void offer(vec3 light, Ray ray) {
  float weight = luminance(light);
  if (!(weight > 0.0)) return;
  float before = all_weight;
  all_weight += weight;
  float at = choice * all_weight;
  bool takes = at >= before;
  choice = clamp(takes ? (at - before) / weight : at / max(before, 1e-37), 0.0, 0.99999994);
  if (!takes) return;
  chosen_light = light;
  chosen_ray = ray;
}

// All lights where they are few; else every n-th from a random one on, n times as bright.
void offer_lights(Receiver receiver, float u) {
  const uint kMost = 32;
  const float kLightClearance = 1e-4;  // of the distance
  uint stride = (params.light_count + kMost - 1) / kMost;
  for (uint i = uint(u * float(stride)); i < params.light_count; i += stride) {
    GpuLight light = lights.data[i];
    vec3 to_light;
    vec3 e = unshadowed_irradiance(light, receiver.position, to_light);
    e *= cosine_above(receiver, to_light) * float(stride);
    bool parallel = light.type == kLightDirectional;
    offer(e, Ray(receiver.start, 0.0, parallel ? to_light : light.position - receiver.start,
                 parallel ? kFarAway : 1.0 - kLightClearance));
  }
}

void offer_emitter(Receiver receiver, vec2 u) {
  EmitterPoint point = sample_emitter(u);
  vec3 offset = point.position - receiver.position;
  float squared = dot(offset, offset);
  vec3 direction = offset * inversesqrt(max(squared, 1e-37));
  float cosine_there = -dot(point.front, direction);
  bool lit = (cosine_there > 0.0 || point.both_sides) && squared > 0.0;
  float geometry = lit ? cosine_above(receiver, direction) * abs(cosine_there) / squared : 0.0;
  vec3 end = ray_start(point.position, cosine_there > 0.0 ? point.front : -point.front);
  offer(point.radiance * (geometry * point.inverse_density), Ray(receiver.start, 0.0, end - receiver.start, 1.0));
}

void offer_environment(Receiver receiver, vec2 u) {
  EnvironmentSample sampled = EnvironmentSample(cosine_direction(frame_about(receiver.normal), disk_point(u)), 0.0);
  float cosine = cosine_above(receiver, sampled.direction);
  float inverse_density = kPi / max(dot(receiver.normal, sampled.direction), 1e-6);
  if (kEnvironment == kEnvironmentMap) {
    sampled = sample_environment(params.table_size, u);
    cosine = cosine_above(receiver, sampled.direction);
    inverse_density = sampled.density > 0.0 ? 1.0 / sampled.density : 0.0;
  }
  offer(environment_radiance(sampled.direction) * (cosine * inverse_density),
        Ray(receiver.start, 0.0, sampled.direction, kFarAway));
}

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  vec4 place = texelFetch(position, ivec2(pixel), 0);
  vec3 sum = vec3(0.0);
  if (place.w > 0.0) {
    Receiver receiver = make_receiver(place, texelFetch(normal, ivec2(pixel), 0).xyz,
                                      from_octahedron(texelFetch(face, ivec2(pixel), 0).xy), 0.0);
    vec2 random = stratified_point(pixel, params.sample_index, params.sequence);
    choice = random.x;
    offer_lights(receiver, random.y);
    if (kEmitters) offer_emitter(receiver, stratified_point(pixel, params.sample_index, params.sequence + 1));
    if (kEnvironment != kEnvironmentBlack)
      offer_environment(receiver, stratified_point(pixel, params.sample_index, params.sequence + 2));
    if (all_weight > 0.0 && !is_blocked(chosen_ray)) sum = chosen_light * (all_weight / luminance(chosen_light));
  }
  imageStore(irradiance, ivec2(pixel), vec4(sum, 1.0));
}
