// The number of splats, and the dispatches over them. Kernels have params.capacity and params.map_side, and declare
//   layout(set = 0, binding = n) buffer SplatCountBuffer { uint data[]; } splat_counts;
#ifndef LIGHTWELL_PHOTON_SPLATTING_SPLAT_COUNTS_GLSL
#define LIGHTWELL_PHOTON_SPLATTING_SPLAT_COUNTS_GLSL

#include "shaders/linear_dispatch.glsl"

void set_splat_count(uint count) {
  const uint kGroup = 64;
  count = min(count, params.capacity);
  uvec3 splat_groups = linear_groups((count + kGroup - 1) / kGroup);
  uvec3 texel_groups = linear_groups((count * params.map_side * params.map_side + kGroup - 1) / kGroup);
  splat_counts.data[kSplatsInUse] = count;
  for (uint i = 0; i < 3; ++i) {
    splat_counts.data[kSplatGroups + i] = splat_groups[i];
    splat_counts.data[kTexelGroups + i] = texel_groups[i];
  }
}

#endif
