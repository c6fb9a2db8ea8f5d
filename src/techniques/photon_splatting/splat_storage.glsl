// Splats in memory: StoredSplat, 32 bytes. Kernels declare one of
//   LW_SPLATS_READ(0, 0)                 // splat_at(i)
//   LW_SPLATS_WRITE(0, 0)                // store_splat(i, splat)
//   LW_SPLATS_READ_WRITE(restrict, 0, 0)
// What is stored differs from what was given: directions by less than 1e-4, half widths by 0.2 %; reaches grow by up to
// 0.4 %; photons beyond 511 differ by 0.2 %. Flux is rounded up or down at random, by 1/512 of its brightest channel at
// most, so that sums of it are right. What is read and stored again stays the same.
#ifndef LIGHTWELL_PHOTON_SPLATTING_SPLAT_STORAGE_GLSL
#define LIGHTWELL_PHOTON_SPLATTING_SPLAT_STORAGE_GLSL

#include "shaders/finite.glsl"
#include "shaders/light_point.glsl"
#include "shaders/paged_buffer.glsl"
#include "shaders/random.glsl"
#include "techniques/photon_splatting/splat_types.h"

// Not negative.
float short_to_float(uint bits) { return uintBitsToFloat((bits & 0xffffu) << 15); }
uint nearest_short(float x) { return (floatBitsToUint(clamp(x, 0.0, 1e38)) + 0x4000u) >> 15; }
uint next_short(float x) { return (floatBitsToUint(clamp(x, 0.0, 1e38)) + 0x7fffu) >> 15; }

// Up to 511 exactly, up to 511 * 2^14 with 9 bits.
uint pack_count(uint count) {
  uint shift = uint(max(findMSB(count) - 8, 0));
  count += (1u << shift) >> 1;
  shift += (count >> shift) >> 9;
  uint mantissa = (count >> shift) & 0xffu;
  return count < 256u ? count : (min(shift + 1, 15u) << 8) | mantissa;
}

uint unpack_count(uint packed) {
  uint exponent = (packed >> 8) & 15u;
  uint mantissa = packed & 0xffu;
  return exponent == 0 ? mantissa : (256u | mantissa) << (exponent - 1);
}

Splat unpack_splat(StoredSplat stored, uint index) {
  float unit = uintBitsToFloat((max(stored.parts & 0xffu, 10u) - 9u) << 23);
  vec3 flux = unit * vec3(stored.colors & 1023u, (stored.colors >> 10) & 1023u, (stored.colors >> 20) & 1023u);
  return Splat(stored.center, short_to_float(stored.lengths), unpack_unit_vector(stored.direction),
               short_to_float(stored.lengths >> 16), flux, float(unpack_count(stored.parts >> 19)),
               float((stored.parts >> 8) & 2047u) / 1024.0, index, stored.normal);
}

StoredSplat pack_splat(Splat splat, uint index) {
  float most = max(max(splat.flux.r, splat.flux.g), splat.flux.b);
  uint exponent = 10u;  // of the unit, plus 9
  uvec3 colors = uvec3(0);
  if (is_finite(splat.flux) && most > 0.0) {
    exponent = clamp(floatBitsToUint(most) >> 23, 10u, 253u);
    float per_unit = uintBitsToFloat((263u - exponent) << 23);
    if (most * per_unit > 1023.0) {
      ++exponent;
      per_unit *= 0.5;
    }
    uint random = hash_word(index ^ hash_word(floatBitsToUint(splat.center.x)));
    vec3 up = (vec3(random & 1023u, (random >> 10) & 1023u, (random >> 20) & 1023u) + 0.5) / 1024.0;
    colors = min(uvec3(max(splat.flux, vec3(0.0)) * per_unit + up), uvec3(1023));
  }
  uint accepted = uint(clamp(splat.accepted, 0.0, 1.0) * 1024.0 + 0.5);
  return StoredSplat(splat.center, pack_unit_vector(splat.direction), splat.normal,
                     nearest_short(splat.half_width) | (next_short(splat.reach) << 16),
                     colors.r | (colors.g << 10) | (colors.b << 20),
                     exponent | (accepted << 8) | (pack_count(uint(splat.photons)) << 19));
}

#define LW_SPLATS_READ(set_number, binding_number)                 \
  LW_PAGED_READ(set_number, binding_number, StoredSplat, splats)   \
  Splat splat_at(uint index) { return unpack_splat(splats_at(index), index); }

#define LW_SPLATS_WRITE(set_number, binding_number)                \
  LW_PAGED_WRITE(set_number, binding_number, StoredSplat, splats)  \
  void store_splat(uint index, Splat splat) { splats_store(index, pack_splat(splat, index)); }

#define LW_SPLATS_READ_WRITE(qualifier, set_number, binding_number)                 \
  LW_PAGED_READ_WRITE(qualifier, set_number, binding_number, StoredSplat, splats)   \
  Splat splat_at(uint index) { return unpack_splat(splats_at(index), index); }      \
  void store_splat(uint index, Splat splat) { splats_store(index, pack_splat(splat, index)); }

#endif
