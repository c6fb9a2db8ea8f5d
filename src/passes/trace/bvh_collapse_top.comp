// Makes wide nodes of the binary ones that the last rounds of merging made, all in one workgroup; starts at the root.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"

layout(local_size_x = 256) in;
layout(set = 0, binding = 0) readonly buffer StateBuffer { uint data[]; } state;
layout(set = 0, binding = 1) readonly buffer LowBuffer { uvec4 data[]; } lows;
layout(set = 0, binding = 2) readonly buffer HighBuffer { uvec4 data[]; } highs;
layout(set = 0, binding = 3) readonly buffer SizeBuffer { uint data[]; } sizes;
layout(set = 0, binding = 4) coherent buffer MarkBuffer { uint data[]; } marks;
layout(set = 0, binding = 5) coherent buffer FirstBuffer { uint data[]; } firsts;
layout(set = 0, binding = 6) writeonly buffer ChildBuffer { uvec4 data[]; } children;
layout(set = 0, binding = 7) writeonly buffer TriangleBuffer { uvec4 data[]; } triangles;

#include "passes/trace/bvh_collapse.glsl"

void main() {
  uint local = gl_LocalInvocationID.x;
  if (local == 0) {
    uint root = 2 * params.count - 2;
    firsts.data[root] = 0;
    if (params.count > kBvhLeafTriangles) {
      marks.data[root - params.count] = 1;
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
