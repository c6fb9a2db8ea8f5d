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

// Clip-space position in one of a light's views: a cube's face, or 0 for the fine and 1 for the coarse view. Depth is
// reversed: 1 near, 0 far, so that floating point spends its precision evenly over distance.
vec4 shadow_clip(ShadowView view, uint face, vec3 position) {
  if (view.kind == kShadowCube) {
    return view.to_shadow * vec4(to_cube_face(face, position - view.position), 1.0);
  }
  vec4 clip = view.to_shadow * vec4(position, 1.0);
  if (face == 1) clip.xy = clip.xy * view.coarse.xy + view.coarse.zw;
  return clip;
}

// How shadow_clip() changes along a world-space direction.
vec4 shadow_clip_direction(ShadowView view, uint face, vec3 direction) {
  if (view.kind == kShadowCube) return view.to_shadow * vec4(to_cube_face(face, direction), 0.0);
  vec4 clip = view.to_shadow * vec4(direction, 0.0);
  if (face == 1) clip.xy *= view.coarse.xy;
  return clip;
}

// The view in which a position is looked up.
uint shadow_face(ShadowView view, vec3 position) {
  if (view.kind == kShadowCube) return cube_face(position - view.position);
  if (view.kind != kShadowNested) return 0;
  vec2 fine = abs(shadow_clip(view, 0, position).xy);
  return max(fine.x, fine.y) < 1.0 - float(2 * kShadowGuard) / float(view.tile_side) ? 0 : 1;
}

#endif
