// Shadow rays through the octree as published (Sun 2015, Fig. 3.3): from the root down to the leaf at the ray's place,
// then on to the far side of the leaf's box.
#ifndef LIGHTWELL_SVO_TRACE_GLSL
#define LIGHTWELL_SVO_TRACE_GLSL

#include "passes/svo/svo_nodes.glsl"

layout(set = 3, binding = 3) readonly buffer SvoCountBuffer { uint data[]; } svo_counts;

// By how much the end of a ray at these coordinates is shortened, finest cells.
float svo_epsilon(vec3 coordinates) {
  uint level = svo_frame.data.level;
  uint place_level = kSvoLevels > 1 ? svo_level_at(svo_cell(coordinates), 0) : 0;
  uint shift = max(place_level + level - svo_counts.data[kSvoListLevel],
                   level + kSvoLevels - 1 - svo_counts.data[kSvoLevelReached]);
  return svo_frame.data.epsilon * float(1u << shift);
}

// Whether an occupied leaf lies on the segment, both ends shortened by svo_frame.data.epsilon sides of a leaf there.
// World positions; nothing is occupied outside the grid.
bool svo_restart_blocked(vec3 from, vec3 to) {
  uint level = svo_frame.data.level + kSvoLevels - 1;
  float side = float(1u << level);
  ivec3 center = svo_frame.data.center;
  vec3 start = svo_coordinates(from);
  vec3 end = svo_coordinates(to);
  float whole = length(end - start);
  vec3 direction = (end - start) / whole;
  const float kLeast = 1e-12;
  direction = mix(direction, vec3(kLeast), lessThan(abs(direction), vec3(kLeast)));
  vec3 inverse = 1.0 / direction;

  // Distances from `start` in cells: where the ray enters the grid, where it ends.
  vec3 low = (-vec3(center) - start) * inverse;
  vec3 high = (side - vec3(center) - start) * inverse;
  vec3 enters = min(low, high);
  vec3 leaves = max(low, high);
  float t = max(max(max(enters.x, enters.y), enters.z), svo_epsilon(start));
  float last = min(min(min(leaves.x, leaves.y), leaves.z), whole - svo_epsilon(end));

  // A step beyond each leaf: more than positions are rounded by. A ray crosses at most 3 cells for each along a side.
  float largest = max(max(abs(start.x), abs(start.y)), abs(start.z));
  float step_epsilon = 1e-6 * (kSvoLevels > 1 ? float(1u << svo_frame.data.level) + largest : side);
  uint bound = kSvoLevels * (3u << svo_frame.data.level);
  uint steps = 0;
  bool hit = false;
  bool inside = t < last;
  while (inside) {
    ivec3 cell = clamp(ivec3(floor(start + t * direction)) + center, ivec3(0), ivec3((1 << level) - 1));
    uint info = svo_nodes_at(0).x;
    uint shift = level;  // log2 of the node's side
    while (shift > 0 && (info & kSvoLeaf) == 0) {
      --shift;
      info = svo_nodes_at(8 * (info & kSvoTileMask) + octant(uvec3(cell) >> shift)).x;
    }
    hit = (info & kSvoOccupied) != 0;
    ivec3 leaf = cell >> int(shift);
    vec3 far = vec3((mix(leaf, leaf + 1, greaterThan(direction, vec3(0.0))) << int(shift)) - center);
    vec3 exits = (far - start) * inverse;
    t = max(t, min(min(exits.x, exits.y), exits.z)) + step_epsilon;
    if (kSvoLevels > 1) t += 1e-6 * t;
    ++steps;
    inside = t < last && !hit && steps < bound;
  }
  return hit;
}

#endif
