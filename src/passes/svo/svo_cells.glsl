// Cells, bricks and octants as numbers.
#ifndef LIGHTWELL_SVO_CELLS_GLSL
#define LIGHTWELL_SVO_CELLS_GLSL

uint pack_cell(uvec3 cell) { return cell.x | (cell.y << 10) | (cell.z << 20); }
uvec3 unpack_cell(uint packed) { return (uvec3(packed) >> uvec3(0, 10, 20)) & 1023u; }

// Of a cell at its own level, in the tile of its parent's children.
uint octant(uvec3 cell) { return (cell.x & 1u) | ((cell.y & 1u) << 1) | ((cell.z & 1u) << 2); }

// First of a brick's two words; 2^bricks_log2 bricks a side.
uint brick_words(uvec3 brick, uint bricks_log2) {
  return 2 * (brick.x | (brick.y << bricks_log2) | (brick.z << (2 * bricks_log2)));
}

// Of a cell in its brick, 0 to 63.
uint brick_bit(uvec3 cell) { return (cell.x & 3u) | ((cell.y & 3u) << 2) | ((cell.z & 3u) << 4); }

// A bit for each octant of a brick that holds a bit.
uint octants_of_brick(uint low, uint high) {
  uint octants = 0;
  for (uint i = 0; i < 8; ++i) {
    uint mask = 0x00330033u << (2 * (i & 1u) + 8 * ((i >> 1) & 1u));
    if (((i < 4 ? low : high) & mask) != 0) octants |= 1u << i;
  }
  return octants;
}

#endif
