// The faces of a cell, from what stands in it and what moves. The including kernel includes voxel_faces_types.h and
// declares
//   layout(constant_id = n) const uint kStanding;  // 1: `standing` counts, too
//   layout(set = 0, binding = n) readonly buffer StandingBuffer { uint data[]; } standing;  // words of a face table
//   layout(set = 0, binding = n) readonly buffer CellBuffer { uint data[]; } cells;         // as in voxelize_types.h
#ifndef LIGHTWELL_FACE_DIRECTIONS_GLSL
#define LIGHTWELL_FACE_DIRECTIONS_GLSL

// One bit a direction. All surfaces have two sides: fronts and backs count alike.
uint face_directions(uint cell) {
  uint word = cells.data[cell];
  uint directions = word | (word >> kCellBackShift);
  if (kStanding == 1) directions |= standing.data[cell];
  return directions & kFaceDirections;
}

#endif
