// Light points in the order of their cells. Kernels have StratifyParams and declare
//   layout(set = 0, binding = n) readonly buffer SortedBuffer { uvec2 data[]; } sorted;   // x: cell, y: light point
//   layout(set = 0, binding = n) readonly buffer PointCountBuffer { uint data[]; } point_counts;
#ifndef LIGHTWELL_PHOTON_SPLATTING_STRATIFY_CELLS_GLSL
#define LIGHTWELL_PHOTON_SPLATTING_STRATIFY_CELLS_GLSL

// Block of 2^level cells a side that holds a cell.
uint block_of(uint cell, uint level) { return cell >> (3 * level); }

// The first light point in a block that holds one.
uint first_in_block(uint cell, uint level) {
  uint target = block_of(cell, level) << (3 * level);
  uint low = 0;
  uint high = point_counts.data[kPointsInAll];
  for (int i = 0; i < 32 && low < high; ++i) {
    uint middle = (low + high) / 2;
    if (sorted.data[middle].x < target) low = middle + 1;
    else high = middle;
  }
  return low;
}

// Whether light point `i` of the order is the first in its block.
bool is_first(uint i, uint level) {
  return i == 0 || block_of(sorted.data[i - 1].x, level) != block_of(sorted.data[i].x, level);
}

#endif
