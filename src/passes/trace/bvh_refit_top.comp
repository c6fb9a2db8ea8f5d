// Fits the boxes of the highest levels of wide nodes, all in one workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 256) in;
layout(set = 0, binding = 0) readonly buffer LevelBuffer { uint data[]; } levels;
LW_PAGED_READ(0, 1, uvec4, triangles)
LW_PAGED_READ_WRITE(coherent, 0, 2, uvec4, nodes)
LW_PAGED_READ_WRITE(coherent, 0, 3, vec4, node_boxes)

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
