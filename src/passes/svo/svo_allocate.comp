// Gives each flagged node of one depth a tile of eight children and initialises them (Sun 2015, section 4.3.2, steps 6
// and 8), but for leaves; at the depth of the leaves, a record. Who gets which tile depends on the order of invocations,
// what a path from the root leads to does not.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/svo/svo_params.h"
#include "shaders/paged_buffer.glsl"

LW_PUSH_CONSTANTS(SvoBuildParams, LW_SVO_BUILD_PARAMS)

layout(local_size_x = 64) in;
LW_PAGED_READ_WRITE(restrict, 0, 0, uvec4, nodes)
layout(set = 0, binding = 1) buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 2) readonly buffer WindowBuffer { ivec4 data[]; } windows;

#include "passes/svo/svo_cells.glsl"
#include "passes/svo/svo_windows.glsl"
#include "shaders/linear_dispatch.glsl"

// The level whose cells boxes of this depth are told in.
uint box_level() { return params.level_count - 1 - (max(params.depth, params.level) - params.level); }

// Whether a flagged node of this depth is a cell of the list: no finer window lies in its place. `low`: of its box.
bool is_leaf(ivec3 low) {
  uint shift = params.level - counts.data[kSvoListLevel];
  if (kSeveralLevels == 0 || params.depth + shift < params.level) return false;
  // The list's cells of this depth belong to this level, and are 2^shift times as large as its own.
  uint level = params.level_count - 1 - (params.depth + shift - params.level);
  if (level == 0) return true;
  ivec3 cell = (low + windows.data[box_level()].xyz) >> int(params.level - min(params.depth, params.level));
  uvec3 inside = uvec3(cell - (windows.data[level - 1].xyz >> int(shift + 1)));
  return any(greaterThanEqual(inside, uvec3(1u << (params.level - 1 - shift))));
}

void main() {
  bool leaves = counts.data[kSvoEnded] != 0;
  uint start = counts.data[kSvoLevelStarts + params.depth];
  uint end = counts.data[kSvoLevelStarts + params.depth + 1];
  uint node = start + linear_invocation();
  if (node >= end) return;
  uvec4 words = nodes_at(node);
  if ((words.x & kSvoOccupied) == 0) return;
  if (leaves) {
    nodes_store(node, uvec4(words.x, atomicAdd(counts.data[kSvoRecords], 1), words.zw));
    return;
  }
  ivec3 low = ivec3(unpack_cell(words.z));
  if (is_leaf(low)) return;
  uint tile = atomicAdd(counts.data[kSvoTiles], 1);
  uint level = kSeveralLevels != 0 ? box_level() : 0;
  nodes_store(node, uvec4(kSvoOccupied | (level << kSvoLevelShift) | tile, kSvoNoRecord, words.zw));
  uint side = (1u << params.level) >> (params.depth + 1);
  if (kSeveralLevels != 0 && params.depth >= params.level) {  // children are cells of the next finer level
    low = 2 * (low + windows.data[level].xyz) - windows.data[level - 1].xyz;
    --level;
    side = 1;
  }
  for (uint i = 0; i < 8; ++i) {
    uvec3 child = uvec3(low) + side * (uvec3(i, i >> 1, i >> 2) & 1u);
    nodes_store(8 * tile + i, uvec4(kSvoLeaf | (level << kSvoLevelShift), kSvoNoRecord, pack_cell(child),
                                    pack_cell(child + side - 1)));
  }
}
