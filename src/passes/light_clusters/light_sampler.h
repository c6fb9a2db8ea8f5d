// Samples light points for receivers, in proportion to about what light they bring: a few shadow rays a receiver then
// do for thousands of points. The mean over frames is exact: what is learned and guessed only says where to look.
#pragma once

#include <cstdint>

#include "graph/frame_graph.h"
#include "passes/gbuffer/gbuffer.h"
#include "passes/light_clusters/light_clusters.h"

namespace lightwell {

// Places where light is gathered, one a texel.
struct Receivers {
  ImageHandle position;  // RGBA32F: xyz m; w: 0 where there is none, else what the rays' clearance is in proportion to
  ImageHandle normal;    // RGBA16F: xyz unit
  ImageHandle face;      // of the triangle itself: xy, octahedral
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  float clearance = 0.0f;  // of rays above the surface, m for each unit of position.w
};

Receivers receivers_of(const GBuffer& gbuffer, float clearance);

// Which part of each cluster's light arrives in which part of the scene: tallied by those who trace the rays
// (learned_visibility.glsl), by integers, so that the order does not matter.
struct LearnedVisibility {
  BufferHandle table;
};

// A history of the view's, brought up to this frame: last frame's rays are added.
LearnedVisibility record_learned_visibility(FrameGraph& graph);

// Light points that are closer count as if they were part * clamp(d, nearest, farthest) away, where d is the distance
// of the point from `focus`: where a large scene is looked at light points lie closely, far from there widely. Without
// effect as it is.
struct LightClamp {
  glm::vec3 focus{0.0f};  // m
  float part = 1.0f;
  float nearest = 0.0f;   // m
  float farthest = 0.0f;  // m
};

// Fills what LW_CLAMP_PARAMS names.
template <class Params>
void set_clamp(const LightClamp& clamp, Params& params) {
  params.clamp_focus = clamp.focus;
  params.clamp_part = clamp.part;
  params.clamp_nearest = clamp.nearest;
  params.clamp_farthest = clamp.farthest;
}

// How probable each cluster is in each tile of 16 x 16 receivers.
struct LightTiles {
  BufferHandle tiles;         // glsl::LightTile
  BufferHandle distribution;  // vec2 a tile and cluster: running sum of probability, visibility
};

// `bounds`: as the clusters have them.
LightTiles record_light_tiles(FrameGraph& graph, const Receivers& receivers, const LightClusters& clusters,
                              const LearnedVisibility& learned, const LightClamp& clamp, const Bounds& bounds);

struct LightChoiceSettings {
  std::uint32_t candidates = 16;    // compared for each choice; time in proportion
  std::uint32_t rays = 1;           // choices a receiver
  std::uint32_t first_sample = 0;   // of each receiver's sequence; `rays` of them are used
  std::uint32_t sequence = 0;       // different ones are independent
  std::uint32_t most_bounces = 64;  // points whose light has met more surfaces are left out
  LightClamp clamp;
};

// RGBA32UI, the choices of a receiver one below the other (y + ray * height): words as in light_clusters_types.h. The
// light of the chosen point, times its weight, times its visibility, is an estimate of all points' light.
ImageHandle record_light_choice(FrameGraph& graph, const Receivers& receivers, const LightClusters& clusters,
                                const LightTiles& tiles, const LightChoiceSettings& settings);

}  // namespace lightwell
