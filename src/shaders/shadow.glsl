// Shadow-map lookup. The including kernel declares
//   layout(set = 0, binding = n) uniform sampler2D shadow_atlas;   // D32, bound with SamplerKind::kNearestClamp
#ifndef LIGHTWELL_SHADOW_GLSL
#define LIGHTWELL_SHADOW_GLSL

#include "shaders/shadow_view.glsl"

// Bias along the light's view, in shadow texels. The receiver's plane is evaluated at each texel's own centre, so this
// covers only shading normals that differ from the true plane.
const float kShadowBiasTexels = 1.5;
const float kShadowMaximumSlope = 1000.0;  // of the receiver's plane against the shadow map, depth over width; where
                                           // it is more, hardly any light arrives

// Gradient of shadow depth over shadow NDC on the plane through `clip` perpendicular to `normal`.
// (Isidoro 2006, receiver-plane depth bias; here from the plane itself and not from screen derivatives. Depth of a plane
// is linear over NDC in perspective views too.)
vec2 receiver_gradient(ShadowView view, uint face, vec4 clip, vec3 normal) {
  vec3 ndc = clip.xyz / clip.w;
  vec3 tangent = normalize(abs(normal.x) > 0.5 ? cross(normal, vec3(0, 1, 0)) : cross(normal, vec3(1, 0, 0)));
  vec4 clip_t = shadow_clip_direction(view, face, tangent);
  vec4 clip_b = shadow_clip_direction(view, face, cross(normal, tangent));
  vec3 dt = clip_t.xyz - ndc * clip_t.w;
  vec3 db = clip_b.xyz - ndc * clip_b.w;
  float det = dt.x * db.y - dt.y * db.x;
  if (abs(det) < 1e-30) return vec2(0.0);  // in scenes of 1e9 m it is 1e-18
  return vec2(dt.z * db.y - dt.y * db.z, dt.x * db.z - dt.z * db.x) / det;
}

// Fraction of the light that reaches `position` on a surface with unit `normal` (towards the light's side): percentage
// closer filtering (Reeves et al. 1987) over 4x4 texels, weighted with a box of 3 texels round the exact position.
float shadow_visibility(ShadowView view, vec3 position, vec3 normal) {
  if (view.kind == kShadowNone) return 1.0;
  uint face = shadow_face(view, position);
  vec4 clip = shadow_clip(view, face, position);
  if (clip.w <= 0.0) return 1.0;
  vec3 ndc = clip.xyz / clip.w;

  // Position in the tile in texels; everything outside is lit (a view that is fitted to the scene holds all of it).
  float side = float(view.tile_side);
  vec2 texel = (ndc.xy * 0.5 + 0.5) * side;
  if (any(lessThan(texel, vec2(2.0))) || any(greaterThan(texel, vec2(side - 2.0)))) return 1.0;
  vec2 base = floor(texel - 1.5);       // first of the 4x4 texels
  vec2 fraction = texel - 1.5 - base;   // of a texel

  // Depth per metre along the view, then the bias and the plane's slope in depth units. A perspective view's depth is
  // a / w + b, with b in its third row; a directional one's is linear.
  bool ortho = view.kind == kShadowOrthographic;
  vec3 depth_row = vec3(view.to_shadow[0][2], view.to_shadow[1][2], view.to_shadow[2][2]);
  vec3 w_row = vec3(view.to_shadow[0][3], view.to_shadow[1][3], view.to_shadow[2][3]);
  float depth_per_metre = ortho ? length(depth_row) : (ndc.z - dot(depth_row, w_row)) / clip.w;
  float texel_world = view.texel_size * (ortho ? 1.0 : clip.w);
  float bias = kShadowBiasTexels * texel_world * depth_per_metre;
  float slope_limit = kShadowMaximumSlope * texel_world * depth_per_metre;
  vec2 gradient = receiver_gradient(view, face, clip, normal) * (2.0 / side);  // per texel
  gradient *= min(1.0, slope_limit / max(length(gradient), 1e-20));

  vec2 origin = vec2(view.tile + view.tile_side * uvec2(face % 3, face / 3)) + base;
  vec2 to_uv = 1.0 / vec2(textureSize(shadow_atlas, 0));

  float lit = 0.0;
  for (int j = 0; j < 4; j += 2) {
    for (int i = 0; i < 4; i += 2) {
      // Depths of texels (i, j+1), (i+1, j+1), (i+1, j), (i, j), and the receiver's own there.
      vec4 stored = textureGather(shadow_atlas, (origin + vec2(i + 1, j + 1)) * to_uv);
      vec4 dx = vec4(i, i + 1, i + 1, i) + 0.5 + base.x - texel.x;
      vec4 dy = vec4(j + 1, j + 1, j, j) + 0.5 + base.y - texel.y;
      // Where the plane falls away from the light, its extension would lie behind what it meets there (a wall's foot
      // goes on under the floor): the receiver's own depth is then as far as a blocker is looked for.
      vec4 receiver = ndc.z + max(gradient.x * dx + gradient.y * dy, vec4(0.0)) + bias;
      vec4 visible = vec4(greaterThanEqual(receiver, stored));
      vec2 wx = vec2(i == 0 ? 1.0 - fraction.x : 1.0, i == 0 ? 1.0 : fraction.x);
      vec2 wy = vec2(j == 0 ? 1.0 - fraction.y : 1.0, j == 0 ? 1.0 : fraction.y);
      lit += dot(visible, wx.xyyx * wy.yyxx);
    }
  }
  return lit / 9.0;
}

#endif
