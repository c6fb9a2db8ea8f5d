// Which surfel a pixel lies on. The including kernel declares `table` and includes surfel.glsl.
#ifndef LIGHTWELL_SURFEL_HOME_GLSL
#define LIGHTWELL_SURFEL_HOME_GLSL

// Slot of the surfel of a pixel's own surface, in the cell just above or just below it, or -1. `point`: in cells.
int home_slot(vec3 point, vec3 n, out ivec3 cell) {
  vec3 size = abs(n);
  uint axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  uint direction = 2 * axis + (n[axis] < 0.0 ? 1 : 0);
  for (int side = 0; side < 2; ++side) {
    cell = ivec3(floor(point + (side == 0 ? 1e-3 : -1e-3) * n));
    if (!grid_contains(params.grid, cell)) continue;
    int slot = surfel_slot(table.data[grid_cell_index(params.grid, cell)], direction);
    if (slot >= 0) return slot;
  }
  return -1;
}

#endif
