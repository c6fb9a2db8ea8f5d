// Adds every triangle's piece in every cell to the surfel that it faces, and, since all surfaces have two sides, to
// the one on its other side. A back counts only where no front faces that way in the cell: the far side of a thin
// plate, or the inside of a solid, must neither move the surface nor give it its colour.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxelize/voxelize_types.h"
#include "techniques/light_volume/surfel_types.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
LW_PAGED_READ(0, 2, VoxelTile, tiles)
layout(set = 0, binding = 3) readonly buffer TileCountBuffer { uint data[]; } tile_counts;
layout(set = 0, binding = 9) readonly buffer CellBuffer { uint data[]; } cells;
layout(set = 0, binding = 10) readonly buffer TableBuffer { uint data[]; } table;
layout(set = 0, binding = 11) buffer SumBuffer { uint data[]; } sums;

#include "passes/voxelize/cut_by_box.glsl"
#include "passes/voxelize/triangle_cells.glsl"
#include "shaders/material.glsl"
#include "techniques/light_volume/surfel.glsl"

// Texture coordinates at a point of the triangle's plane, and their change over `width` along two axes of the plane.
// With e1, e2 the edges, x = a + s e1 + t e2 is solved by the Gram matrix of the edges.
void surface_uv(Triangle source, CellTriangle triangle, vec3 point, float width, out vec4 uv, out vec4 dx,
                out vec4 dy) {
  vec3 e1 = triangle.b - triangle.a;
  vec3 e2 = triangle.c - triangle.a;
  float g11 = dot(e1, e1), g12 = dot(e1, e2), g22 = dot(e2, e2);
  float determinant = max(g11 * g22 - g12 * g12, 1e-30);
  vec3 dual_1 = (g22 * e1 - g12 * e2) / determinant;
  vec3 dual_2 = (g11 * e2 - g12 * e1) / determinant;
  vec4 uv_0 = vertex_uv(source.v[0]);
  vec4 uv_1 = vertex_uv(source.v[1]) - uv_0;
  vec4 uv_2 = vertex_uv(source.v[2]) - uv_0;
  vec3 offset = point - triangle.a;
  uv = uv_0 + dot(offset, dual_1) * uv_1 + dot(offset, dual_2) * uv_2;
  mat3 frame = surfel_frame(normalize(triangle.normal));
  dx = width * (dot(frame[0], dual_1) * uv_1 + dot(frame[0], dual_2) * uv_2);
  dy = width * (dot(frame[1], dual_1) * uv_1 + dot(frame[1], dual_2) * uv_2);
}

void add_vector(uint first, uint weight, vec3 v) {
  for (uint i = 0; i < 3; ++i) atomicAdd(sums.data[first + i], uint(int(floor(float(weight) * v[i] + 0.5))));
}

void add_piece(uint slot, uint weight, FlatPiece piece, vec3 normal, vec3 albedo, vec3 emission) {
  uint base = slot * kSumWords;
  if (atomicAdd(sums.data[base + kSumWeight], weight) > kSumLimit) {
    atomicAdd(sums.data[base + kSumWeight], 0u - weight);
    return;
  }
  add_vector(base + kSumPosition, weight, piece.center);
  add_vector(base + kSumNormal, weight, normal);
  add_vector(base + kSumAlbedo, weight, albedo);
  if (emission != vec3(0.0)) add_vector(base + kSumEmission, weight, clamp(emission / params.emission_scale, 0.0, 1.0));
  for (uint i = 0; i < 3; ++i) {
    atomicMax(sums.data[base + kSumBoundsLow + i], uint((1.0 - clamp(piece.low[i], 0.0, 1.0)) * 65536.0 + 0.5));
    atomicMax(sums.data[base + kSumBoundsHigh + i], uint(clamp(piece.high[i], 0.0, 1.0) * 65536.0 + 0.5));
  }
}

void visit_cell(Triangle source, CellTriangle triangle, ivec3 cell) {
  if (triangle.normal == vec3(0.0)) return;
  uint cell_index = grid_cell_index(params.grid, cell);
  uint entry = table.data[cell_index];
  if (entry == 0) return;  // no room

  vec3 unit_normal = normalize(triangle.normal);
  vec3 corner = vec3(cell);
  FlatPiece piece =
      cut_triangle(triangle.a - corner, triangle.b - corner, triangle.c - corner, unit_normal, vec3(0.0), vec3(1.0));
  GpuMaterial material = scene_material(vertex_material(source.v[0]));
  vec4 uv, dx, dy;
  surface_uv(source, triangle, corner + piece.center, min(1.0, sqrt(piece.area)), uv, dx, dy);
  vec4 color = base_color(material, uv, dx, dy);
  // A masked texture's alpha, averaged over the piece, is the part of it that is there.
  float coverage = material.alpha_cutoff > 0.0 ? clamp(color.a, 0.0, 1.0) : 1.0;
  uint weight = uint(piece.area * coverage * kSumScale + 0.5);
  if (weight == 0) return;

  for (uint side = 0; side < 2; ++side) {
    bool front = side == 0;
    vec3 normal = unit_normal * (front ? 1.0 : -1.0);
    uint direction = normal_direction(normal);
    if (!front && (cells.data[cell_index] & (1u << direction)) != 0) continue;
    int slot = surfel_slot(entry, direction);
    vec3 emission = emitted_radiance(material, uv, dx, dy, front);
    if (slot >= 0) add_piece(uint(slot), weight, piece, normal, cache_albedo(material, color), emission);
  }
}

#include "passes/voxelize/visit_triangles.glsl"

void main() {
  visit_triangles(params.grid, params.triangle_count);
}
