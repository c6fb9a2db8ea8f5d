// Gives every cell with a surface slots for its surfels. One invocation a brick of 4x4x4 cells: the surfels of a
// brick lie together, and only one atomic addition is needed for all of them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxelize/voxelize_types.h"
#include "techniques/light_volume/surfel_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CellBuffer { uint data[]; } cells;
layout(set = 0, binding = 1) buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 2) writeonly buffer TableBuffer { uint data[]; } table;
layout(set = 0, binding = 3) writeonly buffer BrickBuffer { uvec2 data[]; } bricks;  // bit of a cell: x + 4 y + 16 z
layout(set = 0, binding = 4) buffer SurfelBuffer { Surfel data[]; } surfels;

// Directions in which a cell has surfaces, front or back.
uint stored_directions(ivec3 cell) {
  if (!grid_contains(params.grid, cell)) return 0;
  uint word = cells.data[grid_cell_index(params.grid, cell)];
  return (word | (word >> kCellBackShift)) & 63u;
}

ivec3 cell_of_brick(ivec3 brick, uint i) {
  return 4 * brick + ivec3(i & 3u, (i >> 2) & 3u, i >> 4);
}

void main() {
  uint index = gl_GlobalInvocationID.x;
  uvec3 size = (params.grid.resolution + 3) / 4;
  if (index >= size.x * size.y * size.z) return;
  ivec3 brick = ivec3(index % size.x, index / size.x % size.y, index / (size.x * size.y));

  uint total = 0;
  uvec2 occupied = uvec2(0);
  for (uint i = 0; i < 64; ++i) {
    uint stored = stored_directions(cell_of_brick(brick, i));
    total += bitCount(stored);
    if (stored != 0) occupied[i >> 5] |= 1u << (i & 31u);
  }

  // Without room for the whole brick it stays empty, and what is lost is counted. Slots are handed out in rising
  // order, so all before the first failure are in use and none after it.
  uint base = total == 0 ? 0 : atomicAdd(counts.data[kCountSurfels], total);
  bool fits = base + total <= params.capacity;
  if (!fits) {
    atomicMax(counts.data[kCountUnused], params.capacity - min(base, params.capacity));
    atomicAdd(counts.data[kCountLost], total);
  }
  bricks.data[index] = fits ? occupied : uvec2(0);

  for (uint i = 0; i < 64; ++i) {
    ivec3 cell = cell_of_brick(brick, i);
    if (!grid_contains(params.grid, cell)) continue;
    uint stored = fits ? stored_directions(cell) : 0;
    uint cell_index = grid_cell_index(params.grid, cell);
    table.data[cell_index] = stored == 0 ? 0 : (base << kTableBaseShift) | (stored << kTableAliveShift) | stored;
    for (uint d = 0; d < 6; ++d)
      if ((stored & (1u << d)) != 0) surfels.data[base++].key = 8 * cell_index + d;
  }
}
