// Indirect irradiance from the cache alone: one trilinear reading of the faces around. The including kernel declares
//   layout(set = 0, binding = n) readonly buffer FaceTableBuffer { uint data[]; } face_table;
//   layout(set = 0, binding = n) readonly buffer IndirectBuffer { vec4 data[]; } indirect;  // w: 0 where nothing is known
//   layout(set = 0, binding = n) buffer VoteBuffer { uint data[]; } votes;
#ifndef LIGHTWELL_CACHE_LOOK_UP_GLSL
#define LIGHTWELL_CACHE_LOOK_UP_GLSL

#include "passes/voxel_faces/voxel_faces.glsl"
#include "techniques/ray_traced_voxels/cache_vote.glsl"

// W/m^2. Only faces that have gathered count, so that what lies inside walls darkens nothing; each by how much it looks
// the way of the unit `normal`.
vec3 look_up(vec3 position, vec3 normal, uint seed) {
  uint own = face_at(params.grid, position, normal);
  if (own != kNoFace) vote(own, position, 0, seed);
  vec3 coordinates = grid_coordinates(params.grid, position) - 0.5;
  ivec3 base = ivec3(floor(coordinates));
  vec3 part = coordinates - vec3(base);
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (int i = 0; i < 8; ++i) {
    ivec3 step = ivec3(i & 1, (i >> 1) & 1, i >> 2);
    ivec3 cell = base + step;
    vec3 near = mix(1.0 - part, part, vec3(step));
    if (!grid_contains(params.grid, cell)) continue;
    uint word = face_table.data[grid_cell_index(params.grid, cell)];
    for (uint axis = 0; axis < 3; ++axis) {
      uint slot = face_slot(word, 2 * axis + (normal[axis] < 0.0 ? 1 : 0));
      if (slot == kNoFace) continue;
      vec4 light = indirect.data[slot];
      float weight = light.w > 0.0 ? (near.x * near.y * near.z + 1e-4) * normal[axis] * normal[axis] : 0.0;
      sum += weight * light.rgb;
      weights += weight;
    }
  }
  return weights > 0.0 ? sum / weights : vec3(0.0);
}

#endif
