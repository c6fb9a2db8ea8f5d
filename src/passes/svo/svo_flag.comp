// Flags the nodes of one depth in which cells of the list lie (Sun 2015, section 4.3.2, step 5). The source descends
// from the root each time; here each cell remembers its node of the depth above.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/svo/svo_params.h"
#include "shaders/paged_buffer.glsl"

LW_PUSH_CONSTANTS(SvoBuildParams, LW_SVO_BUILD_PARAMS)

layout(local_size_x = 64) in;
LW_PAGED_READ_WRITE(coherent, 0, 0, uvec4, nodes)
layout(set = 0, binding = 1) readonly buffer ListBuffer { uint data[]; } list;
layout(set = 0, binding = 2) buffer PlaceBuffer { uint data[]; } places;  // node of each cell of the list
layout(set = 0, binding = 3) buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 4) readonly buffer WindowBuffer { ivec4 data[]; } windows;

#include "passes/svo/svo_cells.glsl"
#include "passes/svo/svo_windows.glsl"
#include "shaders/linear_dispatch.glsl"

// The info word before.
uint flag_node(uint index) {
  if (kPages_nodes == 1) return atomicOr(nodes[0].data[index].x, kSvoOccupied);
  uint page = nodes_page(index);
  uint place = nodes_place(index);
  uint before = 0;
  if (page == 0) before = atomicOr(nodes[0].data[place].x, kSvoOccupied);
  if (page == 1) before = atomicOr(nodes[1].data[place].x, kSvoOccupied);
  if (kPages_nodes > 2 && page == 2) before = atomicOr(nodes[2].data[place].x, kSvoOccupied);
  if (kPages_nodes > 3 && page == 3) before = atomicOr(nodes[3].data[place].x, kSvoOccupied);
  return before;
}

void main() {
  uint i = linear_invocation();
  if (i >= counts.data[kSvoListCount]) return;
  // The leaf of this entry lies as deep as its level is fine.
  uint level = level_of_entry(list.data[i]);
  uint leaf_depth = counts.data[kSvoListLevel] + params.level_count - 1 - level;
  if (kSeveralLevels != 0 && params.depth > leaf_depth) return;
  uint node = 0;
  if (params.depth > 0) {
    uvec3 cell = cell_of_entry(list.data[i]);
    if (kSeveralLevels != 0) cell += uvec3(windows.data[level].xyz) >> (params.level - counts.data[kSvoListLevel]);
    cell >>= leaf_depth - params.depth;
    node = 8 * (nodes_at(places.data[i]).x & kSvoTileMask) + octant(cell);
  }
  places.data[i] = node;
  // Of many cells in one node only the first counts. A leaf belongs to one entry alone.
  if ((nodes_at(node).x & kSvoOccupied) != 0) return;
  bool first = (flag_node(node) & kSvoOccupied) == 0;
  if (first && params.depth < leaf_depth) atomicAdd(counts.data[kSvoFlagged], 1);
  if (first && params.depth == leaf_depth && kSeveralLevels != 0) atomicAdd(counts.data[kSvoLeaves], 1);
}
