// Set 3 of kernels that look into the octree or its grid of bits: Svo::set of passes/svo/svo.h.
#ifndef LIGHTWELL_SVO_SET_GLSL
#define LIGHTWELL_SVO_SET_GLSL

#include "passes/svo/svo_cells.glsl"
#include "passes/svo/svo_types.h"

layout(constant_id = 12) const uint kSvoLevels = 1;

layout(set = 3, binding = 0) readonly buffer SvoFrameBuffer { SvoFrame data; } svo_frame;
// Of each level's window: its lowest cell.
layout(set = 3, binding = 5) readonly buffer SvoWindowBuffer { ivec4 data[]; } svo_windows;

// A world position in finest cells from the lower corner of svo_frame.data.center: small numbers near the focus.
vec3 svo_coordinates(vec3 position) { return (position - svo_frame.data.place) / svo_frame.data.cell_size; }

// The finest cell there, of those in the coarsest level, by its coordinates from that level's lower corner.
ivec3 svo_cell(vec3 coordinates) {
  int side = 1 << (svo_frame.data.level + kSvoLevels - 1);
  vec3 center = vec3(svo_frame.data.center);
  return clamp(ivec3(floor(clamp(coordinates, -center, float(side) - center))) + svo_frame.data.center, 0, side - 1);
}

// Whether a level's window holds a finest cell, no less than `margin` of its own cells from its borders.
bool svo_window_holds(uint level, ivec3 cell, int margin) {
  uvec3 inside = uvec3((cell >> int(level)) - svo_windows.data[level].xyz - margin);
  return all(lessThan(inside, uvec3((1 << svo_frame.data.level) - 2 * margin)));
}

// The finest level whose window holds it so.
uint svo_level_at(ivec3 cell, int margin) {
  uint level = 0;
  while (level + 1 < kSvoLevels && !svo_window_holds(level, cell, margin)) ++level;
  return level;
}

#endif
