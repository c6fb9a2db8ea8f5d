// Adds up, for each occupied leaf, the normals of the triangles that meet it. Sums of integers: their order does not
// show.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/svo/svo_params.h"
#include "passes/voxelize/voxelize_types.h"
#include "shaders/paged_buffer.glsl"

LW_PUSH_CONSTANTS(SvoBuildParams, LW_SVO_BUILD_PARAMS)

layout(local_size_x = 64) in;
LW_PAGED_READ(0, 0, VoxelTile, tiles)
layout(set = 0, binding = 1) readonly buffer TileCountBuffer { uint data[]; } tile_counts;
LW_PAGED_READ(0, 2, uvec4, nodes)
layout(set = 0, binding = 3) buffer RecordBuffer { SvoRecord data[]; } records;

#include "passes/svo/svo_cells.glsl"
#include "passes/voxelize/triangle_cells.glsl"

// The record of the leaf in which a cell lies.
uint find_record(uvec3 cell) {
  uint node = 0;
  uint info = nodes_at(0).x;
  for (uint depth = 1; depth <= kSvoMaximumLevel && (info & kSvoLeaf) == 0; ++depth) {
    node = 8 * (info & kSvoTileMask) + octant(cell >> (params.level - min(depth, params.level)));
    info = nodes_at(node).x;
  }
  return nodes_at(node).y;
}

void visit_cell(Triangle source, CellTriangle triangle, ivec3 cell) {
  uint record = find_record(uvec3(cell));
  if (record == kSvoNoRecord) return;
  float twice_area = length(triangle.normal);
  if (!(twice_area > 0.0)) return;
  float weight = min(0.5 * twice_area, 1.0) * kSvoRecordUnit;
  ivec3 normal = ivec3(round(triangle.normal / twice_area * weight));
  atomicAdd(records.data[record].normal_sum.x, normal.x);
  atomicAdd(records.data[record].normal_sum.y, normal.y);
  atomicAdd(records.data[record].normal_sum.z, normal.z);
  atomicAdd(records.data[record].weight, uint(round(weight)));
}

#include "passes/voxelize/visit_triangles.glsl"

void main() {
  visit_triangles(params.grid, params.triangle_count);
}
