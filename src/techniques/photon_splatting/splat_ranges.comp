// Where each tile's list begins and ends. Where all are longer than their buffer, they are thinned: of 2^shift splats
// in succession one stays and counts for all.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/photon_splatting/splat_view_types.h"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(SplatListParams, LW_SPLAT_LIST_PARAMS)
layout(set = 0, binding = 0) readonly buffer SumBuffer { uint data[]; } sums;
layout(set = 0, binding = 1) readonly buffer BlockBuffer { uvec2 data[]; } blocks;
layout(set = 0, binding = 2) writeonly buffer RangeBuffer { uvec2 data[]; } ranges;
layout(set = 0, binding = 3) writeonly buffer TotalBuffer { uvec2 total; } totals;  // entries wanted, shift

#include "shaders/linear_dispatch.glsl"
#include "techniques/photon_splatting/splat_places.glsl"

void main() {
  uint tile = linear_invocation();
  uint count = params.tiles.x * params.tiles.y;
  uint total = place_of(count * params.parts);
  uint shift = thinning_shift(total);
  if (tile == 0) totals.total = uvec2(total, shift);
  if (tile >= count) return;
  ranges.data[tile] = uvec2(thinned(place_of(tile * params.parts), shift),
                            thinned(place_of((tile + 1) * params.parts), shift));
}
