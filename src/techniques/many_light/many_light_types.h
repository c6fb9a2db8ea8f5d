// Parameters of this technique's kernels, as host and kernels see them.
#ifndef LIGHTWELL_MANY_LIGHT_TYPES_H
#define LIGHTWELL_MANY_LIGHT_TYPES_H

#include "passes/light_clusters/light_clusters_types.h"
#include "shaders/shared.h"

// ---- paper ----

// The picture is split into so many tiles a side, each with every fourth pixel; a tile sees one part in 16 of the
// lights.
LW_CONSTANT(uint, kSplit, 4)

#define LW_SPLIT_PARAMS(MEMBER)                 \
  MEMBER(uvec2, size)      /* of the picture */ \
  MEMBER(uvec2, tile_size) /* pixels of a tile */

#define LW_PAPER_GATHER_PARAMS(MEMBER)                                                                   \
  MEMBER(uvec2, tile_size)                                                                               \
  MEMBER(uint, paths)                   /* light paths, a multiple of 16: a tile sees a block of them */ \
  MEMBER(uint, bounces)                 /* light points a path */                                        \
  MEMBER(float, least_distance_squared) /* m^2: B of the paper */                                        \
  MEMBER(float, least_flux)             /* luminance in W, below which a light point is skipped */       \
  MEMBER(float, clearance)

#define LW_PAPER_FILTER_PARAMS(MEMBER)                             \
  MEMBER(uvec2, size)                                              \
  MEMBER(float, most_distance) /* m, of a neighbour that counts */ \
  MEMBER(float, least_cosine)  /* of its normal */

// ---- best ----

#define LW_LIGHT_GATHER_PARAMS(MEMBER) \
  LW_CLAMP_PARAMS(MEMBER)              \
  MEMBER(uvec2, size)                  \
  MEMBER(uint, rays)                   \
  MEMBER(float, clearance)

// Where a short ray met a surface: what the clamp of the geometry term leaves out comes from there.
#define LW_NEAR_PARAMS(MEMBER) \
  LW_CLAMP_PARAMS(MEMBER)      \
  MEMBER(uvec2, size)          \
  MEMBER(float, clearance)     \
  MEMBER(uint, sample_index)   \
  MEMBER(uint, sequence)

#define LW_NEAR_DIRECT_PARAMS(MEMBER) \
  MEMBER(uvec2, size)                 \
  MEMBER(uvec2, table_size)           \
  MEMBER(uint, emitter_count)         \
  MEMBER(uint, light_count)           \
  MEMBER(uint, sample_index)          \
  MEMBER(uint, sequence)

#define LW_ADD_PARAMS(MEMBER) MEMBER(uvec2, size)

#define LW_CHANGE_PARAMS(MEMBER)                  \
  LW_CLAMP_PARAMS(MEMBER)                         \
  MEMBER(uvec2, size)        /* of the picture */ \
  MEMBER(uvec2, block_count) /* blocks of it */   \
  MEMBER(float, clearance)                        \
  MEMBER(uint, turn) /* which pixel of each block */

#ifdef __cplusplus
LW_PUSH_CONSTANTS(SplitParams, LW_SPLIT_PARAMS)
LW_PUSH_CONSTANTS(PaperGatherParams, LW_PAPER_GATHER_PARAMS)
LW_PUSH_CONSTANTS(PaperFilterParams, LW_PAPER_FILTER_PARAMS)
LW_PUSH_CONSTANTS(LightGatherParams, LW_LIGHT_GATHER_PARAMS)
LW_PUSH_CONSTANTS(NearParams, LW_NEAR_PARAMS)
LW_PUSH_CONSTANTS(NearDirectParams, LW_NEAR_DIRECT_PARAMS)
LW_PUSH_CONSTANTS(AddParams, LW_ADD_PARAMS)
LW_PUSH_CONSTANTS(ChangeParams, LW_CHANGE_PARAMS)
#endif

#endif
