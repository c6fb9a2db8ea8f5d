// Irradiance from the grid at any position (Magalhaes 2020, listing 4.8), as a 3D texture with linear filter would give
// it: empty voxels are black ones. The including kernel declares, before it includes this file,
//   LW_PAGED_READ(0, n, uint, irradiance)
#ifndef LIGHTWELL_RAY_TRACED_VOXELS_PAPER_LOOKUP_GLSL
#define LIGHTWELL_RAY_TRACED_VOXELS_PAPER_LOOKUP_GLSL

#include "techniques/ray_traced_voxels/paper_voxels.glsl"

layout(constant_id = 0) const uint kTaps = 7;   // 1 or 7
layout(constant_id = 1) const uint kExact = 0;  // 1: the grid is the exact writer's

// W/m^2.
vec3 irradiance_of(uint voxel, float range) {
  if (kExact == 0) return unpackUnorm4x8(irradiance_at(voxel)).rgb * range;
  uint first = kExactIrradianceWords * voxel;
  return uintBitsToFloat(uvec3(irradiance_at(first), irradiance_at(first + 1), irradiance_at(first + 2)));
}

// At a place in voxels, as textures count: centres at one half, and no offset, whatever that of the writers.
vec3 interpolated_irradiance(VoxelGrid grid, vec3 place, float range) {
  place -= 0.5;
  vec3 part = place - floor(place);
  ivec3 last = ivec3(grid.resolution) - 1;
  vec3 sum = vec3(0.0);
  for (int corner = 0; corner < 8; ++corner) {
    ivec3 offset = ivec3(corner & 1, (corner >> 1) & 1, corner >> 2);
    vec3 weights = mix(1.0 - part, part, vec3(offset));
    ivec3 cell = clamp(ivec3(floor(place)) + offset, ivec3(0), last);
    sum += weights.x * weights.y * weights.z * irradiance_of(grid_cell_index(grid, cell), range);
  }
  return sum;
}

// The mean of the place and its six neighbours one voxel away, or the place alone.
vec3 look_up(VoxelGrid grid, vec3 position, float range) {
  vec3 place = clamp(grid_coordinates(grid, position), vec3(-2.0), vec3(grid.resolution) + 2.0);
  vec3 sum = interpolated_irradiance(grid, place, range);
  for (int tap = 1; tap < int(kTaps); ++tap) {
    vec3 offset = vec3(0.0);
    int axis = (tap - 1) >> 1;
    offset = mix(offset, vec3(1 - 2 * ((tap - 1) & 1)), equal(ivec3(0, 1, 2), ivec3(axis)));
    sum += interpolated_irradiance(grid, place + offset, range);
  }
  return sum / float(kTaps);
}

#endif
