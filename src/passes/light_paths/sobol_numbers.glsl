// Numbers of the Sobol sequence that light paths take. Kernels declare, before including this file,
//   layout(set = 0, binding = n) readonly buffer SobolBuffer { uint data[]; } sobol_matrices;   // path_sequence.h
#ifndef LIGHTWELL_LIGHT_PATHS_SOBOL_NUMBERS_GLSL
#define LIGHTWELL_LIGHT_PATHS_SOBOL_NUMBERS_GLSL

#include "passes/light_paths/light_path_dimensions.h"
#include "shaders/random.glsl"

// One dimension of the Owen-scrambled Sobol sequence.
float sobol_number(uint dimension, uint index) {
  uint digits = 0;
  for (uint i = 32 * dimension; index != 0; index >>= 1) digits ^= sobol_matrices.data[i++] * (index & 1u);
  return float(bitfieldReverse(scramble_reversed(digits, hash_word(dimension + 1))) >> 8) * (1.0 / 16777216.0);
}

// Of path `index`: direction and roulette of the way to surface number `surface`, 2 at least.
vec3 sobol_bounce_numbers(uint index, uint surface) {
  uint dimension = 4 + 3 * (surface - 2);
  if (dimension + 3 <= kJointDimensions)
    return vec3(sobol_number(dimension, index), sobol_number(dimension + 1, index), sobol_number(dimension + 2, index));
  return vec3(padded_point(index, 2 * surface), padded_point(index, 2 * surface + 1).x);
}

#endif
