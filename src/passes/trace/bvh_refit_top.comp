// Fits the boxes of the highest levels of wide nodes, all in one workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"

layout(local_size_x = 256) in;
layout(set = 0, binding = 0) readonly buffer LevelBuffer { uint data[]; } levels;
layout(set = 0, binding = 1) readonly buffer TriangleBuffer { uvec4 data[]; } triangles;
layout(set = 0, binding = 2) coherent buffer NodeBuffer { uvec4 data[]; } nodes;
layout(set = 0, binding = 3) coherent buffer NodeBoxBuffer { vec4 data[]; } node_boxes;

#include "passes/trace/bvh_refit.glsl"

void main() {
  for (uint round = 0; round < kBvhTopRounds; ++round) {
    uint level = params.rounds + round;
    uint count = levels.data[4 * level + 3] - levels.data[4 * level + 7];
    for (uint i = gl_LocalInvocationID.x; i < count; i += 256) fit_level(level, i);
    memoryBarrierBuffer();
    barrier();
  }
}
