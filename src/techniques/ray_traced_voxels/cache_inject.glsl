// Adds irradiance to a face's sums: plain additions of integers, so the order does not show in the result, no
// invocation waits for another, and nothing saturates. The including kernel declares
//   layout(set = 0, binding = n) buffer InjectedBuffer { uint data[]; } injected;
#ifndef LIGHTWELL_CACHE_INJECT_GLSL
#define LIGHTWELL_CACHE_INJECT_GLSL

void inject_channel(uint word, float value) {
  const float kWord = 4294967296.0;
  float scaled = floor(clamp(value * kInjectScale, 0.0, 1e18) + 0.5);
  float high = floor(scaled / kWord);
  uint low = uint(scaled - high * kWord);
  uint before = atomicAdd(injected.data[word], low);
  uint carry = before + low < before ? 1u : 0u;
  uint above = uint(high) + carry;
  if (above != 0) atomicAdd(injected.data[word + 1], above);
}

void inject(uint face, vec3 irradiance) {
  uint word = face * kInjectWords;
  for (uint channel = 0; channel < 3; ++channel) inject_channel(word + 2 * channel, irradiance[channel]);
  atomicAdd(injected.data[word + 6], 1);
}

#endif
