// Means from the sums of the exact writer, added to what other lights have left.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "techniques/ray_traced_voxels/paper_types.h"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(VoxelAddParams, LW_VOXEL_ADD_PARAMS)

#include "techniques/ray_traced_voxels/paper_take_sums.glsl"

LW_PAGED_READ_WRITE(restrict, 0, 0, uint, irradiance)

uvec4 exact_add(uint record, uvec4 amounts) { return uvec4(0); }  // nothing is written here
void exact_add_high(uint record, uvec3 amounts) {}

#include "shaders/exact_sum.glsl"

void main() {
  uint voxel;
  uvec4 low;
  uvec3 high;
  if (!take_sums(voxel, low, high)) return;
  vec3 mean = exact_mean(ExactSum(low.rgb, high), low.a, params.range);
  for (uint k = 0; k < kExactIrradianceWords; ++k) {
    uint word = kExactIrradianceWords * voxel + k;
    irradiance_store(word, floatBitsToUint(uintBitsToFloat(irradiance_at(word)) + mean[k]));
  }
}
