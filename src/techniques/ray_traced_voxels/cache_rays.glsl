// What rays find at surfaces: bindings and functions that kernels which fill the cache share. They include
// shaders/trace.glsl first.
#ifndef LIGHTWELL_CACHE_RAYS_GLSL
#define LIGHTWELL_CACHE_RAYS_GLSL

#include "techniques/ray_traced_voxels/cache_direct.glsl"

layout(constant_id = 3) const bool kFromLights = false;
layout(set = 0, binding = 5) readonly buffer FaceTableBuffer { uint data[]; } face_table;
layout(set = 0, binding = 6) readonly buffer ShownBuffer { vec4 data[]; } shown;
layout(set = 0, binding = 7) buffer VoteBuffer { uint data[]; } votes;
layout(set = 0, binding = 8) buffer InjectedBuffer { uint data[]; } injected;

#include "passes/voxel_faces/voxel_faces.glsl"
#include "techniques/ray_traced_voxels/cache_inject.glsl"
#include "techniques/ray_traced_voxels/cache_vote.glsl"

// Radiosity (W/m^2) of a surface of this albedo: what the cache says of the face there.
vec3 cached_radiosity(uint face, vec3 albedo) {
  vec3 direct = shown.data[face * kShownWords + kShownDirect].rgb;
  vec3 indirect = shown.data[face * kShownWords + kShownIndirect].rgb + shown.data[face * kShownWords + kShownNear].rgb;
  return kFromLights ? direct + albedo * indirect : albedo * (direct + indirect);
}

#endif
