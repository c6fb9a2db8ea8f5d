// How each light sees the world, and where its shadow maps lie in the atlas.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lightwell/scene.h"
#include "passes/focus/focus_balls.h"
#include "passes/shadow_maps/atlas_layout.h"
#include "shaders/shadow_view.h"

namespace lightwell {

struct ShadowViews {
  std::vector<glsl::ShadowView> views;  // one a light, then the wider ones of lights that have several
  AtlasLayout atlas;
};

// How views are cut.
struct ViewFit {
  std::uint32_t guard = glsl::kShadowGuard;  // texels round a view beyond what it must show; 0: a cube's faces meet
  std::uint32_t whole_scene_factor = 4;      // a view of the whole scene has so many times tile_side a side: it covers
                                             // what hundreds of lamps' views do; views of balls have half of that
};

// `bounds` holds everything that casts shadows. A directional light sees it in one view. So do lights that are farther
// from the middle of `bounds` than these are long, in a view that is fitted to them. Where there are `balls`, both have
// a view of each ball besides, each linked to the next wider one and the last to that of the whole scene: a kilometre
// of ground round a house would leave the house no texels. `tile_side`: texels a view, see atlas_layout.h.
ShadowViews make_shadow_views(std::span<const WorldLight> lights, const Bounds& bounds,
                              std::span<const FocusBall> balls, std::uint32_t tile_side, std::uint32_t atlas_side,
                              const ViewFit& fit = {});

// World to clip space of a view, as shadow_clip() of shaders/shadow_view.glsl has it.
glm::mat4 clip_from_world(const glsl::ShadowView& view, std::uint32_t face);

}  // namespace lightwell
