// Unit vectors as points of a square: the sphere's octants folded flat (Cigolle et al. 2014).
#ifndef LIGHTWELL_OCTAHEDRAL_GLSL
#define LIGHTWELL_OCTAHEDRAL_GLSL

// To [-1,1]^2.
vec2 to_octahedron(vec3 v) {
  vec2 p = v.xy / (abs(v.x) + abs(v.y) + abs(v.z));
  vec2 signs = vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  return v.z < 0.0 ? (1.0 - abs(p.yx)) * signs : p;
}

vec3 from_octahedron(vec2 p) {
  vec3 v = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  vec2 signs = vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  if (v.z < 0.0) v.xy = (1.0 - abs(p.yx)) * signs;
  return normalize(v);
}

#endif
