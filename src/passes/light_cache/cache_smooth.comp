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
vec3 neighbourhood(uint face, uint level, ivec3 cell, uint seen) {
  VoxelGrid grid = level_grid(params.levels, level);
  uint direction = keys.data[face] & 7u;
  vec3 own = indirect.data[face].rgb;
  vec3 place = place_of_vote(face_light.data[face].vote);
  vec3 normal = unpack_unit_vector(face_light.data[face].normal);
  float variance = face_light.data[face].variance;
  vec4 sum = vec4(0.0);
  for (uint left = seen; left != 0; left &= left - 1u) {
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

// The face of this direction in the cell of the level that holds a position; or kNoFace.
uint face_of_cell(uint level, vec3 position, uint direction) {
  VoxelGrid grid = level_grid(params.levels, level);
  ivec3 cell = ivec3(floor(grid_coordinates(grid, position)));
  if (!grid_contains(grid, cell)) return kNoFace;
  return face_slot(face_table.data[level_cell_index(params.levels, level, cell)], direction);
}

// What the next finer level said of a face's point last frame, times how much it knew, where the face that holds it is
// awake.
LitFace finer_face(uint level, vec3 position, uint direction) {
  LitFace nothing = LitFace(vec3(0.0), 0.0, 0, 0, 0, 0);
  if (level == 0 || level_weight(params.levels, level - 1, position) <= 0.0) return nothing;
  uint finer = face_of_cell(level - 1, position, direction);
  if (finer == kNoFace || params.frame - face_light.data[finer].asked_at > kFramesAwake) return nothing;
  LitFace light = lit.data[finer];
  light.known *= min(indirect.data[finer].w / params.settled, 1.0);
  return light;
}

// While windows move on: nothing changes by more than kMostChange of what is brighter, before or in the end.
vec3 step_towards(vec3 last, vec3 target) {
  const float kMostChange = 0.025;
  vec3 way = target - last;
  float most = kMostChange * max(luminance(last), luminance(target));
  return last + way * min(1.0 / float(params.count), most / max(abs(luminance(way)), 1e-20));
}

// Where there are levels.
void agree_with_levels(uint face, uint level, ivec3 cell, LitFace last, inout LitFace result) {
  VoxelGrid grid = level_grid(params.levels, level);
  vec3 position = grid.origin + (vec3(cell) + unpack_place(result.place)) * grid.cell_size;
  vec4 sum = result.known * vec4(result.irradiance, 1.0);
  uint direction = keys.data[face] & 7u;
  if (result.known > 0.0 && result.known < 1.0 && level + 1 < params.levels.count)
    sum += (1.0 - sum.w) * look_up_level(level + 1, face_of_cell(level + 1, position, direction), position,
                                         unpack_unit_vector(result.normal));
  LitFace finer = finer_face(level, position, direction);
  sum = mix(sum, vec4(finer.irradiance, 1.0), finer.known);
  if (result.known == 0.0) result.normal = finer.normal;
  if (sum.w <= 0.0) return;
  // A face that windows have just brought comes in by and by.
  result.known = params.count > 1 ? min(sum.w, last.known + 1.0 / float(params.count)) : sum.w;
  result.irradiance = sum.rgb / sum.w;
  if (last.known > 0.0 && params.count > 1) result.irradiance = step_towards(last.irradiance, result.irradiance);
}

// While windows move on, what a face newly sees comes in by and by.
void follow_seen(LitFace last, inout LitFace result) {
  uint steps = last.seen_before >> kNeighbours;
  if (params.count == 1 || last.known == 0.0) {
    result.seen_before = result.seen | kStepsToSee << kNeighbours;
  } else if (steps < kStepsToSee) {
    result.seen = last.seen;
    result.seen_before = last.seen_before + (1u << kNeighbours);
  } else {
    result.seen_before = last.seen | (result.seen == last.seen ? steps : 1) << kNeighbours;
  }
}

// A face's light is the mean over links from as many points as it sent rays from, and so are its place and normal.
void follow_point(FaceLight light, LitFace last, inout LitFace result) {
  vec3 place = place_of_vote(light.vote);
  vec3 normal = unpack_unit_vector(light.normal);
  if (last.known > 0.0) {
    bool sends = params.rest == kAllSend || light.links < params.link_count;
    uint links = max(min(light.links, params.link_count), params.rays);
    float part = sends ? float(params.rays) / float(links) : 0.0;
    place = mix(unpack_place(last.place), place, part);
    normal = normalize(mix(unpack_unit_vector(last.normal), normal, part));
  }
  result.place = pack_place(place);
  result.normal = pack_unit_vector(normal);
}

void main() {
  uint face = linear_invocation();
  if (face >= min(counts.data[kFacesStored], params.capacity)) return;
  FaceLight light = face_light.data[face];
  LitFace last = lit.data[face];
  LitFace result = LitFace(vec3(0.0), 0.0, 0, 0, light.seen | 1u << kNeighbours / 2, 0);
  follow_point(light, last, result);
  follow_seen(last, result);
  float links = indirect.data[face].w;
  uint level = level_of_index(params.levels, keys.data[face] >> 3);
  ivec3 cell = level_cell_at(params.levels, keys.data[face] >> 3);
  if (links > 0.0) {
    result.irradiance = neighbourhood(face, level, cell, result.seen);
    result.known = min(links / params.settled, 1.0);
  }
  if (params.levels.count > 1 && light.vote != 0) agree_with_levels(face, level, cell, last, result);
  smoothed.data[face] = result;
}
