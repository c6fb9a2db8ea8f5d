// What a texel of a reflective shadow map stands for. No bindings.
#ifndef LIGHTWELL_RSM_VIEW_GLSL
#define LIGHTWELL_RSM_VIEW_GLSL

#include "shaders/lights.glsl"
#include "shaders/shadow_view.glsl"

// The inverse of to_cube_face().
vec3 from_cube_face(uint face, vec3 v) {
  switch (face) {
    case 0: return vec3(v.z, v.x, v.y);
    case 1: return vec3(-v.z, v.x, v.y);
    case 2: return vec3(v.y, v.z, v.x);
    case 3: return vec3(v.y, -v.z, v.x);
    case 4: return v;
    default: return vec3(v.x, v.y, -v.z);
  }
}

// Row of a view's matrix, without its offset.
vec3 view_row(ShadowView view, uint row) {
  return vec3(view.to_shadow[0][row], view.to_shadow[1][row], view.to_shadow[2][row]);
}

// Half the width and height of a view: tangents for perspective views and cubes, m for directional ones.
vec2 view_half_size(ShadowView view) { return 1.0 / vec2(length(view_row(view, 0)), length(view_row(view, 1))); }

// The vector across a view of its NDC coordinates x and y, in world space.
vec3 across_view(ShadowView view, uint face, vec2 ndc) {
  vec3 x = view_row(view, 0);
  vec3 y = view_row(view, 1);
  vec3 across = ndc.x * x / dot(x, x) + ndc.y * y / dot(y, y);
  return view.kind == kShadowCube ? from_cube_face(face, across) : across;
}

// From the light through a point of the view; not unit: its component along a perspective view is 1.
vec3 view_direction(ShadowView view, GpuLight light, uint face, vec2 ndc) {
  if (view.kind == kShadowOrthographic) return light.direction;
  vec3 forward = view.kind == kShadowCube ? from_cube_face(face, vec3(0.0, 0.0, 1.0)) : view_row(view, 3);
  return forward + across_view(view, face, ndc);
}

// Flux (W) that the light sends through a texel. Perspective views: the integral of I over the texel's solid angle
// dw = dx dy / |(x, y, 1)|^3, with Gauss' rule of 2 x 2 points: of 32 x 32 texels over a cube's face its error is below
// 1e-5, and at the edge of a cone, which crosses texels, a quarter of the midpoint's.
// Directional: E dA.
vec3 texel_flux(ShadowView view, GpuLight light, uint face, vec2 ndc) {
  vec2 texel = 2.0 * view_half_size(view) / float(view.tile_side);
  float area = texel.x * texel.y;
  if (view.kind == kShadowOrthographic) return light.intensity * area;
  const float kGauss = 0.577350269;
  float offset = kGauss / float(view.tile_side);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    vec2 place = ndc + offset * vec2((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0);
    vec3 v = view_direction(view, light, face, place);
    float inverse = inversesqrt(dot(v, v));
    sum += light_intensity(light, v * inverse) * (inverse * inverse * inverse);
  }
  return sum * (0.25 * area);
}

// Upper left texel of a face's tile in the atlas.
uvec2 tile_corner(ShadowView view, uint face) { return view.tile + view.tile_side * uvec2(face % 3, face / 3); }

uint view_face_count(ShadowView view) {
  return view.kind == kShadowNone ? 0 : view.kind == kShadowCube ? 6 : 1;
}

#endif
