// Shadow rays through the grid of bits, without the octree. A ray goes from box to box: from the occupancy round its
// cell follow empty boxes of 1, 2, 4 or 8 cells a side, in one fine grid of 16 and 32 too.
#ifndef LIGHTWELL_VOXEL_TRACE_GLSL
#define LIGHTWELL_VOXEL_TRACE_GLSL

#include "passes/svo/svo_set.glsl"
#include "shaders/software_drivers.glsl"

layout(constant_id = 13) const uint kSvoFine = 0;  // 1: rays look for the larger boxes

layout(set = 3, binding = 1) readonly buffer SvoBitBuffer { uint data[]; } svo_bits;
layout(set = 3, binding = 2) readonly buffer SvoCoarseBuffer { uint data[]; } svo_coarse;

// Of the 64 bits that lie at the pair `words`: the word that holds the bit of `cell`.
uint half_of_brick(uint words, uvec3 cell) { return words + ((cell.z >> 1) & 1u); }
bool holds_bit(uint word, uvec3 cell) {
  return ((word >> ((cell.x & 3u) | ((cell.y & 3u) << 2) | ((cell.z & 1u) << 4))) & 1u) != 0;
}
// Whether the 2x2x2 bits round it are 0; all of them lie in the same word.
bool is_octant_empty(uint word, uvec3 cell) {
  return ((word >> ((cell.x & 2u) | ((cell.y & 2u) << 2))) & 0x00330033u) == 0;
}

// In cells of one grid, from its lower corner: whether an occupied cell lies on the segment. Axes along which the ray
// falls are mirrored, so that it rises along all: of 2^level cells, the mirrored one differs in all bits.
bool cells_blocked(vec3 from, vec3 to) {
  uint level = svo_frame.data.level;
  float side = float(1u << level);
  vec3 direction = to - from;
  float whole = length(direction);
  bvec3 falls = lessThan(direction, vec3(0.0));
  vec3 start = mix(from, side - from, falls);
  uvec3 flip = mix(uvec3(0), uvec3((1u << level) - 1u), falls);
  direction = max(abs(direction) / whole, vec3(1e-12));
  vec3 inverse = 1.0 / direction;

  // A step beyond each box: more than positions are rounded by. So far the ray stays inside the grid, too.
  float step_epsilon = 1e-6 * side;
  vec3 enters = (step_epsilon - start) * inverse;
  vec3 leaves = (side - step_epsilon - start) * inverse;
  float t = max(max(max(enters.x, enters.y), enters.z), 0.0);
  float last = min(min(min(leaves.x, leaves.y), leaves.z), whole);
  if (!(t < last)) return false;

  uint brick_log2 = level - 2;
  uint coarse_log2 = max(level, 4u) - 4;
  uint second_coarse = 2u << (3 * coarse_log2);
  // A ray crosses at most 3 cells for each along a side.
  uint bound = 3u << level;
  uint steps = 0;
  bool hit = false;
  bool going;
  do {
    uvec3 mirrored = uvec3(start + t * direction);
    uvec3 cell = mirrored ^ flip;
    uvec3 brick = cell >> 2;
    uint word = svo_bits.data[half_of_brick(brick_words(brick, brick_log2), cell)];
    uint coarse = svo_coarse.data[half_of_brick(brick_words(cell >> 4, coarse_log2), brick)];
    // Kept once found: SwiftShader (Vulkan 1.3.0) loses what a do loop assigns anew in each round.
    hit = hit || holds_bit(word, cell);
    // The largest empty box round the cell: its side - 1.
    uint size = is_octant_empty(word, cell) ? 1 : 0;
    if (!holds_bit(coarse, brick)) size = is_octant_empty(coarse, brick) ? 7 : 3;
    if (kSvoFine != 0) {
      uvec3 group = cell >> 4;
      uint coarser = svo_coarse.data[half_of_brick(second_coarse + brick_words(cell >> 6, coarse_log2 - 2), group)];
      if (!holds_bit(coarser, group)) size = is_octant_empty(coarser, group) ? 31 : 15;
    }
    vec3 exits = (vec3(mirrored | size) + (1.0 - start)) * inverse;
    t = max(t, min(min(exits.x, exits.y), exits.z)) + step_epsilon;
    ++steps;
    going = !hit && t < last && steps < bound;
  } while (going);
  return hit;
}

