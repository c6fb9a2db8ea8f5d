// Shadow rays through the octree as published (Sun 2015, Fig. 3.3): from the root down to the leaf at the ray's place,
// then on to the far side of the leaf's box.
#ifndef LIGHTWELL_SVO_TRACE_GLSL
#define LIGHTWELL_SVO_TRACE_GLSL

#include "passes/svo/svo_set.glsl"
#include "shaders/paged_buffer.glsl"

layout(set = 3, binding = 3) readonly buffer SvoCountBuffer { uint data[]; } svo_counts;
LW_PAGED_READ(3, 4, uvec4, svo_nodes)

// Whether an occupied leaf lies on the segment, both ends shortened by svo_frame.data.epsilon sides of a leaf. World
// positions; nothing is occupied outside the grid.
bool svo_restart_blocked(vec3 from, vec3 to) {
  uint level = svo_frame.data.level;
  float side = float(1u << level);
  vec3 start = grid_coordinates(svo_frame.data.grid, from);
  vec3 end = grid_coordinates(svo_frame.data.grid, to);
  float epsilon = svo_frame.data.epsilon * float(1u << (level - svo_counts.data[kSvoLevelReached]));
  float whole = length(end - start);
  if (!(whole > 2.0 * epsilon)) return false;
  vec3 direction = (end - start) / whole;
  SvoSegment s = svo_segment(start + epsilon * direction, end - epsilon * direction, side);

  // Distances in cells from here on. A step beyond the leaf: more than positions are rounded by.
  float shortened = whole - 2.0 * epsilon;
  float step_epsilon = 1e-6 * side;
  float last = s.leave * shortened;
  float t = s.enter * shortened;
  // A ray crosses at most 3 cells for each along a side.
  uint bound = 3u << level;
  uint steps = 0;
  bool hit = false;
  bool inside = t < last;
  while (inside) {
    uvec3 cell = uvec3(clamp(ivec3(floor(s.from + t * direction)), ivec3(0), ivec3(side) - 1));
    uint node = 0;
    uint info = svo_nodes_at(0).x;
    for (uint depth = 1; depth <= level && (info & kSvoLeaf) == 0; ++depth) {
      node = 8 * (info & kSvoTileMask) + octant(cell >> (level - depth));
      info = svo_nodes_at(node).x;
    }
    uvec4 leaf = svo_nodes_at(node);
    hit = (info & kSvoOccupied) != 0;
    vec3 low = vec3(unpack_cell(leaf.z));
    vec3 high = vec3(unpack_cell(leaf.w) + 1);
    vec3 exits = (mix(low, high, greaterThan(direction, vec3(0.0))) - s.from) * s.inverse * shortened;
    t = max(t, min(min(exits.x, exits.y), exits.z)) + step_epsilon;
    ++steps;
    inside = t < last && !hit && steps < bound;
  }
  return hit;
}

#endif
