// After slots changed: links lead to where the faces that they met are now.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_cache/cache_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer AfterBuffer { uint data[]; } after;
layout(set = 0, binding = 2) readonly buffer FaceLightBuffer { FaceLight data[]; } face_light;
layout(set = 0, binding = 3) buffer LinkBuffer { uvec2 data[]; } links;

#include "shaders/linear_dispatch.glsl"

void main() {
  uint face = linear_invocation();
  if (face >= min(counts.data[kFacesStored], params.capacity)) return;
  uint page = face_light.data[face].page;
  uint count = page == 0 ? 0 : min(face_light.data[face].links, params.link_count);
  uint first = (page - 1) * params.link_count;
  for (uint k = 0; k < count; ++k) {
    uint word = links.data[first + k].x;
    uint to = word & kLinkUnknown;
    if (to == kLinkEscaped || to == kLinkUnknown) continue;
    uint slot = after.data[to - 1];
    links.data[first + k].x = (word & ~kLinkUnknown) | (slot == kNoFace ? kLinkUnknown : slot + 1);
  }
}
