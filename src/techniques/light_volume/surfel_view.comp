// Surfels as pictures, without any smoothing: every pixel shows the surfel of its own cell. kView 0: irradiance, 1:
// albedo, 2: red = 1 - validity, green = part of the 26 neighbours that it sees, blue = opacity.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/light_volume/surfel_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint kView = 0;
layout(set = 0, binding = 0) uniform sampler2D position;
layout(set = 0, binding = 1) uniform sampler2D normal;
layout(set = 0, binding = 2) readonly buffer TableBuffer { uint data[]; } table;
layout(set = 0, binding = 3) readonly buffer SurfelBuffer { Surfel data[]; } surfels;
layout(set = 0, binding = 4) readonly buffer LitBuffer { LitSurfel data[]; } lit;
layout(set = 0, binding = 5, rgba16f) writeonly uniform image2D view;

#include "techniques/light_volume/surfel.glsl"
#include "techniques/light_volume/surfel_home.glsl"

vec3 show(int slot) {
  switch (kView) {
    case 0: return lit.data[slot].irradiance;
    case 1: return unpack_albedo(surfels.data[slot].albedo);
    default:
      return vec3(1.0 - lit.data[slot].validity, float(bitCount(lit.data[slot].neighbours) - 1) / 26.0,
                  surfels.data[slot].opacity);
  }
}

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  vec4 p = texelFetch(position, ivec2(pixel), 0);
  vec3 n = texelFetch(normal, ivec2(pixel), 0).xyz;
  ivec3 cell;
  int slot = p.w > 0.0 ? home_slot(grid_coordinates(params.grid, p.xyz), n, cell) : -1;
  imageStore(view, ivec2(pixel), vec4(slot < 0 ? vec3(0.0) : show(slot), 1.0));
}
