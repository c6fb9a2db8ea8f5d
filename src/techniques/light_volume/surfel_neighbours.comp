// Which of the 26 cells round a surfel hold one of the same direction that it sees: only between those is light
// interpolated, so none gets from one side of a wall to the other along the floor. `neighbours` starts at 0.
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

ivec3 neighbour_offset(uint i) { return ivec3(i % 3, i / 3 % 3, i / 9) - 1; }

bool is_blocked(vec3 from, vec3 to) {
  vec3 line = to - from;
  float size = length(line);
  if (size < kStartDistance) return false;
  return march(params.grid, from, line / size, size, 0).slot >= 0;
}

// No surface but of this axis, not even one that only touches the cell.
bool holds_one_axis(uint entry, uint direction) {
  return (entry & 63u & ~(3u << (direction & 6u))) == 0;
}

// The neighbours in half of the directions, i > 13, that have a surfel of this one's direction: those that are surely
// seen (two pieces of one wall and nothing else in either cell: what could stand between them would touch one of the
// two), and those that a ray must tell.
void sort_neighbours(Surfel surfel, ivec3 cell, uint direction, out uint sure, out uint open) {
  sure = open = 0;
  bool is_simple = holds_one_axis(table.data[surfel.key >> 3], direction);
  for (uint i = 14; i < 27; ++i) {
    ivec3 other = cell + neighbour_offset(i);
    uint entry = grid_contains(params.grid, other) ? table.data[grid_cell_index(params.grid, other)] : 0;
    int slot = surfel_slot(entry, direction);
    if (slot < 0) continue;
    vec3 offset = surfels.data[slot].position - surfel.position;
    bool is_wall = is_simple && holds_one_axis(entry, direction) &&
                   abs(dot(offset, surfels.data[slot].normal)) < kSamePlane &&
                   abs(dot(offset, surfel.normal)) < kSamePlane;
    if (is_wall) sure |= 1u << i;
    else open |= 1u << i;
  }
}

void main() {
  uint slot = linear_invocation();
  if (slot >= counts.data[kCountSurfels]) return;
  Surfel surfel = surfels.data[slot];
  if (surfel.normal == vec3(0.0)) return;  // nothing is there: it has no position either
  uint direction = key_direction(surfel.key);
  ivec3 cell = key_cell(params.grid, surfel.key);
  uint seen, open;
  sort_neighbours(surfel, cell, direction, seen, open);

  vec3 from = surfel.position + kLift * surfel.normal;
  while (open != 0) {
    uint i = uint(findLSB(open));
    open &= open - 1u;
    ivec3 other = cell + neighbour_offset(i);
    int other_slot = stored_slot(table.data[grid_cell_index(params.grid, other)], direction);
    vec3 to = surfels.data[other_slot].position + kLift * surfels.data[other_slot].normal;
    if (!is_blocked(from, to)) seen |= 1u << i;
  }

  // Seeing is mutual: bit 26 - i of the other one says the same.
  atomicOr(summaries.data[slot].neighbours, seen | (1u << 13));
  while (seen != 0) {
    uint i = uint(findLSB(seen));
    seen &= seen - 1u;
    ivec3 other = cell + neighbour_offset(i);
    int other_slot = stored_slot(table.data[grid_cell_index(params.grid, other)], direction);
    atomicOr(summaries.data[other_slot].neighbours, 1u << (26 - i));
  }
}
