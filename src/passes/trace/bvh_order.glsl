// Floats as unsigned integers of the same order, for atomic minima and maxima.
#ifndef LIGHTWELL_BVH_ORDER_GLSL
#define LIGHTWELL_BVH_ORDER_GLSL

uint to_ordered(float x) {
  uint bits = floatBitsToUint(x);
  return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

float from_ordered(uint x) { return uintBitsToFloat((x & 0x80000000u) != 0 ? x & 0x7fffffffu : ~x); }

#endif
