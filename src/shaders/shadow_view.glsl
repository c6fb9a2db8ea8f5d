// Projection into shadow maps, shared by the pass that draws them and by those that look up. No bindings.
#ifndef LIGHTWELL_SHADOW_VIEW_GLSL
#define LIGHTWELL_SHADOW_VIEW_GLSL

#include "shaders/lights.h"

// Turns a vector from the light into the view of one face of the cube: z is the distance along the face's axis.
// Faces: +x, -x, +y, -y, +z, -z.
vec3 to_cube_face(uint face, vec3 v) {
  switch (face) {
    case 0: return vec3(v.y, v.z, v.x);
    case 1: return vec3(v.y, v.z, -v.x);
    case 2: return vec3(v.z, v.x, v.y);
    case 3: return vec3(v.z, v.x, -v.y);
    case 4: return vec3(v.x, v.y, v.z);
    default: return vec3(v.x, v.y, -v.z);
  }
}

// The face that a vector from the light passes through.
uint cube_face(vec3 v) {
  vec3 a = abs(v);
  if (a.x >= a.y && a.x >= a.z) return v.x >= 0.0 ? 0 : 1;
  if (a.y >= a.z) return v.y >= 0.0 ? 2 : 3;
  return v.z >= 0.0 ? 4 : 5;
}

// Clip-space position in the light's view (`face` 0 unless it is a cube). Depth is reversed: 1 near, 0 far, so that
// floating point spends its precision evenly over distance.
vec4 shadow_clip(GpuLight light, uint face, vec3 position) {
  if (light.shadow_kind == kShadowCube) {
    return light.to_shadow * vec4(to_cube_face(face, position - light.position), 1.0);
  }
  return light.to_shadow * vec4(position, 1.0);
}

// How shadow_clip() changes along a world-space direction.
vec4 shadow_clip_direction(GpuLight light, uint face, vec3 direction) {
  if (light.shadow_kind == kShadowCube) return light.to_shadow * vec4(to_cube_face(face, direction), 0.0);
  return light.to_shadow * vec4(direction, 0.0);
}

#endif
