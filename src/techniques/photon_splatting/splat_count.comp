// How many of each part's splats each tile has.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/photon_splatting/splat_storage.glsl"
#include "techniques/photon_splatting/splat_view_types.h"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(SplatListParams, LW_SPLAT_LIST_PARAMS)
LW_SPLATS_READ(0, 0)
layout(set = 0, binding = 1) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 2) readonly buffer BoundsBuffer { SplatBounds data[]; } bounds;
layout(set = 0, binding = 3) readonly buffer TileBuffer { SplatTile data[]; } tiles;
layout(set = 0, binding = 4) buffer PartBuffer { uint data[]; } part_counts;  // 0 before

#include "shaders/linear_dispatch.glsl"
#include "techniques/photon_splatting/splat_cover.glsl"

void main() {
  uint part = linear_invocation();
  SplatVisit visit;
  if (!begin_visits(part, true, visit)) return;
  do {
    // No other invocation writes here.
    uint counter = (visit.tile.y * params.tiles.x + visit.tile.x) * params.parts + part;
    if (may_light(visit)) part_counts.data[counter] = min(part_counts.data[counter] + 1, params.most);
  } while (next_visit(visit));
}
