// Indirect irradiance from the cache alone: one trilinear reading of the faces around. The including kernel declares
//   layout(set = 0, binding = n) readonly buffer FaceTableBuffer { uint data[]; } face_table;
//   layout(set = 0, binding = n) readonly buffer IndirectBuffer { vec4 data[]; } indirect;  // w: 0 where nothing is known
//   layout(set = 0, binding = n) buffer VoteBuffer { uint data[]; } votes;
#ifndef LIGHTWELL_CACHE_LOOK_UP_GLSL
#define LIGHTWELL_CACHE_LOOK_UP_GLSL

#include "passes/voxel_faces/voxel_faces.glsl"
#include "techniques/ray_traced_voxels/cache_vote.glsl"

// One level's: W/m^2 times the weight of what is known of it, and that weight, [0,1]. Only faces that have gathered count,
// so that what lies inside walls darkens nothing; each by how much it looks the way of the unit `normal`.
vec4 look_up_level(uint level, vec3 position, vec3 normal) {
  VoxelGrid grid = level_grid(params.levels, level);
  vec3 coordinates = grid_coordinates(grid, position) - 0.5;
  ivec3 base = ivec3(floor(coordinates));
  vec3 part = coordinates - vec3(base);
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int i = 0; i < 8; ++i) {
    ivec3 step = ivec3(i & 1, (i >> 1) & 1, i >> 2);
    ivec3 cell = base + step;
    vec3 near = mix(1.0 - part, part, vec3(step));
    if (!grid_contains(grid, cell)) continue;
    uint word = face_table.data[level_cell_index(params.levels, level, cell)];
    for (uint axis = 0; axis < 3; ++axis) {
      uint slot = face_slot(word, 2 * axis + (normal[axis] < 0.0 ? 1 : 0));
      if (slot == kNoFace) continue;
      vec4 light = indirect.data[slot];
      float weight = light.w > 0.0 ? (near.x * near.y * near.z + 1e-4) * normal[axis] * normal[axis] : 0.0;
      weights += weight;
      sum += weight * min(light.w / kSettledLinks, 1.0) * vec4(light.rgb, 1.0);
    }
  }
  return weights > 0.0 ? sum / weights : vec4(0.0);
}

// Asks for the face of a level there, and says whether it has settled.
bool ask(uint level, vec3 position, vec3 normal, uint seed) {
  uint own = face_in_level(params.levels, level, position, normal);
  if (own == kNoFace) return false;
  vote(own, level, position, 0, seed);
  return indirect.data[own].w >= kSettledLinks;
}

// W/m^2. Where a level fades, or does not know enough yet, the next coarser one comes in.
vec3 look_up(vec3 position, vec3 normal, uint seed) {
  vec4 sum = vec4(0.0);
  float left = 1.0;
  for (uint level = level_at(params.levels, position, 0.0); level < params.levels.count && left > 0.0; ++level) {
    float inside = level_weight(params.levels, level, position);
    bool settled = ask(level, position, normal, seed);
    vec4 light = look_up_level(level, position, normal);
    sum += left * inside * light;
    left = settled ? left * (1.0 - inside) : left * (1.0 - inside * light.w);
  }
  return sum.w > 0.0 ? sum.rgb / sum.w : vec3(0.0);
}

#endif
