// What rays find at surfaces: bindings and functions that kernels which fill the cache share. They include
// shaders/trace.glsl first.
#ifndef LIGHTWELL_CACHE_RAYS_GLSL
#define LIGHTWELL_CACHE_RAYS_GLSL

#include "passes/emitters/emitters_types.h"

layout(constant_id = 3) const bool kFromLights = false;
layout(set = 0, binding = 0) uniform sampler2D environment;
layout(set = 0, binding = 1) readonly buffer LightBuffer { GpuLight data[]; } lights;
layout(set = 0, binding = 2) readonly buffer EmitterBuffer { EmissiveTriangle data[]; } emitters;
layout(set = 0, binding = 3) readonly buffer GroupBuffer { EmitterGroup data[]; } groups;
layout(set = 0, binding = 4) readonly buffer EnvironmentTableBuffer { float data[]; } environment_table;
layout(set = 0, binding = 5) readonly buffer FaceTableBuffer { uint data[]; } face_table;
layout(set = 0, binding = 6) readonly buffer ShownBuffer { vec4 data[]; } shown;
layout(set = 0, binding = 7) buffer VoteBuffer { uint data[]; } votes;
layout(set = 0, binding = 8) buffer InjectedBuffer { uint data[]; } injected;

#include "shaders/octahedral.glsl"
#include "shaders/sampled_direct.glsl"
#include "passes/voxel_faces/voxel_faces.glsl"
#include "techniques/ray_traced_voxels/cache_inject.glsl"
#include "techniques/ray_traced_voxels/cache_vote.glsl"

// Sets of random numbers of one ray: its direction, and three for direct light.
const uint kSetsOfRay = 4;

// A surface as a receiver of light on the side that the ray came from.
Receiver receiver_at(Surface surface) {
  return make_receiver(vec4(surface.position, 0.0), surface.normal, surface.face_normal, 0.0);
}

vec3 direct_at(Receiver receiver, uvec2 seed, uint index, uint set) {
  return sampled_direct(receiver, kEmitterShare, stratified_point(seed, index, set), stratified_point(seed, index, set + 1),
                        stratified_point(seed, index, set + 2));
}

// Radiosity (W/m^2) of a surface of this albedo: what the cache says of the face there.
vec3 cached_radiosity(uint face, vec3 albedo) {
  vec3 direct = shown.data[face * kShownWords + kShownDirect].rgb;
  vec3 indirect = shown.data[face * kShownWords + kShownIndirect].rgb + shown.data[face * kShownWords + kShownNear].rgb;
  return kFromLights ? direct + albedo * indirect : albedo * (direct + indirect);
}

#endif
