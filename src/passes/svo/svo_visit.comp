// Conservative voxelisation: every cell that a triangle meets.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/svo/svo_params.h"
#include "passes/voxelize/voxelize_types.h"
#include "shaders/paged_buffer.glsl"

LW_PUSH_CONSTANTS(SvoBuildParams, LW_SVO_BUILD_PARAMS)

layout(local_size_x = 64) in;
LW_PAGED_READ(0, 0, VoxelTile, tiles)
layout(set = 0, binding = 1) readonly buffer TileCountBuffer { uint data[]; } tile_counts;
layout(set = 0, binding = 2) buffer BitBuffer { uint data[]; } bits;
layout(set = 0, binding = 3) writeonly buffer ListBuffer { uint data[]; } list;
layout(set = 0, binding = 4) buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 5) readonly buffer WindowBuffer { ivec4 data[]; } windows;

#include "passes/svo/svo_add_cell.glsl"
#include "passes/voxelize/triangle_cells.glsl"

void visit_cell(Triangle source, CellTriangle triangle, ivec3 cell) { add_cell(uvec3(cell)); }

#include "passes/voxelize/visit_triangles.glsl"

void main() {
  visit_triangles(params.grid, params.triangle_count);
}
