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
layout(set = 0, binding = 5) writeonly buffer LitBuffer { LitFace data[]; } lit;

#include "shaders/light_point.glsl"
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

void main() {
  uint face = linear_invocation();
  if (face >= min(counts.data[kFacesStored], params.capacity)) return;
  LitFace result = LitFace(vec3(0.0), 0.0, face_light.data[face].vote, face_light.data[face].normal,
                           face_light.data[face].seen | 1u << 13, 0);
  vec4 own = indirect.data[face];
  if (own.w > 0.0) {
    uint key = keys.data[face];
    uint level = level_of_index(params.levels, key >> 3);
    VoxelGrid grid = level_grid(params.levels, level);
    ivec3 cell = level_cell_at(params.levels, key >> 3);
    vec3 place = place_of_vote(result.place);
    vec3 normal = unpack_unit_vector(result.normal);
    float variance = face_light.data[face].variance;
    vec4 sum = vec4(0.0);
    for (uint left = result.seen; left != 0; left &= left - 1u) {
      uint i = uint(findLSB(left));
      ivec3 step = ivec3(i % 3, i / 3 % 3, i / 9) - 1;
      if (!grid_contains(grid, cell + step)) continue;
      uint other = face_slot(face_table.data[level_cell_index(params.levels, level, cell + step)], key & 7u);
      vec4 light = other == kNoFace ? vec4(0.0) : indirect.data[other];
      if (light.w == 0.0) continue;
      vec3 offset = vec3(step) + place_of_vote(face_light.data[other].vote) - place;
      float weight = neighbour_weight(offset, normal, unpack_unit_vector(face_light.data[other].normal)) *
                     likeness(luminance(light.rgb - own.rgb), variance + face_light.data[other].variance) *
                     min(light.w, kSettledLinks);
      sum += weight * vec4(light.rgb, 1.0);
    }
    result.irradiance = sum.w > 0.0 ? sum.rgb / sum.w : own.rgb;
    result.links = own.w;
  }
  lit.data[face] = result;
}
