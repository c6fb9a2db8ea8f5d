// Splats sorted to the tiles of a picture and gathered there: what host and kernels share.
#ifndef LIGHTWELL_PHOTON_SPLATTING_SPLAT_VIEW_TYPES_H
#define LIGHTWELL_PHOTON_SPLATTING_SPLAT_VIEW_TYPES_H

#include "passes/voxel_grid/voxel_grid_types.h"
#include "shaders/shared.h"

LW_CONSTANT(uint, kSplatTile, 16)          // side of a tile, samples
LW_CONSTANT(uint, kSparseSplatTile, 8)     // the same where samples are some pixels apart
LW_CONSTANT(uint, kSplatSlabs, 32)         // of a tile's depth range
LW_CONSTANT(uint, kMostSplatTiles, 65535)  // in a row or column of a picture

// How a pixel's light follows from its splats (splat_gather.comp).
LW_CONSTANT(uint, kEstimateMean, 0)     // xyz: sum of weight, cosine and colour, w: of weights
LW_CONSTANT(uint, kEstimateDensity, 1)  // xyz: irradiance, W/m^2

// What the gathering shows.
LW_CONSTANT(uint, kShowLight, 0)    // the estimate
LW_CONSTANT(uint, kShowOverlap, 1)  // how many splats light the pixel, as a colour
LW_CONSTANT(uint, kShowCenters, 2)  // a dot for each splat's center

LW_CONSTANT(uint, kSplatBox, 0)
LW_CONSTANT(uint, kSplatTent, 1)
LW_CONSTANT(uint, kSplatGaussian, 2)

// Where a splat's volume is seen. Nowhere: low > high.
#define LW_SPLAT_BOUNDS(MEMBER)                                  \
  MEMBER(uint, low)      /* first tile, x + 65536 y */           \
  MEMBER(uint, high)     /* last tile */                         \
  MEMBER(float, nearest) /* m along the camera's forward axis */ \
  MEMBER(float, farthest)
LW_STRUCT(SplatBounds, LW_SPLAT_BOUNDS)

// The surfaces in a tile.
#define LW_SPLAT_TILE(MEMBER)                                                                \
  MEMBER(vec3, low)      /* of their positions, m */                                         \
  MEMBER(float, nearest) /* m along the camera's forward axis; > farthest: there are none */ \
  MEMBER(vec3, high)                                                                         \
  MEMBER(float, farthest)                                                                    \
  MEMBER(vec3, axis)    /* unit, of a cone that holds their triangles' normals */            \
  MEMBER(float, cosine) /* of the cone's half angle */                                       \
  MEMBER(uvec3, unused)                                                                      \
  MEMBER(uint, slabs) /* bit i: there is one in the i-th part of the depth range */
LW_STRUCT(SplatTile, LW_SPLAT_TILE)

// Light is gathered at samples: one pixel of each block of stride x stride pixels.
#define LW_SPLAT_SAMPLES(MEMBER)                     \
  MEMBER(uvec2, size)  /* of the picture, pixels */  \
  MEMBER(uint, stride) /* side of a block, pixels */ \
  MEMBER(uint, turn)   /* x + 256 y: which pixel of a block */
LW_STRUCT(SplatSamples, LW_SPLAT_SAMPLES)

#define LW_SPLAT_BOUNDS_PARAMS(MEMBER) MEMBER(uvec2, tiles) MEMBER(uint, tile_pixels) /* side of a tile */

#define LW_SPLAT_TILE_PARAMS(MEMBER) MEMBER(SplatSamples, samples)

#define LW_SPLAT_SPREAD_PARAMS(MEMBER) \
  MEMBER(SplatSamples, samples)        \
  MEMBER(float, pixel_tangent) /* side of a pixel 1 m away, m */

// Splats are sorted to tiles in parts side by side, each by one invocation.
#define LW_SPLAT_LIST_PARAMS(MEMBER)                                            \
  MEMBER(uvec2, tiles)                                                          \
  MEMBER(uint, parts)    /* of all splats */                                    \
  MEMBER(uint, most)     /* splats of a part in a tile: sums stay below 2^31 */ \
  MEMBER(uint, capacity) /* of the lists of all tiles */

#define LW_SPLAT_GATHER_PARAMS(MEMBER)                                                           \
  MEMBER(SplatSamples, samples)                                                                  \
  MEMBER(uint, map_side) /* texels */                                                            \
  MEMBER(uint, maps_per_row)                                                                     \
  MEMBER(float, tolerance)   /* how far behind the map's depth a surface is still lit, texels */ \
  MEMBER(float, scale)       /* of colours */                                                    \
  MEMBER(float, dot_tangent) /* radius of a center's dot, m for each m from the camera */

#define LW_SPLAT_MAPS_PARAMS(MEMBER)  \
  MEMBER(uvec2, size)    /* pixels */ \
  MEMBER(uint, map_side) /* texels */ \
  MEMBER(uint, maps_per_row)

#define LW_SPLAT_CELLS_PARAMS(MEMBER) MEMBER(VoxelGrid, grid) MEMBER(uvec2, size) /* pixels */

#ifdef __cplusplus  // each kernel declares the one that it has
LW_PUSH_CONSTANTS(SplatBoundsParams, LW_SPLAT_BOUNDS_PARAMS)
LW_PUSH_CONSTANTS(SplatTileParams, LW_SPLAT_TILE_PARAMS)
LW_PUSH_CONSTANTS(SplatSpreadParams, LW_SPLAT_SPREAD_PARAMS)
LW_PUSH_CONSTANTS(SplatListParams, LW_SPLAT_LIST_PARAMS)
LW_PUSH_CONSTANTS(SplatGatherParams, LW_SPLAT_GATHER_PARAMS)
LW_PUSH_CONSTANTS(SplatMapsParams, LW_SPLAT_MAPS_PARAMS)
LW_PUSH_CONSTANTS(SplatCellsParams, LW_SPLAT_CELLS_PARAMS)
#endif

#endif
