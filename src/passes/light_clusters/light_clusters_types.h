// Clusters of light points, and what is sampled from them, as host and kernels see them.
#ifndef LIGHTWELL_LIGHT_CLUSTERS_TYPES_H
#define LIGHTWELL_LIGHT_CLUSTERS_TYPES_H

#include "passes/voxel_grid/voxel_grid_types.h"

// A point's key: bits 12 to 14 the direction of its normal (2 * axis, + 1 where it points down the axis), below them
// the Morton code of its cell, of 16 along each axis. Points with equal keys are one cluster; where that makes too
// many, the last 3 or 6 bits do not count.
LW_CONSTANT(uint, kClusterKeyBits, 15)
LW_CONSTANT(uint, kClusterCells, 16)
LW_CONSTANT(uint, kNoClusterKey, 0x7fffu)  // of points without light; the last in order
LW_CONSTANT(uint, kMostClusters, 512)      // 6 directions times 4^3 cells always fit
LW_CONSTANT(uint, kClusterShifts, 3)

// Words of the buffer `counts`.
LW_CONSTANT(uint, kClustersAtShift, 0)  // 3 words: clusters if 0, 3 or 6 bits do not count
LW_CONSTANT(uint, kClusterCountWords, 4)

// Keys are as wide as the clusters' own: their identities last over frames.
#define LW_LIGHT_CLUSTER(MEMBER)                                                      \
  MEMBER(vec3, center)                                                                \
  MEMBER(float, radius) /* m, of a sphere that holds the points */                    \
  MEMBER(vec3, axis)    /* mean of the normals, each as its flux; unit */             \
  MEMBER(float, cosine) /* mean of the normals' cosines to it: 1 where all are one */ \
  MEMBER(uint, first)   /* of its points, in the clusters' order */                   \
  MEMBER(uint, count)                                                                 \
  MEMBER(uint, key)                                                                   \
  MEMBER(float, flux) /* luminance of all of it, W */
LW_STRUCT(LightCluster, LW_LIGHT_CLUSTER)

// Receivers are lit tile by tile.
LW_CONSTANT(uint, kLightTile, 16)  // pixels a side

// What a tile of receivers is like.
#define LW_LIGHT_TILE(MEMBER)                                                          \
  MEMBER(vec3, center)                                                                 \
  MEMBER(float, radius) /* m; negative where the tile has no receivers */              \
  MEMBER(vec3, normal)  /* mean, not unit: the shorter, the more the normals differ */ \
  MEMBER(uint, cell)    /* where visibility is learned: hashed from place and direction */
LW_STRUCT(LightTile, LW_LIGHT_TILE)

// Learned visibility: four words a slot, chosen by hashing a tile's cell and a cluster's key. Slots that two pairs
// share learn the mean of both: that costs noise and no error.
LW_CONSTANT(uint, kLearnedSlots, 1 << 17)
LW_CONSTANT(uint, kLearnedUnblocked, 0)  // rays of the frames before, each frame's counting less than the next one's
LW_CONSTANT(uint, kLearnedRays, 1)       // all of them
LW_CONSTANT(uint, kLearnedNewUnblocked, 2)
LW_CONSTANT(uint, kLearnedNewRays, 3)
LW_CONSTANT(uint, kLearnedWords, 4)
LW_CONSTANT(uint, kLearnedOne, 256)  // a ray in the first two words: fixed point

// A choice, four words: the point's place in the clusters' order, or kNoChoice; its weight, as float bits; its cluster;
// the point's number before it was put in order.
LW_CONSTANT(uint, kMostLightPoints, 1 << 20)
LW_CONSTANT(uint, kNoChoice, 0xffffffffu)

#define LW_CLUSTER_PARAMS(MEMBER) \
  MEMBER(VoxelGrid, grid)         \
  MEMBER(uint, point_count)

// Least distance of a light point: clamp_part * its distance from clamp_focus, from clamp_nearest to clamp_farthest.
#define LW_CLAMP_PARAMS(MEMBER) \
  MEMBER(vec3, clamp_focus) MEMBER(float, clamp_part) MEMBER(float, clamp_nearest) MEMBER(float, clamp_farthest)

#define LW_TILE_PARAMS(MEMBER)             \
  LW_CLAMP_PARAMS(MEMBER)                  \
  MEMBER(uvec2, size)         /* pixels */ \
  MEMBER(float, learned_cell) /* side of the cells of learned visibility, m */

#define LW_CHOICE_PARAMS(MEMBER)                                                                 \
  LW_CLAMP_PARAMS(MEMBER)                                                                        \
  MEMBER(uvec2, size) /* pixels */                                                               \
  MEMBER(uint, candidates)                                                                       \
  MEMBER(uint, rays)         /* choices a receiver: they lie one below the other in the image */ \
  MEMBER(uint, first_sample) /* of each receiver's sequence */                                   \
  MEMBER(uint, sequence)     /* which one; different ones are independent */                     \
  MEMBER(uint, most_bounces) /* points whose light has met more surfaces are left out */

#endif
