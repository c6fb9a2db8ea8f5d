// Shadow rays through the grid of bits, without the octree: from cell to cell (Amanatides and Woo 1987), over empty
// bricks of 4, 16 and 64 cells a side at once.
#ifndef LIGHTWELL_VOXEL_TRACE_GLSL
#define LIGHTWELL_VOXEL_TRACE_GLSL

#include "passes/svo/svo_set.glsl"
#include "shaders/software_drivers.glsl"

layout(set = 3, binding = 1) readonly buffer SvoBitBuffer { uint data[]; } svo_bits;
layout(set = 3, binding = 2) readonly buffer SvoCoarseBuffer { uint data[]; } svo_coarse;

// In cells from the grid's lower corner: whether an occupied cell lies on the segment.
bool cells_blocked(vec3 from, vec3 to) {
  uint level = svo_frame.data.level;
  SvoSegment s = svo_segment(from, to, float(1u << level));
  if (!(s.enter < s.leave)) return false;
  uint brick_log2 = level - 2;
  uint coarse_log2 = max(level, 4u) - 4;
  ivec3 ahead = ivec3(greaterThan(s.direction, vec3(0.0)));
  ivec3 last = ivec3((1 << level) - 1);
  ivec3 cell = clamp(ivec3(floor(s.from + s.enter * s.direction)), ivec3(0), last);
  uint bound = 3u << level;
  uint steps = 0;
  bool hit;
  bool going;
  do {
    uvec3 c = uvec3(cell);
    uint brick = brick_words(c >> 2, brick_log2);
    uint low = svo_bits.data[brick];
    uint high = svo_bits.data[brick + 1];
    uint group = brick_words(c >> 4, coarse_log2);
    bool any_group = (svo_coarse.data[group] | svo_coarse.data[group + 1]) != 0;
    uint word = (c.z & 2u) == 0 ? low : high;
    hit = ((word >> (brick_bit(c) & 31u)) & 1u) != 0;
    int size = (low | high) != 0 ? 1 : any_group ? 4 : 16;
    // On to the far side of the empty box: to the next along the axis whose side is reached first, elsewhere to the
    // place that the ray has there.
    ivec3 box = cell & -size;
    vec3 exits = (vec3(box + ahead * size) - s.from) * s.inverse;
    float t = min(min(exits.x, exits.y), exits.z);
    ivec3 next = clamp(ivec3(floor(s.from + t * s.direction)), box, box + size - 1);
    ivec3 beyond = box + ahead * (size + 1) - 1;
    cell = mix(next, beyond, lessThanEqual(exits, vec3(t)));
    ++steps;
    going = !hit && t < s.leave && steps < bound;
  } while (going);
  return hit;
}

bool voxel_blocked(vec3 from, vec3 to) {
  return cells_blocked(grid_coordinates(svo_frame.data.grid, from), grid_coordinates(svo_frame.data.grid, to));
}

bool is_cell_occupied(ivec3 cell) {
  int side = 1 << svo_frame.data.level;
  if (any(lessThan(cell, ivec3(0))) || any(greaterThanEqual(cell, ivec3(side)))) return false;
  uvec3 c = uvec3(cell);
  uint bit = brick_bit(c);
  uint word = svo_bits.data[brick_words(c >> 2, svo_frame.data.level - 2) + (bit >> 5)];
  return ((word >> (bit & 31u)) & 1u) != 0;
}

// From a point on a surface, cells, to where a ray towards `direction` (any length) can start.
//
// A cell that the surface's own plane meets reaches at most |n.x| + |n.y| + |n.z| above it: from that height on, no ray
// that leaves the surface meets them. Where that place is occupied, a surface beside fills it, of which the ray may be on
// the lit side: then it starts in an empty cell next to it, of those on its way.
vec3 leave_surface(vec3 point, vec3 normal, vec3 direction) {
  vec3 start = point + normal * (1.001 * dot(abs(normal), vec3(1.0)) + 0.001);
  ivec3 cell = ivec3(floor(start));
  ivec3 ahead = ivec3(sign(direction));
  bool occupied = is_cell_occupied(cell);
  ivec3 found = cell;
  for (int i = 1; i < LW_ROUNDS_IF(occupied, 8); ++i) {
    // One axis, then two, then three: 1, 2, 4, 3, 5, 6, 7.
    int axes = i == 3 ? 4 : i == 4 ? 3 : i;
    ivec3 candidate = cell + ahead * (ivec3(axes, axes >> 1, axes >> 2) & 1);
    if (found == cell && !is_cell_occupied(candidate)) found = candidate;
  }
  return clamp(start, vec3(found) + 0.01, vec3(found) + 0.99);
}

// Whether something is between two points on surfaces, world positions and unit normals of the triangles (not shading
// normals), each on the side of the other. The surfaces themselves, that fill the cells in which the points lie, do
// not count.
bool voxel_blocked_between(vec3 from, vec3 from_normal, vec3 to, vec3 to_normal) {
  vec3 start = grid_coordinates(svo_frame.data.grid, from);
  vec3 end = grid_coordinates(svo_frame.data.grid, to);
  vec3 direction = end - start;
  return cells_blocked(leave_surface(start, from_normal, direction), leave_surface(end, to_normal, -direction));
}

#endif
