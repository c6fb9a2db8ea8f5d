// Buffers and parameters of the faces of voxels, as host and kernels see them.
#ifndef LIGHTWELL_VOXEL_FACES_TYPES_H
#define LIGHTWELL_VOXEL_FACES_TYPES_H

#include "passes/voxel_grid/voxel_levels_types.h"
#include "passes/voxelize/voxelize_types.h"

// Where a cell's faces are: base << 6 | stored. Bit d of `stored`: the cell has a face in direction d
// (shaders/normal_direction.glsl), in slot base + the number of stored directions below d. 0: none, or no room.
LW_CONSTANT(uint, kFaceBaseShift, 6)
LW_CONSTANT(uint, kFaceDirections, 63)  // mask
LW_CONSTANT(uint, kNoFace, 0xffffffffu)
LW_CONSTANT(uint, kFaceCapacityLimit, 1 << 21)

// Words of the buffer `counts`.
LW_CONSTANT(uint, kFacesFound, 0)   // faces of all cells
LW_CONSTANT(uint, kFacesStored, 1)  // of them, those with a slot: all slots below this are in use, none else
LW_CONSTANT(uint, kFaceGroups, 2)   // 3 words: dispatch of one invocation a slot in use, 64 a workgroup
LW_CONSTANT(uint, kFaceCountWords, 5)

// A face's area in the buffer `areas`, that of the surfaces whose points face_at() finds there: one cell^2 is so many
// units. What is 4096 cells^2 or more is 2^32 - 1.
LW_CONSTANT(float, kFaceAreaUnits, 1048576.0f)

// Slots are given to blocks of so many cells at a time.
LW_CONSTANT(uint, kFaceBlock, 32)

#define LW_VOXEL_FACE_PARAMS(MEMBER)                                    \
  MEMBER(VoxelLevels, levels)                                           \
  MEMBER(uint, level)               /* that triangles are visited in */ \
  MEMBER(uint, capacity)            /* faces that there is room for */  \
  MEMBER(TriangleChoice, triangles) /* whose area is added */

// Copies the cells of a box of one level, as voxelised, to their places among the cells of all levels.
#define LW_FACE_CELLS_PARAMS(MEMBER)                                     \
  MEMBER(VoxelLevels, levels)                                            \
  MEMBER(ivec3, lower) /* of the box, from that of the level's window */ \
  MEMBER(uint, level)                                                    \
  MEMBER(uvec3, size) /* cells */

#define LW_FACE_BEFORE_PARAMS(MEMBER) \
  MEMBER(VoxelLevels, levels)         \
  MEMBER(ivec3, old_center) /* VoxelLevels::center of last frame */

#ifndef __cplusplus

// Slot of the face in `direction` of a cell whose word of the table is `word`, or kNoFace.
uint face_slot(uint word, uint direction) {
  uint slot = (word >> kFaceBaseShift) + bitCount(word & ((1u << direction) - 1u));
  return (word & (1u << direction)) == 0 ? kNoFace : slot;
}

#endif

#endif
