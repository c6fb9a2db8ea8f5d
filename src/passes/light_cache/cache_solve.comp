// Light bounces once: indirect light of a face is the mean over its links of what the faces there send on, as of last
// frame: E = sum(albedo (E_source + E_indirect)) / n. A mean of at most the largest albedo times the largest irradiance:
// however long it runs, light cannot grow. Links that stay let light settle without noise and without new rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_cache/cache_types.h"

layout(local_size_x = 64) in;
layout(constant_id = 3) const bool kFromLights = false;
layout(constant_id = 4) const bool kLast = true;  // of this frame
layout(set = 0, binding = 0) readonly buffer ListBuffer { uint data[]; } list;
layout(set = 0, binding = 1) readonly buffer LinkBuffer { FaceLink data[]; } links;
layout(set = 0, binding = 2) readonly buffer ShownBuffer { vec4 data[]; } shown;
layout(set = 0, binding = 3) readonly buffer FallenBuffer { vec4 data[]; } fallen;  // before this bounce
layout(set = 0, binding = 4) buffer FaceLightBuffer { FaceLight data[]; } face_light;
layout(set = 0, binding = 5) writeonly buffer SolvedBuffer { vec4 data[]; } solved;  // after it
layout(set = 0, binding = 6) writeonly buffer IndirectBuffer { vec4 data[]; } indirect;

#include "shaders/linear_dispatch.glsl"
#include "shaders/luminance.glsl"
#include "passes/light_cache/cache_link.glsl"

vec3 source_of(uint face) { return shown.data[face * kShownWords + kShownSource].rgb; }

// xyz: what comes along a link, w: 1; 0 where nothing is known of what it met.
vec4 light_along(uint place) {
  uvec2 link = uvec2(links.data[place].slot, links.data[place].albedo);
  uint from = link_to(link.x);
  vec4 light = fallen.data[from];
  light.rgb *= link_albedo(link);
  if (kFromLights && from >= kFallenFaces) light.rgb += source_of(from - kFallenFaces);
  return light;
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
    vec4 light = light_along(first + k);
    sum += light;
    if (kLast) {
      float bright = luminance(light.rgb);
      squares += bright * bright;
    }
  }
  if (sum.w == 0.0) return;
  vec3 mean = sum.rgb / sum.w;
  solved.data[kFallenFaces + face] = vec4(kFromLights ? mean : mean + source_of(face), 1.0);
  if (!kLast) return;
  float bright = luminance(mean);
  face_light.data[face].indirect = mean;
  face_light.data[face].variance = max(0.0, squares / sum.w - bright * bright) / sum.w;
  indirect.data[face] = vec4(mean, float(count));
}
