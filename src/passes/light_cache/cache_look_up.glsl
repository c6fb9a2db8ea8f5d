// Indirect irradiance from the cache alone. The including kernel declares what cache_level.glsl reads and
//   layout(set = 0, binding = n) buffer VoteBuffer { uint data[]; } votes;
#ifndef LIGHTWELL_CACHE_LOOK_UP_GLSL
#define LIGHTWELL_CACHE_LOOK_UP_GLSL

#include "passes/light_cache/cache_level.glsl"
#include "passes/light_cache/cache_vote.glsl"

// W/m^2 at a point of a surface with this normal, and that of its triangle. Where a level fades, or does not know enough
// yet, the next coarser one comes in. All faces that are read are asked for.
vec3 look_up(vec3 position, vec3 normal, vec3 face_normal, uint seed) {
  vec4 sum = vec4(0.0);
  float left = 1.0;
  for (uint level = level_at(params.levels, position, 0.0); level < params.levels.count && left > 0.0; ++level) {
    float inside = level_weight(params.levels, level, position);
    uint own = face_in_level(params.levels, level, position, face_normal);
    vec4 light = look_up_level(level, own, position, normal);
    if (own != kNoFace) {
      vote(own, kVoteSeen, level, position, 0, seed);
      // A level knows no more of a point than its own face does: neighbours may have come into the window before it.
      float known = lit.data[own].known;
      if (level + 1 < params.levels.count && light.w > 0.0) light *= known / light.w;
    }
    sum += left * inside * light;
    left *= 1.0 - inside * light.w;
  }
  return sum.w > 0.0 ? sum.rgb / sum.w : vec3(0.0);
}

#endif
