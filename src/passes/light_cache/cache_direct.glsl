// Direct light at the ends of rays: bindings and functions. Kernels include shaders/trace.glsl first.
#ifndef LIGHTWELL_CACHE_DIRECT_GLSL
#define LIGHTWELL_CACHE_DIRECT_GLSL

#include "passes/emitters/emitters_types.h"

layout(set = 0, binding = 0) uniform sampler2D environment;
layout(set = 0, binding = 1) readonly buffer LightBuffer { GpuLight data[]; } lights;
layout(set = 0, binding = 2) readonly buffer EmitterBuffer { EmissiveTriangle data[]; } emitters;
layout(set = 0, binding = 3) readonly buffer GroupBuffer { EmitterGroup data[]; } groups;
layout(set = 0, binding = 4) readonly buffer EnvironmentTableBuffer { float data[]; } environment_table;

#include "shaders/octahedral.glsl"
#include "shaders/random.glsl"
#include "shaders/sampled_direct.glsl"

// A surface as a receiver of light on the side that the ray came from.
Receiver receiver_at(Surface surface) {
  return make_receiver(vec4(surface.position, 0.0), surface.normal, surface.face_normal, 0.0);
}

// Sets of random numbers `set` and the two that follow.
vec3 direct_at(Receiver receiver, uvec2 seed, uint index, uint set) {
  return sampled_direct(receiver, kEmitterShare, stratified_point(seed, index, set),
                        stratified_point(seed, index, set + 1), stratified_point(seed, index, set + 2));
}

#endif
