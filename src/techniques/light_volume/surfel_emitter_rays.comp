// Sends shadow rays from every surfel to points on emitters: `traced_links` of them, from `first_link` on.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/light_volume/surfel_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer TableBuffer { uint data[]; } table;
layout(set = 0, binding = 2) readonly buffer BrickBuffer { uvec2 data[]; } bricks;
layout(set = 0, binding = 3) readonly buffer SurfelBuffer { Surfel data[]; } surfels;
layout(set = 0, binding = 4) readonly buffer EmitterBuffer { SurfelEmitter data[]; } emitters;
layout(set = 0, binding = 5) buffer SummaryBuffer { LinkSummary data[]; } summaries;

#include "shaders/linear_dispatch.glsl"
#include "techniques/light_volume/surfel.glsl"
#include "techniques/light_volume/surfel_emitters.glsl"
#include "techniques/light_volume/surfel_march.glsl"

const float kLift = 0.01;       // origin above the surface
const float kShortening = 0.1;  // the ray ends before the emitter

void main() {
  uint slot = linear_invocation();
  if (slot >= counts.data[kCountSurfels] || counts.data[kCountEmitters] == 0) return;
  vec3 normal = surfels.data[slot].normal;
  if (normal == vec3(0.0)) return;
  uint key = surfels.data[slot].key;
  vec3 origin = surfels.data[slot].position + kLift * normal;
  uint sampled = summaries.data[slot].emitters_sampled;
  uint seen = summaries.data[slot].emitters_seen;
  for (uint i = 0; i < min(params.traced_links, kEmitterSamples); ++i) {
    uint k = (params.first_link + i) % kEmitterSamples;
    EmitterSample point = sample_emitter(params.grid, key, origin, normal, k);
    bool is_seen = point.irradiance != vec3(0.0) &&
                   march(params.grid, origin, point.direction, point.distance - kShortening, key + k).slot < 0;
    sampled |= 1u << k;
    seen = is_seen ? seen | (1u << k) : seen & ~(1u << k);
  }
  summaries.data[slot].emitters_sampled = sampled;
  summaries.data[slot].emitters_seen = seen;
}
