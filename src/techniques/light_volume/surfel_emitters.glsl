// Points on emitting surfels, chosen in proportion to power. The including kernel declares `counts`, `surfels` and
//   layout(set = 0, binding = n) readonly buffer EmitterBuffer { SurfelEmitter data[]; } emitters;
// and includes surfel.glsl.
#ifndef LIGHTWELL_SURFEL_EMITTERS_GLSL
#define LIGHTWELL_SURFEL_EMITTERS_GLSL

#include "techniques/light_volume/surfel_near.glsl"
#include "techniques/light_volume/surfel_patch.glsl"

// A point on an emitter as a surfel at `origin` sees it.
struct EmitterSample {
  vec3 direction;   // to it, unit
  float distance;   // cells
  vec3 irradiance;  // of the whole scene's emitters, if all were like this point and nothing in between; 0: of no use
};

// First emitter at which the power so far exceeds `power`.
uint find_emitter(float power) {
  uint low = 0;
  uint high = counts.data[kCountEmitters] - 1;
  for (int i = 0; i < 21 && low < high; ++i) {
    uint middle = (low + high) / 2;
    if (emitters.data[middle].power_so_far > power) high = middle;
    else low = middle + 1;
  }
  return low;
}

// Sample k of kEmitterSamples of the surfel with `key`. With p the emitter's part of all power and A its area,
//   E = Le cos_here cos_there A / (p d^2).
EmitterSample sample_emitter(VoxelGrid grid, uint key, vec3 origin, vec3 normal, uint k) {
  uint last = counts.data[kCountEmitters] - 1;
  float all_power = emitters.data[last].power_so_far;
  uint index = find_emitter(rotated_sample(key, k).x * all_power);
  float power = emitters.data[index].power_so_far - (index == 0 ? 0.0 : emitters.data[index - 1].power_so_far);
  Surfel emitter = surfels.data[emitters.data[index].slot];
  vec3 point = patch_point(emitter, vec3(key_cell(grid, emitter.key)), rotated_sample(key ^ 0x55555555u, k));
  vec3 line = point - origin;
  EmitterSample result;
  result.distance = length(line);
  result.direction = line / max(result.distance, 1e-6);
  result.irradiance = vec3(0.0);
  float cos_here = dot(normal, result.direction);
  float cos_there = -dot(emitter.normal, result.direction);
  if (result.distance >= near_emitters() && cos_here > 0.0 && cos_there > 0.0 && power > 0.0)
    result.irradiance = emitter.emission * (cos_here * cos_there * emitter.area * all_power /
                                            (power * result.distance * result.distance));
  return result;
}

#endif
