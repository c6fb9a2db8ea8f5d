// Which face a point on a surface belongs to. The including kernel declares
//   layout(set = 0, binding = n) readonly buffer FaceTableBuffer { uint data[]; } face_table;
// and binds VoxelFaces::table of voxel_faces.h to it.
#ifndef LIGHTWELL_VOXEL_FACES_GLSL
#define LIGHTWELL_VOXEL_FACES_GLSL

#include "passes/voxel_faces/voxel_faces_types.h"
#include "shaders/normal_direction.glsl"

// Cells. A surface in the wall between two cells gives both of them faces in both directions. A side of it belongs to
// the cell that it looks into, whichever way its points are rounded.
const float kFaceSideBias = 2e-4;
// Points so near to another cell may belong there.
const float kFaceBorder = 1e-3;
// Part of the largest component of a normal from which on another one may, rounded otherwise, be the largest.
const float kFaceNearlyLargest = 0.8;

// Where to look, best guess first: attempt 0 with the bias alone, 1 to 8 in the cells round the point. `axis`, `sign`:
// of the direction.
ivec3 face_cell_guess(vec3 point, uint axis, float sign, uint attempt) {
  uvec3 bits = uvec3(attempt - 1) >> uvec3(0, 1, 2) & 1u;
  vec3 offset = attempt == 0 ? vec3(0.0) : kFaceBorder * (1.0 - 2.0 * vec3(bits));
  if (attempt == 0) offset[axis] = kFaceSideBias * sign;
  return ivec3(floor(point + offset));
}

// Slot of the face of a surface at `position` in one level, or kNoFace. `face_normal`: unit, of the triangle itself,
// towards the side asked about.
uint face_in_level(VoxelLevels levels, uint level, vec3 position, vec3 face_normal) {
  VoxelGrid grid = level_grid(levels, level);
  vec3 point = grid_coordinates(grid, position);
  vec3 size = abs(face_normal);
  uint largest = normal_direction(face_normal) / 2;
  vec3 safe_point = clamp(point, vec3(-1.0), vec3(grid.resolution));
  uint slot = kNoFace;
  // Tested at the head: of what the body of a loop leaves, SwiftShader loses the lanes that were done before the last.
  for (uint attempt = 0; attempt < 27 && slot == kNoFace; ++attempt) {
    uint axis = (largest + attempt / 9) % 3;
    uint direction = 2 * axis + (face_normal[axis] < 0.0 ? 1 : 0);
    ivec3 cell = face_cell_guess(safe_point, axis, face_normal[axis] < 0.0 ? -1.0 : 1.0, attempt % 9);
    bool possible = size[axis] > kFaceNearlyLargest * size[largest] && grid_contains(grid, cell);
    uint word = possible ? face_table.data[level_cell_index(levels, level, cell)] : 0;
    slot = face_slot(word, direction);
  }
  return slot;
}

// The same in the finest level that has such a face, from level_at(levels, position, footprint) on.
uint face_at(VoxelLevels levels, vec3 position, vec3 face_normal, float footprint, out uint level) {
  uint next = level_at(levels, position, footprint);
  uint slot = kNoFace;
  for (; next < levels.count && slot == kNoFace; ++next) {
    slot = face_in_level(levels, next, position, face_normal);
    level = next;
  }
  return slot;
}

#endif
