// Between flagging and allocating: do the children of this depth fit into the pool? If not, or if the list knows no
// finer cells, no leaf lies deeper.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/svo/svo_params.h"
#include "shaders/linear_dispatch.glsl"

LW_PUSH_CONSTANTS(SvoBuildParams, LW_SVO_BUILD_PARAMS)

layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) writeonly buffer ArgumentBuffer { uint data[]; } arguments;

void write_groups(uint first, uint count) {
  uvec3 groups = linear_groups((count + 63) / 64);
  for (uint i = 0; i < 3; ++i) arguments.data[first + i] = groups[i];
}

void main() {
  if (counts.data[kSvoEnded] != 0) {
    write_groups(kSvoNodeGroups, 0);
    return;
  }
  uint start = counts.data[kSvoLevelStarts + params.depth];
  uint end = counts.data[kSvoLevelStarts + params.depth + 1];
  bool finest = params.depth == counts.data[kSvoListLevel] + params.level_count - 1;
  // Of one grid all leaves lie there, and were not counted one by one.
  uint flagged = finest && params.level_count == 1 ? counts.data[kSvoListCount] : counts.data[kSvoFlagged];
  uint tiles = counts.data[kSvoTiles];
  bool full = tiles + flagged > params.node_tiles;
  bool ended = finest || full;
  write_groups(kSvoNodeGroups, !ended || params.records != 0 ? end - start : 0);
  if (ended) {
    counts.data[kSvoEnded] = 1;
    counts.data[kSvoLevelReached] = params.depth;
    counts.data[kSvoLeaves] += flagged;
    counts.data[kSvoNodesUsed] = 8 * tiles;
    counts.data[kSvoNodesWanted] = 8 * (finest ? tiles : tiles + flagged);
    write_groups(kSvoListGroups, 0);
  } else {
    counts.data[kSvoLevelStarts + params.depth + 2] = 8 * (tiles + flagged);
  }
  counts.data[kSvoFlagged] = 0;
}
