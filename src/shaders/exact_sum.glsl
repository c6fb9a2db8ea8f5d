// Exact means of what many invocations write, by plain atomic additions: sums of 64-bit fixed point in two words with a
// carry, and a count. Integers do not care for order, so the same samples give the same bytes; nobody waits for
// anybody; no count or sum that a frame can make overflows.
//
// Works on records of any buffers. A record is 4 + 3 words, all 0 at first. The including kernel declares, before it
// includes this file,
//   uvec4 exact_add(uint record, uvec4 amounts);      // atomicAdd() to red, green, blue and the count: what was there
//   void exact_add_high(uint record, uvec3 amounts);  // atomicAdd() to the high words of the three colours
#ifndef LIGHTWELL_EXACT_SUM_GLSL
#define LIGHTWELL_EXACT_SUM_GLSL

#include "shaders/software_drivers.glsl"

// Values are counted in units of 2^-27 of the range: what is 1e-4 of it is rounded by no more than 4e-5 of itself. They
// are held at 2^13 ranges; 2^24 samples of that fit into a sum.
const float kExactUnits = 134217728.0;
const float kExactLargest = 1099511627776.0;

// 64-bit fixed point of three channels.
struct ExactSum {
  uvec3 low;
  uvec3 high;
};

// A sample in units. Not a number becomes 0.
vec3 exact_units(vec3 value, float range) {
  vec3 units = value * (kExactUnits / range);
  return mix(vec3(0.0), min(units, vec3(kExactLargest)), greaterThan(units, vec3(0.0)));
}

ExactSum exact_sum(vec3 units) {
  vec3 high = floor(units * (1.0 / 4294967296.0));
  vec3 low = units - high * 4294967296.0;
  // Above 2^23 floats are whole numbers.
  low = mix(low, floor(low + 0.5), lessThan(low, vec3(8388608.0)));
  return ExactSum(uvec3(low), uvec3(high));
}

// Adds `count` samples to a record, of which this is the sum. Whoever adds some of them as floats first must do so in
// an order that is always the same. True for one of those who write the record: the first.
bool write_exact(uint record, ExactSum sum, uint count) {
  uvec4 before = exact_add(record, uvec4(sum.low, count));
  uvec3 high = sum.high + uvec3(greaterThan(sum.low, 0xffffffffu - before.rgb));
  for (uint i = 0; i < LW_ROUNDS_IF(high != uvec3(0), 1); ++i) exact_add_high(record, high);
  return before.a == 0;
}

// The mean of `count` > 0 samples.
vec3 exact_mean(ExactSum sum, uint count, float range) {
  return (vec3(sum.high) * 4294967296.0 + vec3(sum.low)) * (range / kExactUnits) / float(count);
}

#endif
