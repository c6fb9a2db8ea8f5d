// How a light sees the world: what its shadow maps are drawn and looked up with. One element a light, in the lights'
// order, of the storage buffer `shadow_views`, and behind them the coarser views of those that have several:
//   layout(set = 0, binding = n) readonly buffer ShadowViewBuffer { ShadowView data[]; } shadow_views;
#ifndef LIGHTWELL_SHADERS_SHADOW_VIEW_H
#define LIGHTWELL_SHADERS_SHADOW_VIEW_H

#include "shaders/shared.h"

// ShadowView::kind
LW_CONSTANT(uint, kShadowNone, 0)
LW_CONSTANT(uint, kShadowPerspective, 1)   // one view: spots, and lights that see the whole scene in a narrow cone
LW_CONSTANT(uint, kShadowCube, 2)          // six faces: point lights and spots too wide for one view
LW_CONSTANT(uint, kShadowOrthographic, 3)  // one view of a directional light

LW_CONSTANT(uint, kMostShadowViews, 6)  // of one light, each within the next

// Texels round a tile that are drawn but never at the centre of a filter: a filter near the edge stays in its tile.
LW_CONSTANT(uint, kShadowGuard, 4)

#define LW_SHADOW_VIEW(MEMBER)                                                                             \
  MEMBER(mat4, to_shadow)   /* world to clip space; cube: a face's view of `position` to its clip space */ \
  MEMBER(vec3, position)    /* m; cube: where the faces meet */                                            \
  MEMBER(float, texel_size) /* world side of a texel in m; perspective and cube: at 1 m along the view */  \
  MEMBER(uvec2, tile)       /* upper left texel in the atlas; views follow: 3 in a row, 2 rows */          \
  MEMBER(uint, tile_side)   /* of one view, texels, guard included */                                      \
  MEMBER(uint, kind)        /* kShadow... */                                                               \
  MEMBER(uint, wider)       /* the element that sees more, where this one does not see enough; 0: none */  \
  MEMBER(uint, unused_0)                                                                                   \
  MEMBER(uint, unused_1)                                                                                   \
  MEMBER(uint, unused_2)
LW_STRUCT(ShadowView, LW_SHADOW_VIEW)

#endif
