// Rays through the grid of surfels. The including kernel declares `table`, `bricks` and `surfels` (surfel_types.h)
// and includes surfel.glsl.
#ifndef LIGHTWELL_SURFEL_MARCH_GLSL
#define LIGHTWELL_SURFEL_MARCH_GLSL

const float kStartDistance = 2e-3;  // a ray does not hit what it starts on
const float kPatchMargin = 0.02;    // patches reach this much further than their bounds, against cracks

struct MarchHit {
  int slot;        // -1: nothing
  float distance;
};

// Nearest of a cell's patches `alive` that faces the ray and that it meets before hit.distance: the plane of the
// surfel, inside its bounds. For a flat surface the plane cut by the bounds *is* the surface, so neither the cell's
// corners nor its other surfaces get in the way. A patch that is only partly there (leaves, a fence) lets the same
// part of the rays through.
void hit_cell(ivec3 cell, uint entry, uint alive, vec3 origin, vec3 direction, uint seed, inout MarchHit hit) {
  while (alive != 0) {
    uint d = uint(findLSB(alive));
    alive &= alive - 1u;
    int slot = stored_slot(entry, d);
    Surfel surfel = surfels.data[slot];
    float approach = dot(direction, surfel.normal);
    float distance = dot(surfel.position - origin, surfel.normal) / approach;
    vec3 point = origin + distance * direction - vec3(cell);
    bool meets = approach < -1e-4 && distance > kStartDistance && distance < hit.distance &&
                 all(greaterThan(point, unpack_10(surfel.bounds_low) - kPatchMargin)) &&
                 all(lessThan(point, unpack_10(surfel.bounds_high) + kPatchMargin));
    if (surfel.opacity < 1.0) meets = meets && float(hash_word(seed ^ hash_word(surfel.key)) >> 8) < surfel.opacity * 16777216.0;
    if (meets) hit = MarchHit(slot, distance);
  }
}

float smallest(vec3 v) { return min(min(v.x, v.y), v.z); }

// First surfel along the ray, from cell to cell (Amanatides and Woo 1987), over empty bricks of 4x4x4 cells at once.
MarchHit march(VoxelGrid grid, vec3 origin, vec3 direction, float limit, uint seed) {
  vec3 safe = mix(vec3(1e-9), direction, greaterThan(abs(direction), vec3(1e-9)));
  vec3 inverse = 1.0 / safe;
  ivec3 ahead = ivec3(greaterThan(safe, vec3(0.0)));
  ivec3 bricks_a_side = (ivec3(grid.resolution) + 3) / 4;
  ivec3 cell = ivec3(floor(origin));
  int most_steps = 3 * int(max(max(grid.resolution.x, grid.resolution.y), grid.resolution.z)) + 3;
  MarchHit hit = MarchHit(-1, limit);
  for (int i = 0; i < most_steps && grid_contains(grid, cell); ++i) {
    ivec3 brick = cell >> 2;
    uvec2 occupied = bricks.data[(brick.z * bricks_a_side.y + brick.y) * bricks_a_side.x + brick.x];
    bool empty = occupied == uvec2(0);
    uint bit = uint((cell.x & 3) | ((cell.y & 3) << 2) | ((cell.z & 3) << 4));
    uint word = bit < 32 ? occupied.x : occupied.y;
    uint entry = (word & (1u << (bit & 31u))) == 0 ? 0 : table.data[grid_cell_index(grid, cell)];
    hit_cell(cell, entry, alive_directions(entry), origin, direction, seed, hit);
    if (hit.slot >= 0) break;
    // To the far side of the cell, or of the empty brick: on along the axis whose side is reached first, and
    // elsewhere to the cell that holds the point, but not out of the box.
    int side = empty ? 4 : 1;
    ivec3 box = empty ? brick * 4 : cell;
    vec3 exits = (vec3(box + ahead * side) - origin) * inverse;
    float exit = smallest(exits);
    if (exit > limit) break;
    ivec3 next = clamp(ivec3(floor(origin + exit * direction)), box, box + side - 1);
    int axis = exit == exits.x ? 0 : exit == exits.y ? 1 : 2;
    next[axis] = box[axis] + (ahead[axis] == 1 ? side : -1);
    cell = next;
  }
  return hit;
}

#endif
