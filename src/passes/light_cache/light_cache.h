// Light on the faces of voxels, kept from frame to frame: what several techniques answer rays and points with.
//
// * Faces (passes/voxel_faces): up to six a voxel, in nested levels, so that no two sides of a wall share light.
// * Asking (cache_vote.glsl). Who reads a face votes for a point of a surface in it. The face gathers from such points
//   in the next frames: they lie on the real surface, on the side that is seen, never inside a wall. Faces that nobody
//   has asked for in kFramesAwake frames do nothing.
// * Gathering (cache_gather.comp). An asked face sends shadow rays to sources of light, for its direct light, and
//   cosine-distributed rays; it remembers what its last ones have met: links.
// * Solution (cache_solve.comp). Light bounces along the links once a frame: settled light needs no new rays.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "lightwell/options.h"
#include "passes/light_cache/cache_types.h"
#include "passes/light_cache/link_pages.h"
#include "passes/sampled_lights/direct_sources.h"
#include "passes/view/view_frame.h"
#include "passes/voxel_faces/voxel_faces.h"
#include "passes/world/world.h"

namespace lightwell {

enum class LightInjection : std::uint8_t {
  kCamera,  // shadow rays from faces, and from where others meet them
  kLight    // rays from the lights
};

struct LightCacheOptions {
  int resolution = 64;           // voxels along each side of a level
  float finest_cell = 0.25f;     // m: levels are added until voxels are no larger; 0: one level
  int memory = 1024;             // MiB
  int links = 32;                // rays that a face remembers
  int links_per_frame = 1;       // rays that it sends in a frame
  int bounces_per_frame = 1;     // of light along links
  int turns = 1;                 // frames between two of a coarse level, at most
  bool rests = false;            // faces send no rays while nothing has changed for long
  bool sees_neighbours = false;  // faces find out which neighbours they may be read together with
  LightInjection inject = LightInjection::kCamera;
  int light_paths = 16384;  // a frame; kLight
  int history = 128;        // frames that a face's direct light counts
};

class LightCache {
 public:
  explicit LightCache(const LightCacheOptions& options) : options_(options) {}

  // Options that every technique offers, of the world.
  static void describe(OptionVisitor& visitor, LightCacheOptions& options);

  // Declares this frame's faces, and one round of gathering and solution for those that were asked for by then.
  void record(FrameGraph& graph, WorldFrame& world);
  // Another round, for those that were asked for since.
  void record_round(FrameGraph& graph, WorldFrame& world);

  // Faces and pages of links, and those that there was no room for, in the last frame that is known to be complete.
  std::map<std::string, std::uint64_t> counts() const;

  // Of this frame.
  bool from_lights() const { return options_.inject == LightInjection::kLight; }
  bool fresh() const { return fresh_; }  // nothing is known yet
  bool steady() const;                   // light that was asked for long ago changes no more; only where it rests
  const VoxelFaces& faces() const { return faces_; }
  BufferHandle shown() const { return shown_; }
  BufferHandle indirect() const { return indirect_; }
  const DirectSources& sources() const { return sources_; }
  const glsl::CacheParams& params() const { return params_; }  // without what belongs to a view
  // What kernels bind that read indirect light and ask for more, ...
  ComputePass& ask(ComputePass& pass);
  // ... and those that also read the other light and add to it.
  ComputePass& inject(ComputePass& pass);

  // Indirect irradiance (W/m^2) at the pixels of a view, read from the faces round them, which are asked for.
  ImageHandle record_look_up(FrameGraph& graph, const ViewFrame& view);
  // The same at listed points (glsl::SurfacePoint); a vec4 a point.
  BufferHandle record_points(FrameGraph& graph, BufferHandle points, std::uint32_t count);
  // What each pixel's face holds, as it is: indirect light, or light straight from sources.
  ImageHandle record_view(FrameGraph& graph, const ViewFrame& view, bool shows_indirect) const;

 private:
  void record_smooth(FrameGraph& graph);
  ComputePass& ask_smoothed(ComputePass& pass);
  void warn_of_albedo(const WorldFrame& world);
  void note_changes(const WorldFrame& world);
  std::uint32_t choose_rest() const;
  std::uint32_t frames_until_full() const;
  std::uint32_t frames_until_rest() const;
  LinkPageSettings page_settings() const;
  struct FaceState;
  static FaceState find_state(FrameGraph& graph, std::uint32_t side, std::uint32_t capacity);
  void find_light(FrameGraph& graph, const WorldFrame& world);
  void carry_light(FrameGraph& graph, const FaceState& before);
  void record_deposit(FrameGraph& graph, WorldFrame& world);
  glsl::CacheParams view_params(const ViewFrame& view) const;

  LightCacheOptions options_;
  bool warned_ = false;  // of albedo 1
  VoxelFaceMemory face_memory_;
  LinkPagePool page_pool_;
  // Of last frame.
  std::optional<SceneRevisions> revisions_;
  std::uint32_t capacity_ = 0;         // of faces
  std::uint32_t side_ = 0;             // of two sets of histories that take turns where slots change
  std::uint32_t last_slot_moves_ = 0;  // frames in which faces got other slots, so far
  std::uint32_t still_frames_ = 0;     // since something changed
  std::uint32_t still_surfaces_ = 0;   // since what links and nearby emitters depend on did
  std::uint32_t known_frames_ = 0;     // since nothing was known
  std::uint32_t still_windows_ = 0;    // since levels moved on
  std::uint32_t agreed_frames_ = 0;    // that lit faces are the mean of
  std::uint32_t sampled_frames_ = 0;   // that only direct light has been looked for
  // Of this frame.
  VoxelFaces faces_;
  DirectSources sources_;
  glsl::CacheParams params_{};
  bool fresh_ = false;
  std::uint32_t slot_moves_ = 0;
  BufferHandle face_light_;  // glsl::FaceLight a face
  BufferHandle votes_;       // glsl::kVoteWords uints a face
  BufferHandle injected_;    // glsl::kInjectWords uints a face
  LinkPages pages_;          // of links
  BufferHandle shown_;       // glsl::kShownWords vec4 a face
  BufferHandle indirect_;    // vec4 a face
  BufferHandle last_lit_;    // glsl::LitFace a face, of last frame
  BufferHandle kept_lit_;    // of this one, where it is smoothed
  bool is_smoothed_ = false;
};

}  // namespace lightwell
