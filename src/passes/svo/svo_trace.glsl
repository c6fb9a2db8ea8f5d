// Shadow rays through the octree as published (Sun 2015, Fig. 3.3): from the root down to the leaf at the ray's place,
// then on to the far side of the leaf's box.
#ifndef LIGHTWELL_SVO_TRACE_GLSL
#define LIGHTWELL_SVO_TRACE_GLSL

#include "passes/svo/svo_nodes.glsl"

layout(set = 3, binding = 3) readonly buffer SvoCountBuffer { uint data[]; } svo_counts;

// Whether an occupied leaf lies on the segment, both ends shortened by svo_frame.data.epsilon sides of a leaf. World
// positions; nothing is occupied outside the grid.
bool svo_restart_blocked(vec3 from, vec3 to) {
  uint level = svo_frame.data.level;
  float side = float(1u << level);
  vec3 start = grid_coordinates(svo_frame.data.grid, from);
  vec3 end = grid_coordinates(svo_frame.data.grid, to);
  float epsilon = svo_frame.data.epsilon * float(1u << (level - svo_counts.data[kSvoLevelReached]));
  float whole = length(end - start);
  vec3 direction = (end - start) / whole;
  const float kLeast = 1e-12;
  direction = mix(direction, vec3(kLeast), lessThan(abs(direction), vec3(kLeast)));
  vec3 inverse = 1.0 / direction;

  // Distances from `start` in cells: where the ray enters the grid, where it ends.
  vec3 low = -start * inverse;
  vec3 high = (side - start) * inverse;
  vec3 enters = min(low, high);
  vec3 leaves = max(low, high);
  float t = max(max(max(enters.x, enters.y), enters.z), epsilon);
  float last = min(min(min(leaves.x, leaves.y), leaves.z), whole - epsilon);

  // A step beyond each leaf: more than positions are rounded by. A ray crosses at most 3 cells for each along a side.
  float step_epsilon = 1e-6 * side;
  uint bound = 3u << level;
  uint steps = 0;
  bool hit = false;
  bool inside = t < last;
  while (inside) {
    uvec3 cell = uvec3(clamp(ivec3(floor(start + t * direction)), ivec3(0), ivec3(side) - 1));
    uint node = 0;
    uint info = svo_nodes_at(0).x;
    for (uint depth = 1; depth <= level && (info & kSvoLeaf) == 0; ++depth) {
      node = 8 * (info & kSvoTileMask) + octant(cell >> (level - depth));
      info = svo_nodes_at(node).x;
    }
    hit = (info & kSvoOccupied) != 0;
    uvec4 leaf = svo_nodes_at(node);
    vec3 far = mix(vec3(unpack_cell(leaf.z)), vec3(unpack_cell(leaf.w) + 1), greaterThan(direction, vec3(0.0)));
    vec3 exits = (far - start) * inverse;
    t = max(t, min(min(exits.x, exits.y), exits.z)) + step_epsilon;
    ++steps;
    inside = t < last && !hit && steps < bound;
  }
  return hit;
}

#endif
