// Between voxels and octree: the root, and what the list holds. Where cells are missing in it, the bricks are gone
// through for a list of larger cells.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/svo/svo_params.h"
#include "shaders/linear_dispatch.glsl"
#include "shaders/paged_buffer.glsl"

LW_PUSH_CONSTANTS(SvoBuildParams, LW_SVO_BUILD_PARAMS)

layout(local_size_x = 1) in;
LW_PAGED_WRITE(0, 0, uvec4, nodes)
layout(set = 0, binding = 1) buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 2) writeonly buffer ArgumentBuffer { uint data[]; } arguments;

#include "passes/svo/svo_cells.glsl"

void write_groups(uint first, uint count) {
  uvec3 groups = linear_groups(count);
  for (uint i = 0; i < 3; ++i) arguments.data[first + i] = groups[i];
}

void main() {
  uint last = (1u << params.level) - 1u;
  uint coarsest = (params.level_count - 1) << kSvoLevelShift;
  nodes_store(0, uvec4(kSvoLeaf | coarsest, kSvoNoRecord, 0, pack_cell(uvec3(last))));
  for (uint i = 1; i < 8; ++i) nodes_store(i, uvec4(kSvoLeaf, kSvoNoRecord, 0, 0));

  uint found = counts.data[kSvoFragments];
  bool overflow = found > params.list_capacity;
  counts.data[kSvoLevelBuilt] = params.level;
  counts.data[kSvoLevelReached] = params.level + params.level_count - 1;
  counts.data[kSvoListOverflow] = overflow ? 1 : 0;
  counts.data[kSvoListLevel] = params.level;
  counts.data[kSvoListCount] = overflow ? 0 : found;
  counts.data[kSvoTiles] = 1;
  counts.data[kSvoLevelStarts] = 0;
  counts.data[kSvoLevelStarts + 1] = 8;
  write_groups(kSvoListGroups, overflow ? 0 : (found + 63) / 64);
  write_groups(kSvoNodeGroups, 0);
  uint bricks = params.level_count << (3 * (params.level - 2));
  write_groups(kSvoBrickGroups, overflow ? (bricks + 63) / 64 : 0);
}
