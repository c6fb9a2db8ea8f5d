// What all views share of photon_splatting: photons where they meet their second surface, bundled, each with an
// orthographic shadow map of its surroundings.
#pragma once

#include <cstdint>

#include "graph/frame_graph.h"
#include "passes/rsm/rsm.h"
#include "techniques/photon_splatting/photon_guide.h"
#include "techniques/photon_splatting/shadow_atlas.h"
#include "techniques/photon_splatting/stratify.h"
#include "techniques/technique.h"

namespace lightwell {

// How wide the kernel and the map of a splat are.
enum class SplatWidth : std::uint8_t {
  kFixed,    // alike, but that a bundle of m photons takes m times the area
  kAdaptive  // by the area that a photon stands for
};

struct PhotonOptions {
  int photons = 16384;        // light paths; each sends a photon on from every surface that it meets
  int bounces = 5;            // surfaces that a path meets at most before the splat's; 1: light that bounced once
  int rsm_size = 256;         // texels a side and view
  int rsm_lights = 0;         // up to so many lights start their paths from reflective shadow maps
  bool same_photons = false;  // in every frame
  bool guide = false;         // more photons start where views have seen such; not with maps, bundles, same_photons

  int stratify = 0;      // none, or a grid of 8 << stratify cells along the longest axis of the world's grid bounds
  int threshold = 2;     // photons; a cell with fewer merges with its block of 2 x 2 x 2
  int merge_levels = 1;  // how often such blocks merge again
  Representative representative = Representative::kRandom;

  SplatWidth width_mode = SplatWidth::kAdaptive;
  float width = 0.01f;           // of kernels and maps, kFixed: part of the diagonal of the world's grid bounds
  float kernel_photons = 24.0f;  // that a kernel holds about, kAdaptive
  float least_width = 0.002f;    // part of the diagonal; less only on surfaces finer than the texels of their maps
  float most_width = 0.1f;
  float step_back = 0.01f;  // reach of the maps without receiver test: part of the diagonal
  SplatKernel kernel = SplatKernel::kBox;
  int map_size = 0;           // 4 << map_size texels a side
  bool receiver_test = true;  // splats light what their rays meet on the surface that they end on, and nothing else
  bool progressive = false;   // kernels shrink while the scene stays as it is
};

// Of the world.
void describe_photon_options(OptionVisitor& visitor, PhotonOptions& options);

class PhotonWorld final : public TechniqueWorld {
 public:
  explicit PhotonWorld(const PhotonOptions& options) : options_(options) {}

  void record_world(FrameGraph& graph, WorldFrame& world) override;

  // Of this frame, for views.
  const PhotonOptions& options() const { return options_; }
  // glsl::StoredSplat, capacity() of them: in pages (shaders/paged_buffer.glsl). Those in use come first; some of these
  // may have no flux.
  BufferHandle splats() const { return splats_; }
  // uint: the number of splats in use, and the indirect dispatch (shaders/linear_dispatch.glsl) of an invocation each
  // in groups of 64.
  BufferHandle splat_counts() const { return splat_counts_; }
  std::uint32_t capacity() const { return capacity_; }
  // Lets this frame's splats that a view sees decide where the next frame's photons start. Nothing without a guide.
  void vote(FrameGraph& graph, const SplatScreen& screen, const Splats& splats) {
    if (strata_) guide_.vote(graph, screen, splats, strata_);
  }
  // R32F; a texel is the distance, m, from the plane at -reach along the ray to the first surface that the parallel ray
  // through the texel's middle meets; 2 * reach or more where there is none before. With the receiver test the ray
  // begins on the plane of the surface that the photon left, and the texel is 0 unless it meets the surface that the
  // splat ends on: behind it everything is dark. Maps of splats without flux are undefined. Map m's texel (0, 0):
  // map_corner() of shadow_atlas.glsl.
  ImageHandle shadow_atlas() const { return shadow_atlas_; }
  std::uint32_t map_side() const { return layout_.map_side; }          // texels
  std::uint32_t maps_per_row() const { return layout_.maps_per_row; }  // of the atlas
  // The photons where they start, for debug views: glsl::LightPoint, of one round of paths.
  BufferHandle light_points() const { return light_points_; }
  std::uint32_t light_point_count() const { return light_point_count_; }

 private:
  // Paths a round and rounds a frame.
  struct Rounds {
    std::uint32_t paths = 16;
    std::uint32_t count = 1;
  };
  void note_changes(const WorldFrame& world);
  Rounds fit(const WorldFrame& world);
  SizedLightPaths record_paths(FrameGraph& graph, WorldFrame& world, std::uint32_t paths, std::uint32_t round,
                               LightPathGuide* guide = nullptr);
  SizedLightPaths record_all_paths(FrameGraph& graph, WorldFrame& world, const Rounds& rounds, std::uint32_t first);

  PhotonOptions options_;
  ReflectiveShadowMaps rsm_maker_;
  ReflectiveShadowMaps::Frame rsm_;
  PhotonGuide guide_;
  BufferHandle splats_, splat_counts_, light_points_;
  BufferHandle strata_;  // of splats; empty without a guide
  ImageHandle shadow_atlas_;
  SplatMapLayout layout_;
  std::uint32_t capacity_ = 0;
  std::uint32_t light_point_count_ = 0;
  SceneRevisions revisions_;        // of the last frame
  std::uint32_t still_frames_ = 0;  // for which they have been those
  float shrinking_ = 1.0f;          // area of this frame's kernels over that of the first one's
  bool warned_ = false;             // that there is no room for all maps
};

}  // namespace lightwell
