// Irradiance at each pixel, with the published ambient light.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/paged_buffer.glsl"
#include "techniques/ray_traced_voxels/paper_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
LW_PUSH_CONSTANTS(VoxelFinalParams, LW_VOXEL_FINAL_PARAMS)

layout(set = 0, binding = 0) uniform sampler2D position;
LW_PAGED_READ(0, 1, uint, irradiance)
layout(set = 0, binding = 2, rgba32f) uniform writeonly image2D result;

#include "techniques/ray_traced_voxels/paper_lookup.glsl"

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  vec4 place = texelFetch(position, ivec2(pixel), 0);
  vec3 e = vec3(0.0);
  if (place.w > 0.0) e = look_up(params.grid, place.xyz, params.range) + params.ambient;
  imageStore(result, ivec2(pixel), vec4(e, 1.0));
}
