// After the geometry has changed: a surfel that was there before, in the same cell and direction, keeps its light and
// its links, renamed to today's slots. Links to what is gone are lost; all are traced again over the next frames.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/light_volume/surfel_types.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer TableBuffer { uint data[]; } table;
layout(set = 0, binding = 2) readonly buffer SurfelBuffer { Surfel data[]; } surfels;
layout(set = 0, binding = 3) readonly buffer OldTableBuffer { uint data[]; } old_table;
layout(set = 0, binding = 4) readonly buffer OldSurfelBuffer { Surfel data[]; } old_surfels;
LW_PAGED_READ(0, 5, uint, old_links)
layout(set = 0, binding = 6) readonly buffer OldIrradianceBuffer { vec4 data[]; } old_irradiance;
layout(set = 0, binding = 7) readonly buffer OldSummaryBuffer { LinkSummary data[]; } old_summaries;
layout(set = 0, binding = 8) buffer SummaryBuffer { LinkSummary data[]; } summaries;
LW_PAGED_WRITE(0, 9, uint, links)
layout(set = 0, binding = 10) writeonly buffer IrradianceBuffer { vec4 data[]; } irradiance;

#include "shaders/linear_dispatch.glsl"
#include "techniques/light_volume/surfel.glsl"

uint carry_link(uint link) {
  if (link >= kLinkEscaped) return link;
  uint key = old_surfels.data[link & kLinkSlot].key;
  int slot = surfel_slot(table.data[key >> 3], key_direction(key));
  if (slot < 0) return kLinkNone;
  return uint(slot) | (surfels.data[slot].is_front == 0 ? kLinkBack : 0) | (link & kLinkEmits);
}

void main() {
  uint slot = linear_invocation();
  if (slot >= counts.data[kCountSurfels]) return;
  uint key = surfels.data[slot].key;
  int old_slot = surfel_slot(old_table.data[key >> 3], key_direction(key));
  irradiance.data[slot] = old_slot < 0 ? vec4(0.0) : old_irradiance.data[old_slot];
  summaries.data[slot].neighbours = 0;  // found anew
  summaries.data[slot].emitters_sampled = old_slot < 0 ? 0 : old_summaries.data[old_slot].emitters_sampled;
  summaries.data[slot].emitters_seen = old_slot < 0 ? 0 : old_summaries.data[old_slot].emitters_seen;
  for (uint k = 0; k < params.link_count; ++k) {
    uint first = k * params.capacity;
    links_store(first + slot, old_slot < 0 ? kLinkNone : carry_link(old_links_at(first + old_slot)));
  }
}
