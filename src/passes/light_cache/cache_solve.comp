// Light bounces once: indirect light of a face is the mean over its links of what the faces there send on, as of last
// frame: E = sum(albedo (E_source + E_indirect)) / n. A mean of at most the largest albedo times the largest irradiance:
// however long it runs, light cannot grow. Links that stay let light settle without noise and without new rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_cache/cache_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer ListBuffer { uint data[]; } list;
layout(set = 0, binding = 1) readonly buffer LinkBuffer { uvec2 data[]; } links;
layout(set = 0, binding = 2) readonly buffer FaceTableBuffer { uint data[]; } face_table;
layout(set = 0, binding = 3) readonly buffer ShownBuffer { vec4 data[]; } shown;
layout(set = 0, binding = 4) readonly buffer IndirectBuffer { vec4 data[]; } indirect;  // of last frame
layout(set = 0, binding = 5) buffer FaceLightBuffer { FaceLight data[]; } face_light;
layout(set = 0, binding = 6) writeonly buffer SolvedBuffer { vec4 data[]; } solved;

#include "shaders/linear_dispatch.glsl"
#include "shaders/luminance.glsl"
#include "passes/light_cache/cache_link.glsl"
#include "passes/light_cache/cache_read.glsl"

// xyz: what comes along a link, w: 1; 0 where nothing is known of what it met.
vec4 light_along(uvec2 link) {
  uint to = link_to(link);
  if (to == kLinkEscaped) return vec4(0.0, 0.0, 0.0, 1.0);
  uint key = to - 1;
  uint slot = to == kLinkUnknown ? kNoFace : face_slot(face_table.data[key >> 3], key & 7u);
  if (slot == kNoFace || source_of(slot).w + indirect.data[slot].w == 0.0) return vec4(0.0);
  return vec4(cached_radiosity(slot, link_albedo(link)), 1.0);
}

void main() {
  uint index = linear_invocation();
  if (index >= list.data[kListCount]) return;
  uint face = list.data[kListHeader + index];
  vec4 sum = vec4(0.0);
  uint page = face_light.data[face].page;
  uint count = page == 0 ? 0 : min(face_light.data[face].links, params.link_count);
  uint first = (page - 1) * params.link_count;
  float squares = 0.0;
  for (uint k = 0; k < count; ++k) {
    vec4 light = light_along(links.data[first + k]);
    float bright = luminance(light.rgb);
    sum += light;
    squares += bright * bright;
  }
  if (sum.w == 0.0) return;
  vec3 mean = sum.rgb / sum.w;
  float bright = luminance(mean);
  face_light.data[face].indirect = mean;
  face_light.data[face].variance = max(0.0, squares / sum.w - bright * bright) / sum.w;
  solved.data[face] = vec4(mean, float(count));
}
