// The list of emitting surfels, in order of their cells, so that it does not depend on the order of slots. Three
// dispatches: kStage 0 counts those of every brick of 4x4x4 cells (one invocation a brick), 1 adds up over the bricks
// (one invocation in all), 2 writes them down.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/light_volume/surfel_types.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kStage = 0;
layout(set = 0, binding = 0) buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer TableBuffer { uint data[]; } table;
layout(set = 0, binding = 2) readonly buffer BrickBuffer { uvec2 data[]; } bricks;
layout(set = 0, binding = 3) readonly buffer SurfelBuffer { Surfel data[]; } surfels;
layout(set = 0, binding = 4) buffer BrickSumBuffer { SurfelEmitter data[]; } brick_sums;  // slot: number of emitters
layout(set = 0, binding = 5) writeonly buffer EmitterBuffer { SurfelEmitter data[]; } emitters;

#include "techniques/light_volume/surfel.glsl"

float surfel_power(Surfel surfel) {
  return surfel.area * max(max(surfel.emission.x, surfel.emission.y), surfel.emission.z);
}

// Goes through a brick's emitters; writes them from `sum` on where `write` is set. Returns the sum after them.
SurfelEmitter add_brick(ivec3 brick, uvec2 occupied, SurfelEmitter sum, bool write) {
  for (uint i = 0; i < 64; ++i) {
    if ((occupied[i >> 5] & (1u << (i & 31u))) == 0) continue;
    ivec3 cell = 4 * brick + ivec3(i & 3u, (i >> 2) & 3u, i >> 4);
    uint entry = table.data[grid_cell_index(params.grid, cell)];
    for (uint d = 0; d < 6; ++d) {
      int slot = surfel_slot(entry, d);
      if (slot < 0) continue;
      float power = surfel_power(surfels.data[slot]);
      if (power <= 0.0) continue;
      sum.power_so_far += power;
      if (write) emitters.data[sum.slot] = SurfelEmitter(uint(slot), sum.power_so_far);
      ++sum.slot;
    }
  }
  return sum;
}

void add_up(uint brick_count) {
  SurfelEmitter sum = SurfelEmitter(0, 0.0);
  for (uint i = 0; i < brick_count; ++i) {
    SurfelEmitter brick = brick_sums.data[i];
    brick_sums.data[i] = sum;
    sum = SurfelEmitter(sum.slot + brick.slot, sum.power_so_far + brick.power_so_far);
  }
  counts.data[kCountEmitters] = sum.slot;
}

void main() {
  uvec3 size = (params.grid.resolution + 3) / 4;
  uint brick_count = size.x * size.y * size.z;
  uint index = gl_GlobalInvocationID.x;
  if (kStage == 1) {
    if (index == 0) add_up(brick_count);
    return;
  }
  if (index >= brick_count) return;
  ivec3 brick = ivec3(index % size.x, index / size.x % size.y, index / (size.x * size.y));
  uvec2 occupied = bricks.data[index];
  if (kStage == 0) {
    brick_sums.data[index] = add_brick(brick, occupied, SurfelEmitter(0, 0.0), false);
  } else if (occupied != uvec2(0)) {
    add_brick(brick, occupied, brick_sums.data[index], true);
  }
}
