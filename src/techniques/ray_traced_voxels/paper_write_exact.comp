// Writes what rays have hit into the sums of the exact writer. An invocation goes through a run of neighbouring hits and
// adds those of one voxel in registers first: many rays in one voxel then cost few atomic additions.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/paged_buffer.glsl"
#include "techniques/ray_traced_voxels/paper_types.h"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(VoxelWriteParams, LW_VOXEL_WRITE_PARAMS)

#include "shaders/linear_dispatch.glsl"

layout(set = 0, binding = 0) readonly buffer HitBuffer { VoxelHit data[]; } hits;
LW_PAGED_SUMS(0, 1, sums)

uint exact_add(uint word, uint amount) { return sums_add(word, amount); }

#include "techniques/ray_traced_voxels/voxel_write_exact.glsl"

void main() {
  uint first = kExactRun * linear_invocation();
  if (first >= params.hit_count) return;
  uint voxel = kNoVoxel;
  uint count = 0;
  ExactSum sum = ExactSum(uvec3(0), uvec3(0));
  for (uint i = 0; i < kExactRun; ++i) {
    VoxelHit hit = hits.data[first + i];
    if (hit.voxel != voxel) {
      if (count != 0) write_exact(kExactWords * voxel, sum, count);
      voxel = hit.voxel;
      count = 0;
      sum = ExactSum(uvec3(0), uvec3(0));
    }
    if (hit.voxel != kNoVoxel) ++count;
    sum = exact_plus(sum, exact_sum(hit.irradiance, params.range));
  }
  if (count != 0) write_exact(kExactWords * voxel, sum, count);
}
