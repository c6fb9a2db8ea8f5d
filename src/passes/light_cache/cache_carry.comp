// After the voxels changed: each face finds what it kept in another slot, or begins anew.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_cache/cache_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer BeforeBuffer { uint data[]; } before;
layout(set = 0, binding = 2) readonly buffer OldLightBuffer { FaceLight data[]; } old_light;
layout(set = 0, binding = 3) readonly buffer OldVoteBuffer { uint data[]; } old_votes;
layout(set = 0, binding = 4) readonly buffer OldInjectedBuffer { uint data[]; } old_injected;
layout(set = 0, binding = 5) writeonly buffer FaceLightBuffer { FaceLight data[]; } face_light;
layout(set = 0, binding = 6) writeonly buffer VoteBuffer { uint data[]; } votes;
layout(set = 0, binding = 7) writeonly buffer InjectedBuffer { uint data[]; } injected;
layout(set = 0, binding = 8) readonly buffer OldLinkBuffer { uvec2 data[]; } old_links;
layout(set = 0, binding = 9) writeonly buffer LinkBuffer { uvec2 data[]; } links;

#include "shaders/linear_dispatch.glsl"
#include "passes/light_cache/cache_link.glsl"

// Of what has left its level's window nothing is known.
uvec2 still_there(uvec2 link) {
  uint to = link_to(link);
  bool is_face = to != kLinkEscaped && to != kLinkUnknown;
  bool gone = is_face && !is_same_cell(params.levels, params.last_center, (to - 1) >> 3);
  return gone ? make_link(kLinkUnknown, link_albedo(link)) : link;
}

void main() {
  uint face = linear_invocation();
  if (face >= min(counts.data[kFacesStored], params.capacity)) return;
  uint slot = before.data[face];
  FaceLight light = FaceLight(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0, 0, 0, 0, 0);
  uint vote = 0;
  bool kept = slot != kNoFace;
  if (kept) {
    light = old_light.data[slot];
    vote = old_votes.data[slot];
  }
  face_light.data[face] = light;
  votes.data[face] = vote;
  for (uint i = 0; i < kInjectWords; ++i)
    injected.data[face * kInjectWords + i] = kept ? old_injected.data[slot * kInjectWords + i] : 0;
  for (uint k = 0; k < params.link_count && kept; ++k)
    links.data[k * params.capacity + face] = still_there(old_links.data[k * params.capacity + slot]);
}
