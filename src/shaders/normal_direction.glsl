// Normals by the axis they are closest to.
#ifndef LIGHTWELL_NORMAL_DIRECTION_GLSL
#define LIGHTWELL_NORMAL_DIRECTION_GLSL

// The direction of a normal: 2 * axis of the largest component, + 1 where that is negative.
uint normal_direction(vec3 normal) {
  vec3 size = abs(normal);
  uint axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return 2 * axis + (normal[axis] < 0.0 ? 1 : 0);
}

#endif
