// The cell of the stratification in which each visible surface lies: its place in the grid as a colour.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/photon_splatting/splat_view_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
LW_PUSH_CONSTANTS(SplatCellsParams, LW_SPLAT_CELLS_PARAMS)
layout(set = 0, binding = 0) uniform sampler2D position;  // w: 0 where there is no surface
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D picture;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(params.size)))) return;
  vec4 place = texelFetch(position, pixel, 0);
  vec3 resolution = vec3(params.grid.resolution);
  vec3 cell = clamp(floor(grid_coordinates(params.grid, place.xyz)), vec3(0.0), resolution - 1.0);
  imageStore(picture, pixel, place.w > 0.0 ? vec4((cell + 0.5) / resolution, 1.0) : vec4(0.0));
}
