// Gives each flagged node of one level a tile of eight children and initialises them (Sun 2015, section 4.3.2, steps 6
// and 8); at the level of the leaves, a record. Who gets which tile depends on the order of invocations, what a path
// from the root leads to does not.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/svo/svo_params.h"
#include "shaders/paged_buffer.glsl"

LW_PUSH_CONSTANTS(SvoBuildParams, LW_SVO_BUILD_PARAMS)

layout(local_size_x = 64) in;
LW_PAGED_READ_WRITE(restrict, 0, 0, uvec4, nodes)
layout(set = 0, binding = 1) buffer CountBuffer { uint data[]; } counts;

#include "passes/svo/svo_cells.glsl"
#include "shaders/linear_dispatch.glsl"

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
  uint tile = atomicAdd(counts.data[kSvoTiles], 1);
  nodes_store(node, uvec4(kSvoOccupied | tile, kSvoNoRecord, words.zw));
  uint side = params.grid.resolution.x >> (params.depth + 1);
  uvec3 low = unpack_cell(words.z);
  for (uint i = 0; i < 8; ++i) {
    uvec3 child = low + side * (uvec3(i, i >> 1, i >> 2) & 1u);
    nodes_store(8 * tile + i, uvec4(kSvoLeaf, kSvoNoRecord, pack_cell(child), pack_cell(child + side - 1)));
  }
}
