// Set 3 of kernels that look into the octree or its grid of bits: Svo::set of passes/svo/svo.h.
#ifndef LIGHTWELL_SVO_SET_GLSL
#define LIGHTWELL_SVO_SET_GLSL

#include "passes/svo/svo_cells.glsl"
#include "passes/svo/svo_types.h"

layout(set = 3, binding = 0) readonly buffer SvoFrameBuffer { SvoFrame data; } svo_frame;

// A segment in cells from the grid's lower corner, as boxes see it. Positions are from + t direction, 0 <= t <= 1; of
// its direction no component is 0.
struct SvoSegment {
  vec3 from;
  vec3 direction;
  vec3 inverse;
  float enter, leave;  // t at which it is inside the grid; enter > leave: nowhere
};

SvoSegment svo_segment(vec3 from, vec3 to, float side) {
  SvoSegment s;
  s.from = from;
  vec3 direction = to - from;
  const float kLeast = 1e-12;
  s.direction = mix(direction, vec3(kLeast), lessThan(abs(direction), vec3(kLeast)));
  s.inverse = 1.0 / s.direction;
  vec3 low = -s.from * s.inverse;
  vec3 high = (vec3(side) - s.from) * s.inverse;
  vec3 near = min(low, high);
  vec3 far = max(low, high);
  s.enter = max(max(max(near.x, near.y), near.z), 0.0);
  s.leave = min(min(min(far.x, far.y), far.z), 1.0);
  return s;
}

#endif
