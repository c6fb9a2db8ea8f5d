// NaN/Inf check on the bits: drivers may assume in arithmetic that there are neither.
#ifndef LIGHTWELL_FINITE_GLSL
#define LIGHTWELL_FINITE_GLSL

bool is_finite(vec3 v) {
  return all(notEqual(floatBitsToUint(v) & 0x7f800000u, uvec3(0x7f800000u)));
}

#endif
