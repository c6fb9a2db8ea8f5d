// The numbers of a light path. Needs light_paths_params.h.
#ifndef LIGHTWELL_LIGHT_PATHS_SEQUENCE_GLSL
#define LIGHTWELL_LIGHT_PATHS_SEQUENCE_GLSL

#include "shaders/random.glsl"

layout(constant_id = 4) const uint kSequence = kSequenceSobol;

// Pairs of dimensions of the Sobol sequence. Bounce b has 2 b and 2 b + 1; the first bounce's are these:
const uint kSetStart = 0;  // source and where on it, or in which direction
const uint kSetPlace = 1;

// The number that chooses a path's source. The Sobol sequence spends a dimension of the start on it, whose strips belong
// to the sources; the Halton sequence one of its own.
float source_number(uint index) {
  return kSequence == kSequenceHalton ? radical_inverse(2, index) : padded_point(index, kSetStart).x;
}

// `place`: of source_number() in the source's strip.
vec2 start_numbers(uint index, float place) {
  if (kSequence == kSequenceHalton) return vec2(radical_inverse(3, index), radical_inverse(5, index));
  return vec2(place, padded_point(index, kSetStart).y);
}

vec2 place_numbers(uint index) {
  if (kSequence == kSequenceHalton) return vec2(radical_inverse(7, index), radical_inverse(11, index));
  return padded_point(index, kSetPlace);
}

// Direction and roulette of the way to surface number params.bounce.
vec3 bounce_numbers(uint index) {
  if (kSequence == kSequenceHalton)
    return vec3(radical_inverse(params.bases.x, index), radical_inverse(params.bases.y, index),
                radical_inverse(params.bases.z, index));
  return vec3(padded_point(index, 2 * params.bounce), padded_point(index, 2 * params.bounce + 1).x);
}

#endif
