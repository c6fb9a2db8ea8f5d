// Writes what rays have hit into the sums of the exact writer. An invocation goes through a run of neighbouring hits
// and adds those of one voxel in registers first: many rays in one voxel then cost few atomic additions.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "techniques/ray_traced_voxels/paper_types.h"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(VoxelWriteParams, LW_VOXEL_WRITE_PARAMS)

#include "shaders/linear_dispatch.glsl"

layout(set = 0, binding = 0) readonly buffer HitBuffer { VoxelHit data[]; } hits;

#include "techniques/ray_traced_voxels/paper_sums.glsl"
#include "shaders/exact_sum.glsl"

// The hits of a run are added where they stand, in their own order: the same bytes every time, whoever comes first.
void main() {
  uint first = kExactRun * linear_invocation();
  if (first >= params.hit_count) return;
  VoxelHit run[kExactRun];
  uint left = 0;  // a bit a hit
  for (uint i = 0; i < kExactRun; ++i) {
    run[i] = hits.data[first + i];
    run[i].irradiance = exact_units(run[i].irradiance, params.range);
    left |= (run[i].voxel != kNoVoxel ? 1u : 0u) << i;
  }
  if (left == 0) return;

  // A voxel a round: that of the first hit which is left.
  uint fresh = 0;  // a bit for the first hit in each voxel that nobody has written before
  uint rounds = 0;
  bool going;
  do {
    uint leader = uint(findLSB(left));
    uint voxel = kNoVoxel;
    for (uint i = 0; i < kExactRun; ++i) voxel = i == leader ? run[i].voxel : voxel;
    vec3 sum = vec3(0.0);
    uint count = 0;
    for (uint i = 0; i < kExactRun; ++i) {
      bool here = run[i].voxel == voxel;
      sum += here ? run[i].irradiance : vec3(0.0);
      count += here ? 1 : 0;
      left &= here ? ~(1u << i) : 0xffffffffu;
    }
    fresh |= (write_exact(voxel, exact_sum(sum), count) ? 1u : 0u) << leader;
    ++rounds;
    going = left != 0 && rounds < kExactRun;
  } while (going);

  // All invocations append to one list: once each.
  uint place = 0;
  for (uint i = 0; i < LW_ROUNDS_IF(fresh != 0, 1); ++i) place = append_touched(uint(bitCount(fresh)));
  for (uint i = 0; i < kExactRun && fresh != 0; ++i) {
    uint hit = uint(findLSB(fresh));
    touched.data[place + i] = hits.data[first + hit].voxel;
    fresh &= fresh - 1;
  }
}
