// Where each bundle begins among the sorted light points, and how many there are.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sort/sort_types.h"
#include "techniques/photon_splatting/photon_types.h"
#include "techniques/photon_splatting/stratify_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer FlagBuffer { uint data[]; } flags;
layout(set = 0, binding = 1) readonly buffer SumBuffer { uint data[]; } sums;
layout(set = 0, binding = 2) readonly buffer BlockBuffer { uvec2 data[]; } blocks;
layout(set = 0, binding = 3) writeonly buffer BeginBuffer { uint data[]; } begins;
layout(set = 0, binding = 4) buffer SplatCountBuffer { uint data[]; } splat_counts;

#include "techniques/photon_splatting/splat_counts.glsl"

void main() {
  uint i = linear_invocation();
  if (i >= params.point_count) return;
  uint bundle = sums.data[i] + blocks.data[i / kScanBlock].x;
  bool begin = flags.data[i] != 0;
  if (begin && bundle < params.capacity) begins.data[bundle] = i;
  if (i == params.point_count - 1) set_splat_count(bundle + (begin ? 1 : 0));
}
