// Sums of the exact writer, for kernels that take what they hold: one invocation a voxel of the list. Host side:
// take_exact_sums() of paper_exact.h.
#ifndef LIGHTWELL_RAY_TRACED_VOXELS_PAPER_TAKE_SUMS_GLSL
#define LIGHTWELL_RAY_TRACED_VOXELS_PAPER_TAKE_SUMS_GLSL

#include "shaders/linear_dispatch.glsl"
#include "shaders/paged_buffer.glsl"
#include "techniques/ray_traced_voxels/paper_types.h"

LW_PAGED_READ_WRITE(restrict, 0, 4, uvec4, sums)
LW_PAGED_READ_WRITE(restrict, 0, 5, uint, high_sums)
layout(set = 0, binding = 6) readonly buffer TouchedBuffer { uint data[]; } touched;
layout(set = 0, binding = 7) readonly buffer TouchedCountBuffer { uint data[]; } touched_count;

// False beyond the list's end. The record is 0 afterwards.
bool take_sums(out uint voxel, out uvec4 low, out uvec3 high) {
  uint index = linear_invocation();
  voxel = kNoVoxel;
  if (index >= touched_count.data[kTouchedCount]) return false;
  voxel = touched.data[index];
  low = sums_at(voxel);
  sums_store(voxel, uvec4(0));
  for (uint k = 0; k < 3; ++k) {
    high[k] = high_sums_at(kExactHighWords * voxel + k);
    high_sums_store(kExactHighWords * voxel + k, 0);
  }
  return true;
}

#endif
