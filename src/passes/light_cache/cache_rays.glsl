// What rays find at surfaces: bindings and functions that kernels which fill the cache share. They include
// shaders/trace.glsl first.
#ifndef LIGHTWELL_CACHE_RAYS_GLSL
#define LIGHTWELL_CACHE_RAYS_GLSL

#include "passes/light_cache/cache_direct.glsl"

layout(set = 0, binding = 5) readonly buffer FaceTableBuffer { uint data[]; } face_table;
layout(set = 0, binding = 7) buffer VoteBuffer { uint data[]; } votes;
layout(set = 0, binding = 8) buffer InjectedBuffer { uint data[]; } injected;

#include "passes/voxel_faces/voxel_faces.glsl"
#include "passes/light_cache/cache_inject.glsl"
#include "passes/light_cache/cache_vote.glsl"

#endif
