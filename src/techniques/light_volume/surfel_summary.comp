// What a surfel's links come to, whatever the light: their number, the irradiance from outside the grid and from the
// emitters that it sees, and the surfel's validity.
//
// The centre of a patch may lie inside a solid (the floor under a crate that stands on part of the cell): it then
// sees backs only, and pixels should prefer its neighbours. Validity = (part of the links that do not end on a
// back)^8, but never 0: where everything shows its back, as in a room wound the other way round, it cancels.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/light_volume/surfel_types.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
LW_PAGED_READ(0, 1, uint, links)
layout(set = 0, binding = 2) readonly buffer SurfelBuffer { Surfel data[]; } surfels;
layout(set = 0, binding = 3) readonly buffer EmitterBuffer { SurfelEmitter data[]; } emitters;
layout(set = 0, binding = 4) buffer SummaryBuffer { LinkSummary data[]; } summaries;
layout(set = 0, binding = 5) uniform sampler2D environment;

#include "shaders/environment.glsl"
#include "shaders/linear_dispatch.glsl"
#include "techniques/light_volume/surfel.glsl"
#include "techniques/light_volume/surfel_emitters.glsl"

const float kLeastValidity = 1e-4;
const float kLift = 0.01;  // as in surfel_emitter_rays.comp

vec3 emitter_irradiance(uint slot) {
  uint sampled = summaries.data[slot].emitters_sampled;
  uint seen = summaries.data[slot].emitters_seen;
  vec3 normal = surfels.data[slot].normal;
  vec3 origin = surfels.data[slot].position + kLift * normal;
  uint key = surfels.data[slot].key;
  vec3 sum = vec3(0.0);
  while (seen != 0) {
    sum += sample_emitter(params.grid, key, origin, normal, uint(findLSB(seen))).irradiance;
    seen &= seen - 1u;
  }
  return sum / max(float(bitCount(sampled)), 1.0);
}

// Sum of the environment's radiance along the links that left the grid.
vec3 outside_radiance(uint slot, float escaped) {
  bool is_constant = textureSize(environment, 0).y == 1;
  if (is_constant) return escaped * texelFetch(environment, ivec2(0), 0).rgb;
  vec3 sum = vec3(0.0);
  for (uint k = 0; k < params.used_links; ++k) {
    uint link = links_at(k * params.capacity + slot);
    if (link >= kLinkEscaped && link != kLinkNone) sum += environment_radiance(unpack_direction(link, 32767.0, 15));
  }
  return sum;
}

// Sum of what the surfels at the ends of links emit, as far as it comes along links.
vec3 near_emission(uint slot) {
  vec3 sum = vec3(0.0);
  for (uint k = 0; k < (counts.data[kCountEmitters] == 0 ? 0 : params.used_links); ++k) {
    uint link = links_at(k * params.capacity + slot);
    if (link < kLinkEscaped && (link & kLinkEmits) != 0) sum += surfels.data[link & kLinkSlot].emission;
  }
  return sum;
}

void main() {
  uint slot = linear_invocation();
  if (slot >= counts.data[kCountSurfels]) return;
  float traced = 0.0;
  float escaped = 0.0;
  float backs = 0.0;
  for (uint k = 0; k < params.used_links; ++k) {
    uint link = links_at(k * params.capacity + slot);
    traced += link == kLinkNone ? 0.0 : 1.0;
    escaped += link >= kLinkEscaped && link != kLinkNone ? 1.0 : 0.0;
    backs += link < kLinkEscaped && (link & kLinkBack) != 0 ? 1.0 : 0.0;
  }
  float scale = traced > 0.0 ? kPi / traced : 0.0;
  float seen = traced > 0.0 ? 1.0 - backs / traced : 0.0;
  vec3 along_links = outside_radiance(slot, escaped) + near_emission(slot);
  summaries.data[slot].from_sources = along_links * scale + emitter_irradiance(slot);
  summaries.data[slot].scale = scale;
  summaries.data[slot].validity = max(pow(seen, 8.0), kLeastValidity);
}
