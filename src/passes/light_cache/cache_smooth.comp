// What pixels and points will read. Every face has its own rays, so the errors of neighbours differ: the mean over those
// that it sees on the same surface, and whose light differs by no more than chance does, uses several sets of rays
// instead of one.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/light_point.h"
#include "passes/light_cache/cache_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer KeyBuffer { uint data[]; } keys;
layout(set = 0, binding = 2) readonly buffer FaceTableBuffer { uint data[]; } face_table;
layout(set = 0, binding = 3) readonly buffer FaceLightBuffer { FaceLight data[]; } face_light;
layout(set = 0, binding = 4) readonly buffer IndirectBuffer { vec4 data[]; } indirect;
layout(set = 0, binding = 5) readonly buffer LitBuffer { LitFace data[]; } lit;  // of last frame
layout(set = 0, binding = 6) writeonly buffer SmoothedBuffer { LitFace data[]; } smoothed;

#include "passes/light_cache/cache_level.glsl"
#include "shaders/linear_dispatch.glsl"
#include "shaders/luminance.glsl"

// By distance (half the weight at 1.8 cells), by angle, and by how far each lies off the plane of the other.
float neighbour_weight(vec3 offset, vec3 normal, vec3 other_normal) {
  float cosine = max(0.0, dot(normal, other_normal));
  float cosine_8 = cosine * cosine * cosine * cosine;
  cosine_8 *= cosine_8;
  float off_plane = abs(dot(offset, normal)) + abs(dot(offset, other_normal));
  float near_plane = max(0.0, 1.0 - 2.0 * off_plane);
  return cosine_8 * near_plane * near_plane * exp2(-0.3 * dot(offset, offset));
}

// By what light differs in terms of its variance: half at two standard deviations.
float likeness(float difference, float variance) {
  return exp2(-0.25 * difference * difference / (variance + 1e-20));
}

// W/m^2: the mean over the neighbours of a face, itself included, that say the same but for chance.
vec3 neighbourhood(uint face, uint level, ivec3 cell, LitFace about) {
  VoxelGrid grid = level_grid(params.levels, level);
  uint direction = keys.data[face] & 7u;
  vec3 own = indirect.data[face].rgb;
  vec3 place = place_of_vote(about.place);
  vec3 normal = unpack_unit_vector(about.normal);
  float variance = face_light.data[face].variance;
  vec4 sum = vec4(0.0);
  for (uint left = about.seen; left != 0; left &= left - 1u) {
    uint i = uint(findLSB(left));
    ivec3 step = ivec3(i % 3, i / 3 % 3, i / 9) - 1;
    if (!grid_contains(grid, cell + step)) continue;
    uint other = face_slot(face_table.data[level_cell_index(params.levels, level, cell + step)], direction);
    vec4 light = other == kNoFace ? vec4(0.0) : indirect.data[other];
    if (light.w == 0.0) continue;
    vec3 offset = vec3(step) + place_of_vote(face_light.data[other].vote) - place;
    float weight = neighbour_weight(offset, normal, unpack_unit_vector(face_light.data[other].normal)) *
                   likeness(luminance(light.rgb - own), variance + face_light.data[other].variance) *
                   min(light.w, kSettledLinks);
    sum += weight * vec4(light.rgb, 1.0);
  }
  return sum.w > 0.0 ? sum.rgb / sum.w : own;
}

// What the next finer level said of a face's point last frame, times how much it knew, where the face that holds it is
// awake.
LitFace finer_face(uint level, vec3 position, uint direction) {
  LitFace nothing = LitFace(vec3(0.0), 0.0, 0, 0, 0, 0);
  if (level == 0 || level_weight(params.levels, level - 1, position) <= 0.0) return nothing;
  VoxelGrid grid = level_grid(params.levels, level - 1);
  ivec3 cell = ivec3(floor(grid_coordinates(grid, position)));
  if (!grid_contains(grid, cell)) return nothing;
  uint finer = face_slot(face_table.data[level_cell_index(params.levels, level - 1, cell)], direction);
  if (finer == kNoFace || params.frame - face_light.data[finer].asked_at > kFramesAwake) return nothing;
  LitFace light = lit.data[finer];
  light.known *= min(indirect.data[finer].w / params.settled, 1.0);
  return light;
}

// Where there are levels.
void agree_with_levels(uint face, uint level, ivec3 cell, inout LitFace result) {
  VoxelGrid grid = level_grid(params.levels, level);
  vec3 position = grid.origin + (vec3(cell) + place_of_vote(result.place)) * grid.cell_size;
  vec4 sum = result.known * vec4(result.irradiance, 1.0);
  if (result.known > 0.0 && result.known < 1.0 && level + 1 < params.levels.count)
    sum += (1.0 - sum.w) * look_up_level(level + 1, kNoFace, position, unpack_unit_vector(result.normal));
  LitFace finer = finer_face(level, position, keys.data[face] & 7u);
  sum = mix(sum, vec4(finer.irradiance, 1.0), finer.known);
  if (result.known == 0.0) result.normal = finer.normal;
  LitFace last = lit.data[face];
  if (sum.w <= 0.0) return;
  result.known = sum.w;
  result.irradiance = sum.rgb / sum.w;
  if (last.known > 0.0) result.irradiance = mix(last.irradiance, result.irradiance, 1.0 / float(params.count));
}

void main() {
  uint face = linear_invocation();
  if (face >= min(counts.data[kFacesStored], params.capacity)) return;
  LitFace result = LitFace(vec3(0.0), 0.0, face_light.data[face].vote, face_light.data[face].normal,
                           face_light.data[face].seen | 1u << 13, 0);
  float links = indirect.data[face].w;
  uint level = level_of_index(params.levels, keys.data[face] >> 3);
  ivec3 cell = level_cell_at(params.levels, keys.data[face] >> 3);
  if (links > 0.0) {
    result.irradiance = neighbourhood(face, level, cell, result);
    result.known = min(links / params.settled, 1.0);
  }
  if (params.levels.count > 1 && result.place != 0) agree_with_levels(face, level, cell, result);
  smoothed.data[face] = result;
}
