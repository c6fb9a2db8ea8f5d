// The part of the kernel whose texels met the surface of the splat's center. Where none did, surfaces are finer than
// texels: the splat shrinks to where its own ray met one, and its map is the plane there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/light_point.h"
#include "techniques/photon_splatting/photon_params.h"
#include "techniques/photon_splatting/splat_storage.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kKernel = 0;
LW_SPLATS_READ_WRITE(restrict, 0, 0)
layout(set = 0, binding = 1) readonly buffer SplatCountBuffer { uint data[]; } splat_counts;
layout(set = 0, binding = 2, r32f) uniform image2D shadow_atlas;

#include "shaders/light_point.glsl"
#include "shaders/linear_dispatch.glsl"
#include "techniques/photon_splatting/shadow_atlas.glsl"
#include "techniques/photon_splatting/splat_kernel.glsl"

// The kernel's integral over a texel, in any unit: by two points of Gauss' rule an axis.
float texel_weight(ivec2 texel, uint side) {
  float off = inversesqrt(3.0) / float(side);
  vec2 place = texel_place(texel, side);
  return kernel_weight(place + vec2(-off, -off)) + kernel_weight(place + vec2(off, -off)) +
         kernel_weight(place + vec2(-off, off)) + kernel_weight(place + vec2(off, off));
}

float accepted_part(ivec2 corner, uint side) {
  float lit = 0.0;
  float all = 0.0;
  for (uint i = 0; i < side * side; ++i) {
    ivec2 texel = ivec2(i % side, i / side);
    float weight = texel_weight(texel, side);
    all += weight;
    if (imageLoad(shadow_atlas, corner + texel).x > 0.0) lit += weight;
  }
  return lit / all;
}

void store_plane(Splat splat, ivec2 corner, uint side) {
  const float kLeastCosine = 0.15;
  vec3 normal = unpack_unit_vector(splat.normal);
  float cosine = max(-dot(normal, splat.direction), kLeastCosine);
  for (uint i = 0; i < side * side; ++i) {
    ivec2 texel = ivec2(i % side, i / side);
    vec3 across = across_splat(splat, texel_place(texel, side)) - splat.center;
    float depth = clamp(splat.reach + dot(across, normal) / cosine, 1e-3 * splat.reach, 2.0 * splat.reach);
    imageStore(shadow_atlas, corner + texel, vec4(depth));
  }
}

void main() {
  uint index = linear_invocation();
  if (index >= splat_counts.data[kSplatsInUse]) return;
  Splat splat = splat_at(index);
  if (splat.flux == vec3(0.0)) return;
  uint side = params.map_side;
  ivec2 corner = map_corner(index, params.maps_per_row, side);
  splat.accepted = accepted_part(corner, side);
  if (splat.accepted < 1.0 / 1024.0) {  // what is stored at least
    const float kFiner = 0.25;
    splat.half_width *= kFiner;
    splat.accepted = 1.0;
    store_plane(splat, corner, side);
  }
  store_splat(index, splat);
}
