// Light straight from lights, emitters and the environment at receivers, with one shadow ray each.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lights.h"
#include "techniques/many_light/many_light_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
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

#include "shaders/octahedral.glsl"
#include "shaders/random.glsl"
#include "shaders/sampled_direct.glsl"

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  vec4 place = texelFetch(position, ivec2(pixel), 0);
  vec3 sum = vec3(0.0);
  if (place.w > 0.0) {
    Receiver receiver = make_receiver(place, texelFetch(normal, ivec2(pixel), 0).xyz,
                                      from_octahedron(texelFetch(face, ivec2(pixel), 0).xy), 0.0);
    sum = sampled_direct(receiver, 0.0, stratified_point(pixel, params.sample_index, params.sequence),
                         stratified_point(pixel, params.sample_index, params.sequence + 1),
                         stratified_point(pixel, params.sample_index, params.sequence + 2));
  }
  imageStore(irradiance, ivec2(pixel), vec4(sum, 1.0));
}
