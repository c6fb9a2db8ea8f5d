// Which of the 26 cells round a surfel hold one of the same direction that it sees: only between those is light
// interpolated, so none gets from one side of a wall to the other along the floor.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/light_volume/surfel_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer TableBuffer { uint data[]; } table;
layout(set = 0, binding = 2) readonly buffer BrickBuffer { uvec2 data[]; } bricks;
layout(set = 0, binding = 3) readonly buffer SurfelBuffer { Surfel data[]; } surfels;
layout(set = 0, binding = 4) buffer SummaryBuffer { LinkSummary data[]; } summaries;

#include "shaders/linear_dispatch.glsl"
#include "techniques/light_volume/surfel.glsl"
#include "techniques/light_volume/surfel_march.glsl"

const float kLift = 0.1;             // of the line of sight above both surfaces
const float kSamePlane = 0.02;       // cells

bool is_blocked(vec3 from, vec3 to) {
  vec3 line = to - from;
  float size = length(line);
  if (size < kStartDistance) return false;
  return march(params.grid, from, line / size, size, 0).slot >= 0;
}

bool holds_one_axis(uint entry, uint direction) {
  uint alive = (entry >> kTableAliveShift) & 63u;
  return (alive & ~(3u << (direction & 6u))) == 0;
}

void main() {
  uint slot = linear_invocation();
  if (slot >= counts.data[kCountSurfels]) return;
  Surfel surfel = surfels.data[slot];
  uint direction = key_direction(surfel.key);
  ivec3 cell = key_cell(params.grid, surfel.key);
  bool is_simple = holds_one_axis(table.data[surfel.key >> 3], direction);
  vec3 from = surfel.position + kLift * surfel.normal;

  uint seen = 0;
  for (uint i = 0; i < 27; ++i) {
    ivec3 other = cell + ivec3(i % 3, i / 3 % 3, i / 9) - 1;
    if (!grid_contains(params.grid, other)) continue;
    uint entry = table.data[grid_cell_index(params.grid, other)];
    int other_slot = surfel_slot(entry, direction);
    if (other_slot < 0) continue;
    vec3 position = surfels.data[other_slot].position;
    vec3 normal = surfels.data[other_slot].normal;
    // Two neighbouring pieces of one wall, and nothing else there: no need to look.
    vec3 offset = position - surfel.position;
    ivec3 apart = abs(other - cell);
    bool is_wall = is_simple && holds_one_axis(entry, direction) && apart.x + apart.y + apart.z <= 1 &&
                   abs(dot(offset, normal)) < kSamePlane && abs(dot(offset, surfel.normal)) < kSamePlane;
    vec3 to = position + kLift * normal;
    if (i == 13 || is_wall || (!is_blocked(from, to) && !is_blocked(to, from))) seen |= 1u << i;
  }
  summaries.data[slot].neighbours = seen;
}
