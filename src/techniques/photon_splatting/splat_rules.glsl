// What splats light.
#ifndef LIGHTWELL_SPLAT_RULES_GLSL
#define LIGHTWELL_SPLAT_RULES_GLSL

// Least cosine between the normals of the surface that a splat ends on and of another that it lights.
const float kLeastLikeness = 0.6;
// Farthest from the plane of that surface, half widths.
const float kMostOff = 0.5;

// Whether a cone of directions about the unit `axis` holds one whose cosine to the unit `v` is at least `least`.
bool cone_meets(vec3 axis, float cone_cosine, vec3 v, float least) {
  float angle = acos(clamp(dot(axis, v), -1.0, 1.0));
  return angle <= acos(clamp(cone_cosine, -1.0, 1.0)) + acos(least) + 1e-3;
}

#endif
