// Adds the area of every triangle's piece in every cell to the two faces that its sides belong to.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxel_faces/voxel_faces_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(VoxelFaceParams, LW_VOXEL_FACE_PARAMS)
LW_PAGED_READ(0, 0, VoxelTile, tiles)
layout(set = 0, binding = 1) readonly buffer TileCountBuffer { uint data[]; } tile_counts;
layout(set = 0, binding = 2) readonly buffer FaceTableBuffer { uint data[]; } face_table;
// A face: sum, and how often it overflowed. Additions commute, so the order of the triangles does not show.
layout(set = 0, binding = 3) buffer AreaSumBuffer { uvec2 data[]; } area_sums;

#include "passes/voxel_faces/voxel_faces.glsl"
#include "passes/voxelize/cut_by_box.glsl"
#include "passes/voxelize/triangle_cells.glsl"
#include "shaders/random.glsl"
#include "shaders/software_drivers.glsl"

// In [0,1), by the triangle's place: areas are rounded to whole units at random, or many small pieces would sum to
// nothing.
float rounding(CellTriangle triangle, uint cell) {
  uvec3 bits = floatBitsToUint(triangle.a + 3.0 * triangle.b + 5.0 * triangle.c);
  uint hash = hash_word(bits.x ^ hash_word(bits.y ^ hash_word(bits.z ^ hash_word(cell))));
  return float(hash >> 8) / 16777216.0;
}

void add_area(uint slot, uint area) {
  if (slot >= params.capacity) return;  // no such face, or no room
  uint sum = atomicAdd(area_sums.data[slot].x, area);
  if (sum + area < sum) atomicAdd(area_sums.data[slot].y, 1);
}

// By how many cells along `axis` a piece with this centre, relative to its cell, is so near to the next cell that
// face_near() looks there first: for one of its sides, if the triangle meets that cell, too. Nothing else is asked, so
// that the areas of two sets of triangles add up to those of both.
int step_over_wall(CellTriangle triangle, ivec3 cell, uint axis, float center) {
  int step = center < kFaceSideBias ? -1 : center > 1.0 - kFaceSideBias ? 1 : 0;
  ivec3 next = cell;
  next[axis] += step;
  bool meets = false;
  for (int i = 0; i < LW_ROUNDS_IF(step != 0 && grid_contains(level_grid(params.levels, params.level), next), 1); ++i)
    meets = meets_cell(triangle, next);
  return meets ? step : 0;
}

void visit_cell(Triangle source, CellTriangle triangle, ivec3 cell) {
  // Outside of this single precision has no unit normal.
  float whole_area = 0.5 * length(triangle.normal);
  if (!(whole_area > 1e-15 && whole_area < 1e15)) return;
  vec3 normal = normalize(triangle.normal);
  vec3 corner = vec3(cell);
  FlatPiece piece =
      cut_triangle(triangle.a - corner, triangle.b - corner, triangle.c - corner, normal, vec3(0.0), vec3(1.0));
  // A piece in the wall between two cells is cut out for both of them, and counts in the upper one.
  uint axis = normal_direction(triangle.normal) / 2;
  float center = piece.center[axis];
  if (center > 1.0 - 1e-6) return;
  // Rounding makes pieces of needles too large.
  float piece_area = min(piece.area, whole_area);
  uint area = uint(piece_area * kFaceAreaUnits + rounding(triangle, level_cell_index(params.levels, params.level, cell)));
  if (area == 0) return;

  int step = step_over_wall(triangle, cell, axis, center);
  for (uint down = 0; down < 2; ++down) {
    ivec3 home = cell;
    if (step == (down == 1 ? -1 : 1)) home[axis] += step;
    add_area(face_slot(face_table.data[level_cell_index(params.levels, params.level, home)], 2 * axis + down), area);
  }
}

#include "passes/voxelize/visit_triangles.glsl"

void main() {
  visit_triangles(level_grid(params.levels, params.level), params.triangles);
}
