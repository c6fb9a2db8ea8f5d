// Triangles against cells of a grid. The including kernel includes voxelize_types.h.
#ifndef LIGHTWELL_TRIANGLE_CELLS_GLSL
#define LIGHTWELL_TRIANGLE_CELLS_GLSL

#include "shaders/finite.glsl"
#include "shaders/geometry.glsl"
#include "shaders/normal_direction.glsl"

// Cells are grown by this much on every side, so that rounding never loses a cell that a triangle touches.
const float kCellGrowth = 5e-5;

// A triangle in cells from the grid's lower corner, and the cells that its bounds touch (none: low > high somewhere).
struct CellTriangle {
  vec3 a, b, c;
  vec3 normal;  // towards the front; length twice the area; 0 where there is none
  ivec3 low, high;
};

// a b = product + error, exactly (Dekker 1971).
vec3 two_product(vec3 a, vec3 b, out vec3 error) {
  precise vec3 product = a * b;
  precise vec3 a_big = a * 4097.0;
  precise vec3 b_big = b * 4097.0;
  precise vec3 a_high = a_big - (a_big - a);
  precise vec3 b_high = b_big - (b_big - b);
  precise vec3 a_low = a - a_high;
  precise vec3 b_low = b - b_high;
  precise vec3 e = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
  error = e;
  return product;
}

// The cross product, good to the last digits where a and b are nearly parallel too: rounding turns the normal of a
// long needle by far more than the distances that matter here.
vec3 accurate_cross(vec3 a, vec3 b) {
  vec3 error_1, error_2;
  precise vec3 product_1 = two_product(a.yzx, b.zxy, error_1);
  precise vec3 product_2 = two_product(a.zxy, b.yzx, error_2);
  precise vec3 result = (product_1 - product_2) + (error_1 - error_2);
  return result;
}

CellTriangle to_cells(VoxelGrid grid, Triangle source) {
  CellTriangle t;
  t.a = grid_coordinates(grid, vertex_position(source.v[0]));
  t.b = grid_coordinates(grid, vertex_position(source.v[1]));
  t.c = grid_coordinates(grid, vertex_position(source.v[2]));
  t.normal = accurate_cross(t.b - t.a, t.c - t.a) * vertex_handedness(source.v[0]);
  vec3 last = vec3(grid.resolution);
  vec3 low = clamp(min(min(t.a, t.b), t.c) - kCellGrowth, vec3(-1.0), last);
  vec3 high = clamp(max(max(t.a, t.b), t.c) + kCellGrowth, vec3(-1.0), last);
  t.low = max(ivec3(floor(low)), ivec3(0));
  t.high = min(ivec3(floor(high)), ivec3(grid.resolution) - 1);
  if (!(is_finite(t.a) && is_finite(t.b) && is_finite(t.c))) t.high = t.low - 1;
  return t;
}

uint cells_in_bounds(CellTriangle t) {
  ivec3 size = max(t.high - t.low + 1, ivec3(0));
  return uint(size.x) * uint(size.y) * uint(size.z);
}

// The three axes that are cross products of one edge with the coordinate axes. The edge's two ends project to the
// same point: `end` is one of them, `opposite` the third vertex.
bool is_separated_by_edge(vec3 edge, vec3 end, vec3 opposite, float half_side) {
  vec3 size = abs(edge);
  vec3 p = vec3(end.z * edge.y - end.y * edge.z, end.x * edge.z - end.z * edge.x, end.y * edge.x - end.x * edge.y);
  vec3 q = vec3(opposite.z * edge.y - opposite.y * edge.z, opposite.x * edge.z - opposite.z * edge.x,
                opposite.y * edge.x - opposite.x * edge.y);
  vec3 radius = half_side * vec3(size.y + size.z, size.z + size.x, size.x + size.y);
  return any(greaterThan(min(p, q), radius)) || any(lessThan(max(p, q), -radius));
}

// Does the triangle meet the closed axis-aligned cube? Separating axes (Akenine-Moller 2001): the cube's three, the
// triangle's normal, and nine cross products of edges. Where the triangle is a segment or a point, the axes that
// vanish separate nothing and the others suffice.
bool meets_cube(CellTriangle t, vec3 center, float half_side) {
  vec3 a = t.a - center;
  vec3 b = t.b - center;
  vec3 c = t.c - center;
  if (any(greaterThan(min(min(a, b), c), vec3(half_side))) || any(lessThan(max(max(a, b), c), vec3(-half_side))))
    return false;
  if (abs(dot(t.normal, a)) > half_side * dot(abs(t.normal), vec3(1.0))) return false;
  return !is_separated_by_edge(b - a, a, c, half_side) && !is_separated_by_edge(c - b, b, a, half_side) &&
         !is_separated_by_edge(a - c, c, b, half_side);
}

bool meets_cell(CellTriangle t, ivec3 cell) {
  return meets_cube(t, vec3(cell) + 0.5, 0.5 + kCellGrowth);
}

bool meets_tile(CellTriangle t, ivec3 tile) {
  float side = float(kTileSide);
  return meets_cube(t, (vec3(tile) + 0.5) * side, 0.5 * side + 2.0 * kCellGrowth);
}

#endif
