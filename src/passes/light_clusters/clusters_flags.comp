// 1 where a cluster begins in the order of the points.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_clusters/light_clusters_params.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer KeyBuffer { uvec2 data[]; } keys;
layout(set = 0, binding = 1) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 2) writeonly buffer FlagBuffer { uint data[]; } flags;

#include "passes/light_clusters/clusters_key.glsl"
#include "shaders/linear_dispatch.glsl"

void main() {
  uint index = linear_invocation();
  if (index >= params.point_count) return;
  uint shift = 3 * cluster_shift_index();
  uint key = keys.data[index].x;
  uint before = index > 0 ? keys.data[index - 1].x : kNoClusterKey;
  flags.data[index] = key != kNoClusterKey && key >> shift != before >> shift ? 1 : 0;
}
