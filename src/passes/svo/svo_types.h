// The sparse voxel octree's buffers, as host and kernels see them.
//
// The grid has one level or several (svo_levels.h), each a window of 2^level cells a side; level 0 is the finest. The
// tree is one: its root is the coarsest level's whole window, and its leaves are as fine as the finest level whose
// window holds the place. Coordinates of cells count from their level's window's lower corner, packed 10:10:10 with x
// lowest. A node is a uvec4:
//   x: info: bit 31: a leaf; bit 30: occupied; bits 25 to 29: the level whose cells its box is told in; below them, of
//      inner nodes, the tile of its children: nodes 8 tile to 8 tile + 7, by octant x + 2 y + 4 z
//   y: of an occupied leaf, the index of its record (kSvoNoRecord where none was asked for)
//   z, w: lowest and highest cell of its box, both inside it
// Node 0 is the root; nodes 1 to 7 are not used. Where the pool has no room for a depth of the tree, no leaf is deeper
// than the one above it.
#ifndef LIGHTWELL_SVO_TYPES_H
#define LIGHTWELL_SVO_TYPES_H

#include "passes/voxel_grid/voxel_grid_types.h"

LW_CONSTANT(uint, kSvoLeaf, 0x80000000u)
LW_CONSTANT(uint, kSvoOccupied, 0x40000000u)
LW_CONSTANT(uint, kSvoLevelShift, 25)
LW_CONSTANT(uint, kSvoLevelMask, 31)  // shifted
LW_CONSTANT(uint, kSvoTileMask, 0x01ffffffu)
LW_CONSTANT(uint, kSvoNoRecord, 0xffffffffu)
LW_CONSTANT(uint, kSvoMaximumLevel, 10)

// Words of the buffer `counts`. Those up to kSvoLeaves are for everybody.
LW_CONSTANT(uint, kSvoLevelBuilt, 0)  // log2 of the cells a side of a level
// Depth of the deepest leaves: level built + levels - 1, less where pool or list were too small.
LW_CONSTANT(uint, kSvoLevelReached, 1)
LW_CONSTANT(uint, kSvoNodesUsed, 2)     // of the pool
LW_CONSTANT(uint, kSvoNodesWanted, 3)   // with the first depth that found no room; equal to those used otherwise
LW_CONSTANT(uint, kSvoFragments, 4)     // occupied cells, those where a finer level is left out
LW_CONSTANT(uint, kSvoListOverflow, 5)  // 1: they did not fit into the list
LW_CONSTANT(uint, kSvoLeaves, 6)        // occupied leaves of the tree
LW_CONSTANT(uint, kSvoListLevel,
            7)  // log2 of the list's cells a side of a level: less than built where they are larger
LW_CONSTANT(uint, kSvoListCount, 8)      // cells in the list
LW_CONSTANT(uint, kSvoFlagged, 9)        // nodes of this depth that get children, so far
LW_CONSTANT(uint, kSvoTiles, 10)         // taken from the pool
LW_CONSTANT(uint, kSvoRecords, 11)       // given to leaves
LW_CONSTANT(uint, kSvoEnded, 12)         // 1: the level of the leaves is known
LW_CONSTANT(uint, kSvoHalfCells, 13)     // occupied cells at twice their size; counted after an overflow
LW_CONSTANT(uint, kSvoQuarterCells, 14)  // at four times
LW_CONSTANT(uint, kSvoLevelStarts, 16)   // a word a depth: its first node; then the end of the last one
LW_CONSTANT(uint, kSvoCountWords, 64)

// Words of the arguments of indirect dispatches, 3 each.
LW_CONSTANT(uint, kSvoListGroups, 0)   // an invocation a cell of the list; none once the tree has ended
LW_CONSTANT(uint, kSvoNodeGroups, 3)   // an invocation a node of this level
LW_CONSTANT(uint, kSvoBrickGroups, 6)  // an invocation a brick, after an overflow of the list
LW_CONSTANT(uint, kSvoArgumentWords, 9)

// The bit grid: a bit a cell, in bricks of 4x4x4 cells: two words a brick, bricks x fastest, bit x + 4 y + 16 z of the
// 64. What summarises them, one after the other in `coarse`, holds a bit a brick, again in 4x4x4. All of that for each
// level, the finest first. A level has bits where a finer one lies in it, too.
LW_CONSTANT(uint, kSvoBrickSide, 4)

// Sums over the triangles that meet an occupied leaf; divide by the weight. The weight of a triangle is its area in
// cell faces, at most 1.
#define LW_SVO_RECORD(MEMBER)                                                                      \
  MEMBER(ivec3, normal_sum) /* front normals times weight, kSvoRecordUnit to 1; may cancel to 0 */ \
  MEMBER(uint, weight)      /* kSvoRecordUnit to 1 */
LW_STRUCT(SvoRecord, LW_SVO_RECORD)
LW_CONSTANT(float, kSvoRecordUnit, 4096.0f)

// What traversal needs to know beside the buffers.
#define LW_SVO_FRAME(MEMBER)                                                                      \
  MEMBER(vec3, place)        /* world position of the lower corner of the finest cell `center` */ \
  MEMBER(float, cell_size)   /* of the finest level, m */                                         \
  MEMBER(ivec3, center)      /* near the focus; (0, 0, 0) of one grid */                          \
  MEMBER(uint, level)        /* log2 of the cells a side of each level */                         \
  MEMBER(float, epsilon)     /* by which svo_restart_blocked() shortens both ends, leaves */      \
  MEMBER(uint, coarse_words) /* of one level */                                                   \
  MEMBER(uint, unused_0)                                                                          \
  MEMBER(uint, unused_1)
LW_STRUCT(SvoFrame, LW_SVO_FRAME)

#endif
