// World part of preset `best`: light on the faces of voxels, kept from frame to frame.
#pragma once

#include <cstdint>
#include <optional>

#include "passes/sampled_lights/direct_sources.h"
#include "passes/voxel_faces/voxel_faces.h"
#include "passes/world/world.h"
#include "techniques/ray_traced_voxels/cache_types.h"
#include "techniques/technique.h"

namespace lightwell {

enum class LightInjection : std::uint8_t { kCamera, kLight };

struct LightCacheOptions {
  int resolution = 1;         // 32 << resolution voxels along each side of a level
  float finest_cell = 0.25f;  // m; 0: one level
  int memory = 1024;          // MiB
  LightInjection inject = LightInjection::kCamera;
  int light_paths = 16384;
  int links = 32;     // rays that a face remembers
  int history = 128;  // frames
};

class LightCacheWorld final : public TechniqueWorld {
 public:
  explicit LightCacheWorld(const LightCacheOptions& options) : options_(options) {}

  static void describe(OptionVisitor& visitor, LightCacheOptions& options);

  void record_world(FrameGraph& graph, WorldFrame& world) override;
  BufferHandle record_points(FrameGraph& graph, WorldFrame& world, const Points& points) override;

  // Of this frame, for views.
  bool from_lights() const { return options_.inject == LightInjection::kLight; }
  const VoxelFaces& faces() const { return faces_; }
  BufferHandle shown() const { return shown_; }
  const DirectSources& sources() const { return sources_; }
  const glsl::CacheParams& params() const { return params_; }  // without what belongs to a view
  BufferHandle indirect() const { return indirect_; }
  // What kernels bind that read indirect light and ask for more, ...
  ComputePass& ask_cache(ComputePass& pass);
  // ... and those that also read the other light and add to it.
  ComputePass& inject_cache(ComputePass& pass);

 private:
  void find_light(FrameGraph& graph, const WorldFrame& world);
  void record_deposit(FrameGraph& graph, WorldFrame& world);
  void record_gather(FrameGraph& graph, WorldFrame& world);

  LightCacheOptions options_;
  VoxelFaceMemory face_memory_;
  // Of last frame.
  std::optional<SceneRevisions> revisions_;
  glm::ivec3 last_center_{0};  // of the levels
  // Of this frame.
  VoxelFaces faces_;
  DirectSources sources_;
  glsl::CacheParams params_{};
  BufferHandle face_light_;  // glsl::FaceLight a face
  BufferHandle votes_;       // uint a face
  BufferHandle injected_;    // glsl::kInjectWords uints a face
  BufferHandle links_;       // uvec2 a link, params_.link_count a face
  BufferHandle shown_;       // glsl::kShownWords vec4 a face
  BufferHandle indirect_;    // vec4 a face
};

}  // namespace lightwell
