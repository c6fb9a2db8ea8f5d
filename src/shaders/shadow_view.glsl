// Projection into shadow maps, shared by the pass that draws them and by those that look up. No bindings.
#ifndef LIGHTWELL_SHADOW_VIEW_GLSL
#define LIGHTWELL_SHADOW_VIEW_GLSL

#include "shaders/shadow_view.h"

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

// Clip-space position in a view, of a cube in one of its faces. Depth is reversed: 1 near, 0 far, so that floating
// point spends its precision evenly over distance.
vec4 shadow_clip(ShadowView view, uint face, vec3 position) {
  if (view.kind == kShadowCube) {
    return view.to_shadow * vec4(to_cube_face(face, position - view.position), 1.0);
  }
  return view.to_shadow * vec4(position, 1.0);
}

// How shadow_clip() changes along a world-space direction.
vec4 shadow_clip_direction(ShadowView view, uint face, vec3 direction) {
  if (view.kind == kShadowCube) return view.to_shadow * vec4(to_cube_face(face, direction), 0.0);
  return view.to_shadow * vec4(direction, 0.0);
}

// The face in which a position is looked up.
uint shadow_face(ShadowView view, vec3 position) {
  return view.kind == kShadowCube ? cube_face(position - view.position) : 0;
}

// Whether a filter about `position` stays in the view's tile; not of cubes.
bool is_within(ShadowView view, vec3 position) {
  vec4 clip = shadow_clip(view, 0, position);
  float usable = 1.0 - float(2 * kShadowGuard) / float(view.tile_side);
  return max(abs(clip.x), abs(clip.y)) < usable * clip.w;
}

#endif
