// Writes the lists: a tile's splats part by part, and so in the order of their numbers, whichever invocation is first.
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
layout(set = 0, binding = 4) buffer PartBuffer { uint data[]; } part_counts;  // splats still to write
layout(set = 0, binding = 5) readonly buffer SumBuffer { uint data[]; } sums;
layout(set = 0, binding = 6) readonly buffer BlockBuffer { uvec2 data[]; } blocks;
layout(set = 0, binding = 7) writeonly buffer EntryBuffer { uint data[]; } entries;

#include "shaders/linear_dispatch.glsl"
#include "techniques/photon_splatting/splat_cover.glsl"
#include "techniques/photon_splatting/splat_places.glsl"

void main() {
  uint part = linear_invocation();
  uint shift = thinning_shift(place_of(params.tiles.x * params.tiles.y * params.parts));
  SplatVisit visit;
  if (!begin_visits(part, false, visit)) return;
  // From the last splat to the first, since places are counted down.
  do {
    uint counter = (visit.tile.y * params.tiles.x + visit.tile.x) * params.parts + part;
    uint left = part_counts.data[counter];
    if (left > 0 && may_light(visit)) {
      uint place = place_of(counter) + left - 1;
      part_counts.data[counter] = left - 1;
      if (thinned(place, shift) << shift == place) entries.data[place >> shift] = visit.id;
    }
  } while (next_visit(visit));
}
