// Light from the lights on every surfel, and the radiance that it reflects: the first term of this frame's solution.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lights.h"
#include "shaders/shadow_view.h"
#include "techniques/light_volume/surfel_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer SurfelBuffer { Surfel data[]; } surfels;
layout(set = 0, binding = 2) readonly buffer LightBuffer { GpuLight data[]; } lights;
layout(set = 0, binding = 3) readonly buffer ShadowViewBuffer { ShadowView data[]; } shadow_views;
layout(set = 0, binding = 4) uniform sampler2D shadow_atlas;
layout(set = 0, binding = 5) readonly buffer IrradianceBuffer { vec4 data[]; } irradiance;  // last frame's, indirect
layout(set = 0, binding = 6) writeonly buffer DirectBuffer { vec4 data[]; } direct;
layout(set = 0, binding = 7) writeonly buffer RadianceBuffer { vec4 data[]; } radiance;

#include "shaders/direct.glsl"
#include "shaders/linear_dispatch.glsl"
#include "techniques/light_volume/surfel.glsl"
#include "techniques/light_volume/surfel_patch.glsl"

const uint kSamples = 4;

void main() {
  uint slot = linear_invocation();
  if (slot >= counts.data[kCountSurfels]) return;
  Surfel surfel = surfels.data[slot];
  vec3 e = vec3(0.0);
  vec3 leaving = vec3(0.0);
  if (surfel.normal != vec3(0.0)) {
    vec3 corner = vec3(key_cell(params.grid, surfel.key));
    for (uint i = 0; i < kSamples; ++i) {
      vec3 point = patch_point(surfel, corner, rotated_sample(surfel.key, i));
      vec3 world = params.grid.origin + params.grid.cell_size * point;
      e += direct_irradiance(world, surfel.normal, params.light_count) / float(kSamples);
    }
    leaving = unpack_albedo(surfel.albedo) / kPi * (e + irradiance.data[slot].xyz);
  }
  direct.data[slot] = vec4(e, 0.0);
  radiance.data[slot] = vec4(leaving, 0.0);
}