// The same through several levels, in finest cells from svo_frame.data.center: each place counts by the finest level
// that holds it. Where a coarser level is empty the finer ones in it are, so boxes may reach over their borders.
bool levels_blocked(vec3 from, vec3 to) {
  uint level_log2 = svo_frame.data.level;
  int last_cell = (1 << (level_log2 + kSvoLevels - 1)) - 1;
  vec3 direction = to - from;
  float whole = length(direction);
  bvec3 falls = lessThan(direction, vec3(0.0));
  // Mirrored: the cell c differs in all bits, its corner is on the other side.
  vec3 start = mix(from, 1.0 - from, falls);
  ivec3 flip = mix(ivec3(0), ivec3(last_cell), falls);
  ivec3 center = svo_frame.data.center ^ flip;
  direction = max(abs(direction) / whole, vec3(1e-12));
  vec3 inverse = 1.0 / direction;

  // A step beyond each box: more than positions are rounded by, there and where the ray starts.
  vec3 size_of_start = abs(start);
  float step_epsilon =
      1e-6 * (float(1u << level_log2) + max(max(size_of_start.x, size_of_start.y), size_of_start.z));
  vec3 enters = (step_epsilon - vec3(center) - start) * inverse;
  vec3 leaves = (vec3(last_cell - center) + (1.0 - step_epsilon) - start) * inverse;
  float t = max(max(max(enters.x, enters.y), enters.z), 0.0);
  float last = min(min(min(leaves.x, leaves.y), leaves.z), whole);
  if (!(t < last)) return false;

  uint brick_log2 = level_log2 - 2;
  uint coarse_log2 = max(level_log2, 4u) - 4;
  // A ray crosses at most 3 cells for each along a side of a level.
  uint bound = kSvoLevels * (3u << level_log2);
  uint steps = 0;
  uint level = kSvoLevels - 1;
  bool hit = false;
  bool going;
  do {
    ivec3 mirrored = clamp(ivec3(floor(start + t * direction)) + center, ivec3(0), ivec3(last_cell));
    ivec3 place = mirrored ^ flip;
    while (level > 0 && svo_window_holds(level - 1, place, 0)) --level;
    while (level + 1 < kSvoLevels && !svo_window_holds(level, place, 0)) ++level;
    uvec3 cell = uvec3((place >> int(level)) - svo_windows.data[level].xyz);
    uvec3 brick = cell >> 2;
    uint first_brick = level * (2u << (3 * brick_log2));
    uint first_coarse = level * svo_frame.data.coarse_words;
    uint word = svo_bits.data[half_of_brick(first_brick + brick_words(brick, brick_log2), cell)];
    uint coarse = svo_coarse.data[half_of_brick(first_coarse + brick_words(cell >> 4, coarse_log2), brick)];
    hit = hit || holds_bit(word, cell);
    int size = is_octant_empty(word, cell) ? 1 : 0;
    if (!holds_bit(coarse, brick)) size = is_octant_empty(coarse, brick) ? 7 : 3;
    // Windows begin at multiples of larger boxes, so the box is aligned there as here.
    ivec3 end = (((mirrored >> int(level)) | size) + 1) << int(level);
    vec3 exits = (vec3(end - center) - start) * inverse;
    t = max(t, min(min(exits.x, exits.y), exits.z)) * (1.0 + 1e-6) + step_epsilon;
    ++steps;
    going = !hit && t < last && steps < bound;
  } while (going);
  return hit;
}

// Coordinates of svo_coordinates().
bool places_blocked(vec3 from, vec3 to) {
  return kSvoLevels > 1 ? levels_blocked(from, to) : cells_blocked(from, to);
}

bool voxel_blocked(vec3 from, vec3 to) { return places_blocked(svo_coordinates(from), svo_coordinates(to)); }

// `cell`: from the lower corner of the level's window. Nothing is occupied outside of it.
bool is_cell_occupied(uint level, ivec3 cell) {
  int side = 1 << svo_frame.data.level;
  if (any(lessThan(cell, ivec3(0))) || any(greaterThanEqual(cell, ivec3(side)))) return false;
  uvec3 c = uvec3(cell);
  uint bit = brick_bit(c);
  uint brick_log2 = svo_frame.data.level - 2;
  uint first = kSvoLevels > 1 ? level * (2u << (3 * brick_log2)) : 0;
  uint word = svo_bits.data[first + brick_words(c >> 2, brick_log2) + (bit >> 5)];
  return ((word >> (bit & 31u)) & 1u) != 0;
}

// Above the cells that a surface's own plane meets: they reach at most |n.x| + |n.y| + |n.z| from it. No ray that
// leaves the surface from there meets them. Near the border of a level the cells are those of the next coarser one,
// into which flat rays come soon.
vec3 above_surface(vec3 point, vec3 normal) {
  const int kMargin = 4;  // cells
  uint level = kSvoLevels > 1 ? svo_level_at(svo_cell(point), kMargin) : 0;
  return point + normal * ((1.001 * dot(abs(normal), vec3(1.0)) + 0.001) * float(1u << level));
}

// Where a ray towards `direction` can start: `start`, or, if its cell is occupied, in an empty cell next to it on the
// ray's way. A surface beside fills the cell then, and the ray is on the side of it to which it goes.
vec3 empty_start(vec3 start, vec3 direction) {
  uint level = 0;
  ivec3 cell = ivec3(floor(start));
  ivec3 lower = ivec3(0);
  if (kSvoLevels > 1) {
    ivec3 place = svo_cell(start);
    level = svo_level_at(place, 0);
    lower = svo_windows.data[level].xyz;
    cell = (place >> int(level)) - lower;
  }
  ivec3 ahead = ivec3(sign(direction));
  ivec3 found = cell;
  bool occupied = is_cell_occupied(level, cell);
  for (int i = 1; i < LW_ROUNDS_IF(occupied, 8); ++i) {
    // Along one axis, then two, then three.
    int axes = i == 3 ? 4 : i == 4 ? 3 : i;
    ivec3 candidate = cell + ahead * (ivec3(axes, axes >> 1, axes >> 2) & 1);
    if (found == cell && !is_cell_occupied(level, candidate)) found = candidate;
  }
  if (kSvoLevels > 1) {
    float side = float(1u << level);
    vec3 corner = vec3(((found + lower) << int(level)) - svo_frame.data.center);
    return clamp(start, corner + 0.01 * side, corner + 0.99 * side);
  }
  return clamp(start, vec3(found) + 0.01, vec3(found) + 0.99);
}

// Whether something is between two points on surfaces. World positions, unit normals of the triangles (not shading
// normals), each on the other's side. The surfaces themselves, though they fill the cells in which the points lie, do
// not count, nor does what is within one or two cells of them. Symmetric.
bool voxel_blocked_between(vec3 from, vec3 from_normal, vec3 to, vec3 to_normal) {
  vec3 start = above_surface(svo_coordinates(from), from_normal);
  vec3 end = above_surface(svo_coordinates(to), to_normal);
  return places_blocked(empty_start(start, end - start), empty_start(end, start - end));
}

#endif
