// One more bounce: every surfel gathers what leaves the surfels at the other ends of its links. With K links whose
// directions have the density cos / pi, the irradiance is
//   E = E_sources + pi / K * sum L(hit),   L = albedo / pi * (E_direct + E),
// where E_sources comes from outside and from emitters (surfel_summary.comp). Starting from last frame's E, a few
// rounds a frame bring in all bounces (Jacobi iteration of the radiosity equation).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/light_volume/surfel_types.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer SurfelBuffer { Surfel data[]; } surfels;
LW_PAGED_READ(0, 2, uint, links)
layout(set = 0, binding = 3) readonly buffer SummaryBuffer { LinkSummary data[]; } summaries;
layout(set = 0, binding = 4) readonly buffer DirectBuffer { vec4 data[]; } direct;
layout(set = 0, binding = 5) readonly buffer RadianceBuffer { vec4 data[]; } radiance;
layout(set = 0, binding = 6) writeonly buffer NextBuffer { vec4 data[]; } next_radiance;
layout(set = 0, binding = 7) writeonly buffer IrradianceBuffer { vec4 data[]; } irradiance;

#include "shaders/linear_dispatch.glsl"
#include "techniques/light_volume/surfel.glsl"

void main() {
  uint slot = linear_invocation();
  if (slot >= counts.data[kCountSurfels]) return;
  vec3 sum = vec3(0.0);
  for (uint k = 0; k < params.used_links; ++k) {
    uint link = links_at(k * params.capacity + slot);
    if (link < kLinkEscaped) sum += radiance.data[link & kLinkSlot].xyz;
  }
  vec3 e = sum * summaries.data[slot].scale + summaries.data[slot].from_sources;
  vec3 albedo = unpack_albedo(surfels.data[slot].albedo);
  irradiance.data[slot] = vec4(e, 0.0);
  next_radiance.data[slot] = vec4(albedo / kPi * (direct.data[slot].xyz + e), 0.0);
}
