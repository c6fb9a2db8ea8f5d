// Running sums of the sources' power, by which paths choose among them: of lights with maps what they reflect, of
// others what they send towards the scene times an albedo that is guessed. Always added in the same order. One
// workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/emitters/emitters_types.h"
#include "passes/light_paths/light_paths_params.h"
#include "shaders/lights.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kEnvironment = kSkyBlack;
layout(constant_id = 1) const bool kGuided = false;
layout(set = 0, binding = 0) readonly buffer LightBuffer { GpuLight data[]; } lights;
layout(set = 0, binding = 1) readonly buffer PowerBuffer { float data[]; } map_powers;
layout(set = 0, binding = 2) readonly buffer GroupBuffer { EmitterGroup data[]; } groups;
layout(set = 0, binding = 3) readonly buffer EnvironmentTableBuffer { float data[]; } environment_table;
layout(set = 0, binding = 4) uniform sampler2D environment;
layout(set = 0, binding = 5) writeonly buffer SourceBuffer { float data[]; } sources;
layout(set = 0, binding = 6) readonly buffer GuideBuffer { float data[]; } guide;

#include "passes/light_paths/aimed_rays.glsl"
#include "passes/light_paths/guide.glsl"
#include "passes/light_paths/light_rays.glsl"
#include "shaders/environment.glsl"
#include "shaders/environment_table.glsl"
#include "shaders/finite.glsl"
#include "shaders/luminance.glsl"
#include "shaders/random.glsl"

const float kGuessedAlbedo = 0.5;

shared float slices[64];
shared vec2 guided_slices[64];  // power times importance, power

// The integral of the environment's luminance over all directions, by one of 64 samples of it.
float sample_sky(uint index) {
  if (kEnvironment == kSkyBlack) return 0.0;
  if (kEnvironment == kSkyConstant) return 4.0 * kPi * luminance(environment_radiance(vec3(0.0, 1.0, 0.0)));
  EnvironmentSample sampled = sample_environment(params.table_size, padded_point(index, 0));
  return sampled.density > 0.0 ? luminance(environment_radiance(sampled.direction)) / sampled.density : 0.0;
}

float source_power(uint source, float sky) {
  float power = 0.0;
  if (source < params.light_count) {
    float reflected = map_powers.data[source];
    power = reflected >= 0.0 ? reflected : kGuessedAlbedo * luminance(light_flux(lights.data[source]));
  } else if (source == params.light_count) {
    uint group_count = (params.emitter_count + kEmitterGroup - 1) / kEmitterGroup;
    if (group_count > 0) power = kGuessedAlbedo * kPi * groups.data[group_count].power_before;
  } else {
    // A convex body's mean projected area is a quarter of its surface.
    vec3 extent = params.high - params.low;
    float area = 0.5 * (extent.x * extent.y + extent.y * extent.z + extent.z * extent.x);
    power = kGuessedAlbedo * sky * parallel_area(area);
  }
  return is_finite(vec3(power)) ? clamp(power, 0.0, 1e30) : 0.0;
}

float guided_power(uint source, float sky, vec2 mixture) {
  float power = source_power(source, sky);
  return kGuided ? power * (mixture.x * guide_mean(source) + mixture.y) : power;
}

// Of all sources by their power. Called by all invocations.
float mean_importance(uint slice, uint begin, uint end, float sky) {
  vec2 sums = vec2(0.0);
  for (uint i = begin; i < end; ++i) sums += source_power(i, sky) * vec2(guide_mean(i), 1.0);
  guided_slices[slice] = sums;
  barrier();
  sums = vec2(0.0);
  for (uint i = 0; i < 64; ++i) sums += guided_slices[i];
  return sums.y > 0.0 ? sums.x / sums.y : 0.0;
}

void main() {
  uint slice = gl_LocalInvocationID.x;
  slices[slice] = sample_sky(slice) / 64.0;
  barrier();
  float sky = 0.0;
  for (uint i = 0; i < 64; ++i) sky += slices[i];
  barrier();
  uint count = params.light_count + 2;
  uint length = (count + 63) / 64;
  uint begin = min(slice * length, count);
  uint end = min(begin + length, count);
  // With a guide, sources count by their importance, too; its mean over their power comes last.
  vec2 mixture = vec2(0.0, 1.0);
  if (kGuided) {
    float mean = mean_importance(slice, begin, end, sky);
    mixture = guide_mixture(mean);
    if (slice == 0) sources.data[count] = mean;
  }
  float sum = 0.0;
  for (uint i = begin; i < end; ++i) sum += guided_power(i, sky, mixture);
  slices[slice] = sum;
  barrier();
  sum = 0.0;
  for (uint i = 0; i < slice; ++i) sum += slices[i];
  for (uint i = begin; i < end; ++i) {
    sum += guided_power(i, sky, mixture);
    sources.data[i] = sum;
  }
}
