// What a surfel's links come to, whatever the light: their number, the irradiance that comes in from outside the grid,
// and how far the surfel can be trusted.
//
// The centre of a patch may lie inside a solid (the floor under a crate that stands on part of the cell): it then sees backs only,
// and pixels should prefer its neighbours. Validity = (part of the links that do not end on a back)^2, but never 0:
// where everything shows its back, as in a room wound the other way round, it cancels.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/light_volume/surfel_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer LinkBuffer { uint data[]; } links;
layout(set = 0, binding = 2) buffer SummaryBuffer { LinkSummary data[]; } summaries;
layout(set = 0, binding = 3) uniform sampler2D environment;

#include "shaders/environment.glsl"
#include "shaders/linear_dispatch.glsl"
#include "techniques/light_volume/surfel.glsl"

const float kLeastValidity = 1e-4;

void main() {
  uint slot = linear_invocation();
  if (slot >= counts.data[kCountSurfels]) return;
  bool is_constant = textureSize(environment, 0).y == 1;
  float traced = 0.0;
  float escaped = 0.0;
  float backs = 0.0;
  vec3 outside = vec3(0.0);
  for (uint k = 0; k < params.link_count; ++k) {
    uint link = links.data[k * params.capacity + slot];
    if (link == kLinkNone) continue;
    traced += 1.0;
    if (link >= kLinkEscaped) {
      escaped += 1.0;
      if (!is_constant) outside += environment_radiance(unpack_direction(link, 32767.0, 15));
    } else if ((link & kLinkBack) != 0) {
      backs += 1.0;
    }
  }
  if (is_constant) outside = escaped * texelFetch(environment, ivec2(0), 0).rgb;
  float scale = traced > 0.0 ? kPi / traced : 0.0;
  float seen = traced > 0.0 ? 1.0 - backs / traced : 0.0;
  summaries.data[slot].environment = outside * scale;
  summaries.data[slot].scale = scale;
  summaries.data[slot].validity = max(seen * seen, kLeastValidity);
}
