// How many invocations write one voxel: the three ways of Magalhaes 2020 (sections 3.2.5.4 and 4.2.5.3), for any buffer
// of one word a voxel. Values are in [0,1]. The fourth way, ours, is in voxel_write_exact.glsl.
//
//   layout(set = 0, binding = n) buffer IrradianceBuffer { uint data[]; } irradiance;
//   LW_VOXEL_WRITER(irradiance)   // void write_irradiance(uint voxel, vec3 value)
#ifndef LIGHTWELL_VOXEL_WRITE_GLSL
#define LIGHTWELL_VOXEL_WRITE_GLSL

#include "techniques/ray_traced_voxels/paper_types.h"

layout(constant_id = 1) const uint kWriter = kWriteAverage;  // not kWriteExact

// One sample: red in the lowest byte, alpha 1/255 (listing 4.1).
uint pack_sample(vec3 value) { return packUnorm4x8(vec4(value, 1.0 / 255.0)); }

// The word after one more sample. The mean is rounded to 8 bits every time and the count stays at 255, as published:
// from then on a sample that differs from the mean by less than half of it changes nothing.
uint add_to_average(uint word, vec3 value) {
  vec4 old = unpackUnorm4x8(word);
  float count = round(old.a * 255.0);
  return packUnorm4x8(vec4((old.rgb * count + value) / (count + 1.0), (count + 1.0) / 255.0));
}

// A try fails only where somebody else's has succeeded meanwhile. The published loop has no end; here a sample is given
// up after so many tries, more than a device runs invocations at a time.
const uint kMostTries = 1u << 20;

#define LW_VOXEL_WRITER(name)                                        \
  void write_##name(uint voxel, vec3 value) {                        \
    uint word = pack_sample(value);                                  \
    if (kWriter == kWriteNone) {                                     \
      name.data[voxel] = word;                                       \
    } else if (kWriter == kWriteMaximum) {                           \
      atomicMax(name.data[voxel], word);                             \
    } else {                                                         \
      uint expected = 0;                                             \
      uint found = atomicCompSwap(name.data[voxel], expected, word); \
      for (uint i = 0; i < kMostTries && found != expected; ++i) {   \
        expected = found;                                            \
        word = add_to_average(expected, value);                      \
        found = atomicCompSwap(name.data[voxel], expected, word);    \
      }                                                              \
    }                                                                \
  }

#endif
