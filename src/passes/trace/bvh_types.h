// The hierarchy's layout and its builder's parameters, as host and kernels see them.
#ifndef LIGHTWELL_BVH_TYPES_H
#define LIGHTWELL_BVH_TYPES_H

#include "shaders/shared.h"

// A reference to a part of the hierarchy: a wide node's index, or, with the highest bit set, a leaf: number of
// triangles - 1 in bits 29 and 30, below them the slot of its first triangle.
LW_CONSTANT(uint, kBvhNothing, 0xffffffffu)
LW_CONSTANT(uint, kBvhLeafFlag, 0x80000000u)
LW_CONSTANT(uint, kBvhLeafCountShift, 29)
LW_CONSTANT(uint, kBvhSlotMask, 0x1fffffffu)
LW_CONSTANT(uint, kBvhLeafTriangles, 2)  // largest leaf; every smaller part is one

// A wide node is kBvhNodeWords uvec4 (Ylitie, Karras and Laine 2017, with four children):
//   0: xyz origin of the children's boxes (float bits); w: a byte an axis, the exponent of the step between planes
//   1: xyz low planes along x, y, z, a byte a child; w: high planes along x
//   2: xy high planes along y, z
//   3: the children's references
// The place of node 0 holds the references of the standing and of the moving triangles' hierarchy in xy.
LW_CONSTANT(uint, kBvhNodeWords, 4)
// A triangle is three uvec4: its corners in xyz (float bits); w of the first: index of the triangle in the scene.
LW_CONSTANT(uint, kBvhTriangleWords, 3)

// What a ray keeps in mind: each round of merging makes one level at most, and a level leaves three children behind.
LW_CONSTANT(uint, kBvhStack, 3 * 144 + 6)

// Coordinates from here on, infinities and NaN make a triangle that no ray meets.
LW_CONSTANT(float, kBvhLargestCoordinate, 1e18f)

// ---- the builder ----

LW_CONSTANT(uint, kBvhCodeBits, 30)      // of a Morton code
LW_CONSTANT(uint, kBvhBoundsBlock, 64)   // triangles whose bounds one invocation joins
LW_CONSTANT(uint, kBvhPairBlock, 32)     // clusters that one invocation merges
LW_CONSTANT(uint, kBvhRadius, 8)         // neighbours looked at on either side
LW_CONSTANT(uint, kBvhTopClusters, 512)  // so few are merged by one workgroup
LW_CONSTANT(uint, kBvhTopFree, 50)       // rounds of that workgroup by likeness; then neighbours are paired
LW_CONSTANT(uint, kBvhTopRounds, 60)
LW_CONSTANT(uint, kBvhMaximumRounds, 144)  // of the whole device and that workgroup

// Words of the builder's state.
LW_CONSTANT(uint, kBvhBounds, 0)       // 6 words: bounds of the boxes' centres, in bvh_order.glsl's order
LW_CONSTANT(uint, kBvhClusters, 6)     // how many there are
LW_CONSTANT(uint, kBvhHalf, 7)         // which half of `clusters` holds them
LW_CONSTANT(uint, kBvhInnerNodes, 8)   // made so far
LW_CONSTANT(uint, kBvhOldClusters, 9)  // the same three before the round that is being merged
LW_CONSTANT(uint, kBvhOldHalf, 10)
LW_CONSTANT(uint, kBvhOldInnerNodes, 11)
LW_CONSTANT(uint, kBvhSearchGroups, 12)  // 3 words: indirect dispatches
LW_CONSTANT(uint, kBvhCountGroups, 15)
LW_CONSTANT(uint, kBvhMergeGroups, 18)
LW_CONSTANT(uint, kBvhRounds, 24)  // 4 words a round: groups for its inner nodes, first of them
LW_CONSTANT(uint, kBvhStateWords, 24 + 4 * (kBvhMaximumRounds + 1))

// Levels of the wide hierarchy, one a round, leaves first: 4 words each: groups for its nodes, first node (relative).
// The nodes of level l end where those of level l - 1 begin.
LW_CONSTANT(uint, kBvhLevelWords, 4 * (kBvhMaximumRounds + 1))

#define LW_BVH_PARAMS(MEMBER)                                                                           \
  MEMBER(uint, count)     /* of this hierarchy's triangles */                                           \
  MEMBER(uint, gap_first) /* which are those of the scene without [gap_first, gap_first + gap_count) */ \
  MEMBER(uint, gap_count)                                                                               \
  MEMBER(uint, node_first) /* where its wide nodes lie */                                               \
  MEMBER(uint, slot_first) /* where its triangles lie */                                                \
  MEMBER(uint, root_word)  /* of node 0 */                                                              \
  MEMBER(uint, rounds)     /* of merging by the whole device, before one workgroup finishes */          \
  MEMBER(uint, round)                                                                                   \
  MEMBER(uint, forced) /* 1: neighbours are paired whatever their boxes */

#endif
