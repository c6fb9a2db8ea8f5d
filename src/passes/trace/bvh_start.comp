// Before a build: empty bounds, one cluster a triangle.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) buffer StateBuffer { uint data[]; } state;

#include "shaders/linear_dispatch.glsl"

void set_groups(uint first, uvec3 groups) {
  for (uint i = 0; i < 3; ++i) state.data[first + i] = groups[i];
}

void main() {
  if (gl_LocalInvocationID.x != 0) return;
  for (uint i = 0; i < 3; ++i) {
    state.data[kBvhBounds + i] = 0xffffffffu;
    state.data[kBvhBounds + 3 + i] = 0;
  }
  state.data[kBvhClusters] = params.count;
  state.data[kBvhHalf] = 0;
  state.data[kBvhInnerNodes] = 0;
  state.data[kBvhRounds + 3] = 0;
  bool large = params.count > kBvhTopClusters;
  set_groups(kBvhSearchGroups, large ? linear_groups((params.count + 63) / 64) : uvec3(0));
  set_groups(kBvhCountGroups, large ? linear_groups((params.count + 64 * kBvhPairBlock - 1) / (64 * kBvhPairBlock)) : uvec3(0));
}
