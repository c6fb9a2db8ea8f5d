// The numbers of a light path. Needs light_paths_params.h; kernels declare, before including this file,
//   layout(set = 0, binding = n) readonly buffer SobolBuffer { uint data[]; } sobol_matrices;   // path_sequence.h
#ifndef LIGHTWELL_LIGHT_PATHS_SEQUENCE_GLSL
#define LIGHTWELL_LIGHT_PATHS_SEQUENCE_GLSL

#include "passes/light_paths/sobol_numbers.glsl"

layout(constant_id = 4) const uint kSequence = kSequenceSobol;

// The number that chooses a path's source. The Sobol sequence spends a dimension of the start on it, whose strips
// belong to the sources; the Halton sequence one of its own.
float source_number(uint index) {
  return kSequence == kSequenceHalton ? radical_inverse(2, index) : sobol_number(0, index);
}

// Where on the source, or in which direction. `place`: of source_number() in the source's strip.
vec2 start_numbers(uint index, float place) {
  if (kSequence == kSequenceHalton) return vec2(radical_inverse(3, index), radical_inverse(5, index));
  return vec2(place, sobol_number(1, index));
}

vec2 place_numbers(uint index) {
  if (kSequence == kSequenceHalton) return vec2(radical_inverse(7, index), radical_inverse(11, index));
  return vec2(sobol_number(2, index), sobol_number(3, index));
}

// Direction and roulette of the way to surface number params.bounce.
vec3 bounce_numbers(uint index) {
  if (kSequence == kSequenceHalton)
    return vec3(radical_inverse(params.bases.x, index), radical_inverse(params.bases.y, index),
                radical_inverse(params.bases.z, index));
  return sobol_bounce_numbers(index, params.bounce);
}

#endif
