// Gives every face a slot, in order of the cells: from the first cell that does not get all of its slots on, cells have
// no faces. Most blocks have none and are left as they are, cleared.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sort/sort_types.h"
#include "passes/voxel_faces/voxel_faces_params.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kMoving = 0;
LW_PUSH_CONSTANTS(VoxelFaceParams, LW_VOXEL_FACE_PARAMS)
layout(set = 0, binding = 0) readonly buffer StandingBuffer { uint data[]; } standing;
layout(set = 0, binding = 1) readonly buffer MovingBuffer { uint data[]; } moving;
layout(set = 0, binding = 2) readonly buffer BlockBuffer { uint data[]; } block_faces;
layout(set = 0, binding = 3) readonly buffer SumBuffer { uint data[]; } sums;
layout(set = 0, binding = 4) readonly buffer SumBlockBuffer { uvec2 data[]; } sum_blocks;
layout(set = 0, binding = 5) writeonly buffer TableBuffer { uint data[]; } table;
layout(set = 0, binding = 6) writeonly buffer KeyBuffer { uint data[]; } keys;
layout(set = 0, binding = 7) writeonly buffer CountBuffer { uint data[]; } counts;

#include "passes/voxel_faces/face_directions.glsl"
#include "shaders/linear_dispatch.glsl"

void write_stored(uint stored) {
  counts.data[kFacesStored] = stored;
  uvec3 groups = linear_groups((stored + 63) / 64);
  for (uint i = 0; i < 3; ++i) counts.data[kFaceGroups + i] = groups[i];
}

void main() {
  uint cell_count = params.levels.count * level_cell_count(params.levels);
  uint block = linear_invocation();
  uint cell = block * kFaceBlock;
  if (cell >= cell_count) return;
  uint end = min(cell + kFaceBlock, cell_count);
  bool last = end == cell_count;
  if (block_faces.data[block] == 0 && !last) return;
  uint first = sums.data[block] + sum_blocks.data[block / kScanBlock].x;
  uint base = first;
  uint used = first;
  for (; cell < end; ++cell) {
    uint left = face_directions(cell);
    uint next = base + bitCount(left);
    bool fits = next <= params.capacity;
    if (left != 0 && fits) table.data[cell] = (base << kFaceBaseShift) | left;
    if (fits) used = next;
    for (uint slot = base; fits && slot < next; ++slot) {
      keys.data[slot] = 8 * cell + uint(findLSB(left));
      left &= left - 1u;
    }
    base = next;
  }
  // `base`: faces up to and with this block. One block is the first that did not get all its slots, or none is.
  if (last) counts.data[kFacesFound] = base;
  bool first_without = first <= params.capacity && base > params.capacity;
  if (first_without || (last && base <= params.capacity)) write_stored(used);
}
