// Corners of the builder's triangles. The including kernel declares BvhParams.
#ifndef LIGHTWELL_BVH_CORNERS_GLSL
#define LIGHTWELL_BVH_CORNERS_GLSL

#include "shaders/geometry.glsl"

struct Corners {
  vec3 p[3];
};

// Of item 0 .. count - 1, its index in the scene.
uint scene_triangle(uint item) { return item < params.gap_first ? item : item + params.gap_count; }

bool is_usable(vec3 p) { return all(lessThan(abs(p), vec3(kBvhLargestCoordinate))); }

// All corners in one point where the triangle cannot be met: so it gets a place and is never hit.
Corners load_corners(uint triangle) {
  Corners c;
  for (uint i = 0; i < 3; ++i) c.p[i] = scene_position(scene_index(3 * triangle + i));
  if (!is_usable(c.p[0]) || !is_usable(c.p[1]) || !is_usable(c.p[2])) c.p[0] = c.p[1] = c.p[2] = vec3(0.0);
  return c;
}

vec3 low_corner(Corners c) { return min(min(c.p[0], c.p[1]), c.p[2]); }
vec3 high_corner(Corners c) { return max(max(c.p[0], c.p[1]), c.p[2]); }
vec3 box_center(Corners c) { return 0.5 * low_corner(c) + 0.5 * high_corner(c); }

#endif
