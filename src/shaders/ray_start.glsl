// Origins of rays that leave a surface.
#ifndef LIGHTWELL_RAY_START_GLSL
#define LIGHTWELL_RAY_START_GLSL

// Where a ray starts that leaves the surface at `position` on the side of the unit `face_normal`: rounding of the
// position grows with its coordinates, not with the distance from which it was seen.
vec3 ray_start(vec3 position, vec3 face_normal) {
  const float kRelativeClearance = 64.0 / 16777216.0;
  return position + face_normal * (kRelativeClearance * max(max(abs(position.x), abs(position.y)), abs(position.z)) + 1e-7);
}

#endif
