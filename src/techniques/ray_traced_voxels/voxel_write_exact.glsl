// Exact means of what many invocations write, by plain atomic additions: sums of 64-bit fixed point in two words with a
// carry, and a count. Integers do not care for order, so the same samples give the same bytes; nobody waits for
// anybody; no count or sum that a frame can make overflows.
//
// Works on words of any buffer. The including kernel declares, before it includes this file,
//   uint exact_add(uint word, uint amount);   // atomicAdd() to a word of its sums: gives what was there
// A record is kExactWords words, all 0 at first: low words of red, green, blue; the count; high words of the three.
#ifndef LIGHTWELL_VOXEL_WRITE_EXACT_GLSL
#define LIGHTWELL_VOXEL_WRITE_EXACT_GLSL

const uint kExactWords = 8;
const uint kExactCount = 3;  // word of the count
const uint kExactHigh = 4;   // first of the high words

// Values are counted in units of 2^-27 of the range: what is 1e-4 of it is still rounded by no more than 4e-5 of itself.
// They are held at 2^13 ranges; 2^24 samples of that fit into a sum.
const float kExactUnits = 134217728.0;
const float kExactLargest = 1099511627776.0;

// 64-bit fixed point of three channels.
struct ExactSum {
  uvec3 low;
  uvec3 high;
};

ExactSum exact_sum(vec3 value, float range) {
  // Not a number becomes 0.
  vec3 units = value * (kExactUnits / range);
  units = mix(vec3(0.0), min(units, vec3(kExactLargest)), greaterThan(units, vec3(0.0)));
  vec3 high = floor(units * (1.0 / 4294967296.0));
  // Above 2^23 floats are whole numbers.
  vec3 low = units - high * 4294967296.0;
  low = mix(low, floor(low + 0.5), lessThan(low, vec3(8388608.0)));
  return ExactSum(uvec3(low), uvec3(high));
}

ExactSum exact_plus(ExactSum a, ExactSum b) {
  uvec3 carry;
  uvec3 low = uaddCarry(a.low, b.low, carry);
  return ExactSum(low, a.high + b.high + carry);
}

// Adds `count` samples of that sum to the record that begins at `first`.
void write_exact(uint first, ExactSum sum, uint count) {
  exact_add(first + kExactCount, count);
  for (uint k = 0; k < 3; ++k) {
    uint before = exact_add(first + k, sum.low[k]);
    uint high = sum.high[k] + (sum.low[k] > 0xffffffffu - before ? 1u : 0u);
    if (high != 0) exact_add(first + kExactHigh + k, high);
  }
}

// The mean of `count` > 0 samples.
vec3 exact_mean(ExactSum sum, uint count, float range) {
  return (vec3(sum.high) * 4294967296.0 + vec3(sum.low)) * (range / kExactUnits) / float(count);
}

#endif
