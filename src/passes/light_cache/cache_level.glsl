// What one level says of the indirect light at a point: one trilinear reading of the faces around. The including kernel
// declares
//   layout(set = 0, binding = n) readonly buffer FaceTableBuffer { uint data[]; } face_table;
//   layout(set = 0, binding = n) readonly buffer KeyBuffer { uint data[]; } keys;
//   layout(set = 0, binding = n) readonly buffer LitBuffer { LitFace data[]; } lit;
// and includes shaders/light_point.h.
#ifndef LIGHTWELL_CACHE_LEVEL_GLSL
#define LIGHTWELL_CACHE_LEVEL_GLSL

#include "passes/voxel_faces/voxel_faces.glsl"
#include "shaders/light_point.glsl"

// The three directions that a normal leans to, one bit each; without those that it hardly does.
uint leaning_directions(vec3 normal) {
  uint bits = 0;
  for (uint axis = 0; axis < 3; ++axis)
    if (abs(normal[axis]) > 0.05) bits |= 1u << (2 * axis + (normal[axis] < 0.0 ? 1 : 0));
  return bits;
}

// How much a face says of a point `offset` cells from its own: by the angle of their normals, and by how far the point
// lies off its plane.
float reading_weight(LitFace face, vec3 offset, vec3 normal) {
  vec3 face_normal = unpack_unit_vector(face.normal);
  float cosine = max(0.0, dot(normal, face_normal) - 0.1);
  float off_plane = abs(dot(offset, face_normal));
  float cosine_4 = cosine * cosine * cosine * cosine;
  float near_plane = max(0.0, 1.0 - 2.0 * off_plane);
  return cosine_4 * cosine_4 * near_plane * near_plane;
}

// How much of the face of its direction in a cell `step` away a face sees, [0,1].
float sees(LitFace face, ivec3 step) {
  ivec3 place = clamp(step + 1, ivec3(0), ivec3(2));
  uint bit = place.x + 3 * place.y + 9 * place.z;
  float now = float((face.seen >> bit) & 1u);
  float before = float((face.seen_before >> bit) & 1u);
  return mix(before, now, float(face.seen_before >> kNeighbours) / float(kStepsToSee));
}

// One level's: W/m^2 times the weight of what is known of it, and that weight, [0,1]. Only faces that have gathered count,
// so that what lies inside walls darkens nothing, and of them those that `own`, the face there, sees.
vec4 look_up_level(uint level, uint own, vec3 position, vec3 normal) {
  VoxelGrid grid = level_grid(params.levels, level);
  vec3 point = grid_coordinates(grid, position);
  ivec3 base = ivec3(floor(point - 0.5));
  vec3 part = point - 0.5 - vec3(base);
  uint directions = leaning_directions(normal);
  LitFace home = LitFace(vec3(0.0), 0.0, 0, 0, kAllNeighbours, kAllNeighbours);
  ivec3 home_cell = ivec3(0);
  if (own != kNoFace && lit.data[own].known > 0.0) {
    home = lit.data[own];
    home_cell = level_cell_at(params.levels, keys.data[own] >> 3);
  }
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int i = 0; i < 8; ++i) {
    ivec3 step = ivec3(i & 1, (i >> 1) & 1, i >> 2);
    ivec3 cell = base + step;
    float seen = sees(home, cell - home_cell);
    if (seen == 0.0 || !grid_contains(grid, cell)) continue;
    uint word = face_table.data[level_cell_index(params.levels, level, cell)];
    vec3 near = mix(1.0 - part, part, vec3(step));
    for (uint left = word & directions; left != 0; left &= left - 1u) {
      LitFace face = lit.data[face_slot(word, uint(findLSB(left)))];
      if (face.known <= 0.0) continue;
      vec3 away = point - vec3(cell) - unpack_place(face.place);
      float weight = seen * (near.x * near.y * near.z + 1e-4) * reading_weight(face, away, normal);
      weights += weight;
      sum += weight * face.known * vec4(face.irradiance, 1.0);
    }
  }
  return weights > 1e-6 ? sum / weights : vec4(0.0);
}

#endif
