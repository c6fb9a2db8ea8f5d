// Means from the sums of the exact writer, added to what other lights have left.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/paged_buffer.glsl"
#include "techniques/ray_traced_voxels/paper_types.h"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(VoxelAddParams, LW_VOXEL_ADD_PARAMS)

#include "shaders/linear_dispatch.glsl"

LW_PAGED_READ(0, 0, uint, sums)
LW_PAGED_READ_WRITE(restrict, 0, 1, uint, irradiance)

uint exact_add(uint word, uint amount) { return 0; }  // nothing is written here

#include "techniques/ray_traced_voxels/voxel_write_exact.glsl"

void main() {
  uint voxel = linear_invocation();
  if (voxel >= params.cell_count) return;
  uint first = kExactWords * voxel;
  uint count = sums_at(first + kExactCount);
  vec3 mean = vec3(0.0);
  for (uint k = 0; k < (count != 0 ? 1 : 0); ++k) {
    ExactSum sum = ExactSum(uvec3(sums_at(first), sums_at(first + 1), sums_at(first + 2)),
                            uvec3(sums_at(first + kExactHigh), sums_at(first + kExactHigh + 1), sums_at(first + kExactHigh + 2)));
    mean = exact_mean(sum, count, params.range);
  }
  for (uint k = 0; k < 3; ++k) {
    uint word = kExactIrradianceWords * voxel + k;
    float before = params.is_first != 0 ? 0.0 : uintBitsToFloat(irradiance_at(word));
    irradiance_store(word, floatBitsToUint(before + mean[k]));
  }
}
