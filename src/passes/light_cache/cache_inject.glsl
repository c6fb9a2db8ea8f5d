// Adds irradiance to a face's sums. The including kernel declares
//   layout(set = 0, binding = n) buffer InjectedBuffer { uint data[]; } injected;
#ifndef LIGHTWELL_CACHE_INJECT_GLSL
#define LIGHTWELL_CACHE_INJECT_GLSL

uvec4 exact_add(uint face, uvec4 amounts) {
  uint word = face * kInjectWords;
  return uvec4(atomicAdd(injected.data[word], amounts.r), atomicAdd(injected.data[word + 1], amounts.g),
               atomicAdd(injected.data[word + 2], amounts.b), atomicAdd(injected.data[word + 3], amounts.a));
}

void exact_add_high(uint face, uvec3 amounts) {
  uint word = face * kInjectWords + 4;
  for (uint channel = 0; channel < 3; ++channel) atomicAdd(injected.data[word + channel], amounts[channel]);
}

#include "shaders/exact_sum.glsl"

void inject(uint face, vec3 irradiance) { write_exact(face, exact_sum(exact_units(irradiance, kInjectRange)), 1); }

// What was injected in one frame; clears it.
ExactSum take_injected(uint face, out uint count) {
  uint word = face * kInjectWords;
  ExactSum sum = ExactSum(uvec3(injected.data[word], injected.data[word + 1], injected.data[word + 2]),
                          uvec3(injected.data[word + 4], injected.data[word + 5], injected.data[word + 6]));
  count = injected.data[word + 3];
  for (uint i = 0; i < kInjectWords; ++i) injected.data[word + i] = 0;
  return sum;
}

#endif
