// Parameters and buffers of the published light volume, as host and kernels see them.
//
// Light is stored in planes of floats: coefficient k of colour channel c of a cell lies at
// (4 c + k) * stride + cell. The published layout is a vec4 a channel; planes hold the same numbers, and the
// propagation, which needs only two of a neighbour's four coefficients, then reads half as many.
#ifndef LIGHTWELL_LIGHT_VOLUME_PAPER_TYPES_H
#define LIGHTWELL_LIGHT_VOLUME_PAPER_TYPES_H

#include "passes/voxel_grid/voxel_grid_types.h"

LW_CONSTANT(uint, kPaperLightPlanes, 12)  // 3 channels of 4 coefficients
LW_CONSTANT(uint, kPaperVoxelPlanes, 6)   // encoded normal and radiosity, see paper_voxelize.frag

// Floats from one plane of light to the next. Grids are powers of two: planes that followed each other without a gap
// would all map to the same sets of a cache, and a cell and its neighbours touch 36 places of them.
#ifdef __cplusplus
namespace lightwell::glsl {
constexpr
#endif
    uint
    paper_plane_stride(uint cell_count) {
  return cell_count + 272u;
}
#ifdef __cplusplus
}
#endif

#define LW_PAPER_VOXELIZE_PARAMS(MEMBER) \
  MEMBER(VoxelGrid, grid)                \
  MEMBER(uint, light_count)
#define LW_PAPER_INJECT_PARAMS(MEMBER) MEMBER(VoxelGrid, grid)
#define LW_PAPER_PROPAGATE_PARAMS(MEMBER) \
  MEMBER(VoxelGrid, grid)                 \
  MEMBER(float, reflectance) /* albedo of every surface after the first bounce */
#define LW_PAPER_LOOKUP_PARAMS(MEMBER) \
  MEMBER(VoxelGrid, grid)              \
  MEMBER(uvec2, size) /* pixels */

#ifdef __cplusplus
LW_PUSH_CONSTANTS(PaperVoxelizeParams, LW_PAPER_VOXELIZE_PARAMS)
LW_PUSH_CONSTANTS(PaperInjectParams, LW_PAPER_INJECT_PARAMS)
LW_PUSH_CONSTANTS(PaperPropagateParams, LW_PAPER_PROPAGATE_PARAMS)
LW_PUSH_CONSTANTS(PaperLookupParams, LW_PAPER_LOOKUP_PARAMS)
#endif

#endif
