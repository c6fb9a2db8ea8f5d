// Points on surfels. The including kernel includes surfel.glsl.
#ifndef LIGHTWELL_SURFEL_PATCH_GLSL
#define LIGHTWELL_SURFEL_PATCH_GLSL

// A point of the patch: anywhere in its bounds seen along the direction's axis, and on the plane.
vec3 patch_point(Surfel surfel, vec3 corner, vec2 u) {
  uint axis = key_direction(surfel.key) / 2;
  uint b = (axis + 1) % 3;
  uint c = (axis + 2) % 3;
  vec3 low = corner + unpack_10(surfel.bounds_low);
  vec3 high = corner + unpack_10(surfel.bounds_high);
  vec3 point = surfel.position;
  point[b] = mix(low[b], high[b], u.x);
  point[c] = mix(low[c], high[c], u.y);
  float rise = surfel.normal[b] * (point[b] - surfel.position[b]) + surfel.normal[c] * (point[c] - surfel.position[c]);
  point[axis] = clamp(surfel.position[axis] - rise / surfel.normal[axis], low[axis], high[axis]);
  return point;
}

#endif
