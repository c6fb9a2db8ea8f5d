// The faces of a cell, from what stands in it and what moves. The including kernel includes voxel_faces_types.h and
// declares
//   layout(constant_id = n) const uint kMoving;  // 1: `moving` counts, too
//   layout(set = 0, binding = n) readonly buffer StandingBuffer { uint data[]; } standing;  // words of voxelize_types.h
//   layout(set = 0, binding = n) readonly buffer MovingBuffer { uint data[]; } moving;
#ifndef LIGHTWELL_FACE_DIRECTIONS_GLSL
#define LIGHTWELL_FACE_DIRECTIONS_GLSL

// One bit a direction. All surfaces have two sides: fronts and backs count alike.
uint face_directions(uint cell) {
  uint word = standing.data[cell];
  if (kMoving == 1) word |= moving.data[cell];
  return (word | (word >> kCellBackShift)) & kFaceDirections;
}

#endif
