// Between two frames: takes what was injected into each face into its mean, takes the vote for the point to gather from,
// lists the faces that gather, and shows what rays will read.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_cache/cache_types.h"

layout(local_size_x = 64) in;
layout(constant_id = 3) const bool kFromLights = false;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) buffer FaceLightBuffer { FaceLight data[]; } face_light;
layout(set = 0, binding = 2) buffer VoteBuffer { uint data[]; } votes;
layout(set = 0, binding = 3) buffer InjectedBuffer { uint data[]; } injected;
layout(set = 0, binding = 4) writeonly buffer ShownBuffer { vec4 data[]; } shown;
layout(set = 0, binding = 5) writeonly buffer IndirectBuffer { vec4 data[]; } indirect;
layout(set = 0, binding = 6) writeonly buffer FallenBuffer { vec4 data[]; } fallen;
layout(set = 0, binding = 7) buffer ListBuffer { uint data[]; } list;
layout(set = 0, binding = 8) readonly buffer KeyBuffer { uint data[]; } keys;
layout(set = 0, binding = 9) buffer PageCountBuffer { uint data[]; } page_counts;
layout(set = 0, binding = 10) writeonly buffer FreePageBuffer { uint data[]; } free_pages;
layout(set = 0, binding = 11) writeonly buffer SolvedBuffer { vec4 data[]; } solved;  // as fallen; faces that gather change it

#include "shaders/linear_dispatch.glsl"
#include "passes/light_cache/cache_inject.glsl"
#include "passes/light_cache/cache_page_group.glsl"

// Level n gathers in every 2^n-th frame.
bool has_turn(uint key) {
  uint level = level_of_index(params.levels, key >> 3);
  return (params.frame + level) % min(1u << level, params.turns) == 0;
}

void set_fallen(uint index, vec4 light) {
  fallen.data[index] = light;
  solved.data[index] = light;
}

void main() {
  uint face = linear_invocation();
  if (face >= min(counts.data[kFacesStored], params.capacity)) return;
  FaceLight light = face_light.data[face];

  // Light's rays count by frames, whether they met this face or not; the camera's by samples.
  uint injections;
  ExactSum sum = take_injected(face, injections);
  uint samples = kFromLights ? 1 : injections;
  float count = float(samples);
  light.direct_samples = max(min(light.direct_samples + count, params.most_direct), count);
  if (samples > 0) {
    vec3 mean = exact_mean(sum, samples, kInjectRange);
    light.direct = mix(light.direct, mean, face_weight(count, light.direct_samples));
  }
  light.gathered = min(light.gathered, params.most_gathered);

  uint seen = votes.data[face * kVoteWords + kVoteSeen];
  uint met = votes.data[face * kVoteWords + kVoteMet];
  votes.data[face * kVoteWords + kVoteSeen] = 0;
  votes.data[face * kVoteWords + kVoteMet] = 0;
  if (seen != 0 || met != 0) {
    // Who sends no more rays keeps the points that its light is of.
    bool is_young = light.links < params.link_count || light.page == 0;
    if (params.rest == kAllSend || is_young) {
      bool is_seen = light.seen_at != 0 && params.frame + 1 - light.seen_at <= kFramesAwake;
      light.vote = seen != 0 ? seen : is_seen ? light.vote : met;
    }
    if (met != 0 && (params.rest <= kAllSample || is_young)) light.met = met;
    light.asked_at = params.frame;
    if (seen != 0) light.seen_at = params.frame + 1;
  }
  uint age = params.frame - light.asked_at;
  if (light.page != 0 && age > kFramesAwake && age > page_counts.data[kPagesAge]) {
    free_pages.data[atomicAdd(page_counts.data[kPagesFree], 1)] = light.page;
    light.page = 0;
  }
  face_light.data[face] = light;
  shown.data[face * kShownWords + kShownSource] = vec4(light.direct + light.near, light.direct_samples);
  shown.data[face * kShownWords + kShownNear] = vec4(light.near, light.gathered);
  indirect.data[face] = vec4(light.indirect, float(light.links));
  // What bounces: irradiance, all of it or, where sources are known by what surfaces send on, the indirect part.
  vec3 irradiance = kFromLights ? light.indirect : light.direct + light.near + light.indirect;
  bool is_known = light.direct_samples + float(light.links) > 0.0;
  set_fallen(kFallenFaces + face, is_known ? vec4(irradiance, 1.0) : vec4(0.0));
  if (face == 0) {
    set_fallen(kFallenEscaped, vec4(0.0, 0.0, 0.0, 1.0));
    set_fallen(kFallenUnknown, vec4(0.0));
  }
  bool awake = light.vote != 0 && age <= kFramesAwake;
  if (awake && has_turn(keys.data[face]) && (params.rest != kYoungSolve || light.links < params.link_count || light.page == 0)) {
    list.data[kListHeader + atomicAdd(list.data[kListCount], 1)] = face;
    if (light.page == 0) atomicAdd(page_counts.data[kPagesWanted + page_group(keys.data[face])], 1);
  }
}
