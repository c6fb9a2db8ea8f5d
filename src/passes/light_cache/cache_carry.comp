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
layout(set = 0, binding = 9) readonly buffer OldLitBuffer { LitFace data[]; } old_lit;
layout(set = 0, binding = 10) writeonly buffer LitBuffer { LitFace data[]; } lit;
layout(set = 0, binding = 8) writeonly buffer OwnedBuffer { uint data[]; } owned;  // 1 a page that a face still has

#include "shaders/linear_dispatch.glsl"

void main() {
  uint face = linear_invocation();
  if (face >= min(counts.data[kFacesStored], params.capacity)) return;
  uint slot = before.data[face];
  FaceLight light = FaceLight(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0, 0, 0, 0, 0, ivec3(0), 0, 0, 0.0, 0, 0);
  bool kept = slot != kNoFace;
  if (kept) light = old_light.data[slot];
  face_light.data[face] = light;
  LitFace nothing = LitFace(vec3(0.0), 0.0, 0, 0, 0, 0);
  lit.data[face] = nothing;
  if (kept) lit.data[face] = old_lit.data[slot];
  for (uint i = 0; i < kVoteWords; ++i)
    votes.data[face * kVoteWords + i] = kept ? old_votes.data[slot * kVoteWords + i] : 0;
  for (uint i = 0; i < kInjectWords; ++i)
    injected.data[face * kInjectWords + i] = kept ? old_injected.data[slot * kInjectWords + i] : 0;
  if (light.page != 0) owned.data[light.page - 1] = 1;
}
