// Turns voxels into the first virtual point lights: each occupied cell sends a constant hemisphere of radiance along its
// normal. Mavridis et al. 2010, section 3.1, last paragraph.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/sh.glsl"
#include "techniques/light_volume/paper_types.h"
#include "techniques/light_volume/paper_voxel.glsl"

layout(local_size_x = 16, local_size_y = 4) in;

LW_PUSH_CONSTANTS(PaperInjectParams, LW_PAPER_INJECT_PARAMS)

layout(set = 0, binding = 0) readonly buffer VoxelBuffer { uint data[]; } voxels;
layout(set = 0, binding = 1) buffer CellBuffer { vec4 data[]; } cells;  // normal; w: 1 if occupied, 0 if void
layout(set = 0, binding = 2) buffer LightBuffer { float data[]; } light;

vec3 voxel_channel(uint first_plane, uint index) {
  uint at = first_plane * params.grid.cell_count + index;
  return vec3(uintBitsToFloat(voxels.data[at]), uintBitsToFloat(voxels.data[at + params.grid.cell_count]),
              uintBitsToFloat(voxels.data[at + 2u * params.grid.cell_count]));
}

void main() {
  ivec3 cell = ivec3(gl_GlobalInvocationID);
  if (!grid_contains(params.grid, cell)) return;
  uint index = grid_cell_index(params.grid, cell);

  vec3 code = voxel_channel(kPaperNormalPlane, index);
  bool occupied = paper_is_occupied(code);
  vec3 normal = occupied ? paper_decode_normal(code) : vec3(0.0);
  vec3 radiance = voxel_channel(kPaperRadiancePlane, index);

  cells.data[index] = vec4(normal, occupied ? 1.0 : 0.0);
  vec4 hemisphere = sh_hemisphere(normal);
  for (uint channel = 0; channel < 3; ++channel) {
    for (uint k = 0; k < 4; ++k) {
      light.data[(4u * channel + k) * paper_plane_stride(params.grid.cell_count) + index] = radiance[channel] * hemisphere[k];
    }
  }
}
