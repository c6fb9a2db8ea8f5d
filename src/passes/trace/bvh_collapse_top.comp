// Makes wide nodes of the binary ones that the last rounds of merging made, all in one workgroup; starts at the root.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 256) in;
layout(set = 0, binding = 0) readonly buffer StateBuffer { uint data[]; } state;
LW_PAGED_READ(0, 1, uvec4, lows)
LW_PAGED_READ(0, 2, uvec4, highs)
LW_PAGED_READ(0, 3, uint, sizes)
LW_PAGED_READ_WRITE(coherent, 0, 4, uint, marks)
LW_PAGED_READ_WRITE(coherent, 0, 5, uint, firsts)
LW_PAGED_WRITE(0, 6, uvec4, children)
LW_PAGED_WRITE(0, 7, uvec4, triangles)

#include "passes/trace/bvh_collapse.glsl"

void main() {
  uint local = gl_LocalInvocationID.x;
  if (local == 0) {
    uint root = 2 * params.count - 2;
    firsts_store(root, 0);
    if (params.count > kBvhLeafTriangles) {
      marks_store(root - params.count, 1);
    } else {
      fill_slots(root, 0);
    }
  }
  for (uint round = kBvhTopRounds; round-- > 0;) {
    memoryBarrierBuffer();
    barrier();
    uint range = kBvhRounds + 4 * (params.rounds + round) + 3;
    uint count = state.data[range + 4] - state.data[range];
    for (uint i = local; i < count; i += 256) collapse_round(params.rounds + round, i);
  }
}
