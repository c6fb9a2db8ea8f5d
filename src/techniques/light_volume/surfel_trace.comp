// Links every surfel with what it sees along some of its rays: `traced_links` of them, from `first_link` on. The rays
// of a surfel are cosine-distributed and depend on its cell and direction only, so a ray that is traced again after
// something else has moved finds the same link again.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/light_volume/surfel_types.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer TableBuffer { uint data[]; } table;
layout(set = 0, binding = 2) readonly buffer BrickBuffer { uvec2 data[]; } bricks;
layout(set = 0, binding = 3) readonly buffer SurfelBuffer { Surfel data[]; } surfels;
LW_PAGED_WRITE(0, 4, uint, links)

#include "shaders/linear_dispatch.glsl"
#include "techniques/light_volume/surfel.glsl"
#include "techniques/light_volume/surfel_march.glsl"
#include "techniques/light_volume/surfel_near.glsl"

const float kLift = 0.01;  // origin above the surface

// Emission comes along a link where the emitter is near, and everywhere where so much of the scene emits that rays
// find it; far emitters get shadow rays (surfel_emitters.glsl).
uint trace_link(vec3 origin, vec3 direction, uint seed) {
  MarchHit hit = march(params.grid, origin, direction, 1e9, seed);
  if (hit.slot < 0) return kLinkEscaped | pack_direction(direction, 32767.0, 15);
  uint link = uint(hit.slot);
  if (surfels.data[hit.slot].is_front == 0) link |= kLinkBack;
  if (surfels.data[hit.slot].emission != vec3(0.0) && hit.distance < near_emitters()) link |= kLinkEmits;
  return link;
}

void main() {
  uint slot = linear_invocation();
  if (slot >= counts.data[kCountSurfels]) return;
  vec3 normal = surfels.data[slot].normal;
  if (normal == vec3(0.0)) return;
  uint key = surfels.data[slot].key;
  vec3 origin = surfels.data[slot].position + kLift * normal;
  for (uint i = 0; i < params.traced_links; ++i) {
    uint k = (params.first_link + i) % params.link_count;
    vec3 direction = surfel_direction(normal, rotated_sample(key, k));
    links_store(k * params.capacity + slot, trace_link(origin, direction, key + 0x9e3779b9u * k));
  }
}
