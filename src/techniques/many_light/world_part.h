// What all views share of many_light: light points, their clusters, and voxels for shadows.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "passes/light_clusters/light_clusters.h"
#include "passes/light_paths/light_paths.h"
#include "passes/rsm/rsm.h"
#include "passes/svo/svo.h"
#include "techniques/technique.h"

namespace lightwell {

// Who says whether something is between a receiver and a light point.
enum class Visibility {
  kTriangles,   // rays against the scene's triangles: exact
  kVoxels,      // rays through voxels
  kSvoRestart,  // the same as published: down from the octree's root for every node
  kNone         // everything sees everything
};

struct ManyLightWorldOptions {
  int paths = 4096;    // whose first surfaces are the light points of the first bounce
  int bounces = 8;     // light points a path, at most
  int rsm_size = 256;  // texels a side and view
  int rsm_lights = 0;  // up to so many lights start their paths from reflective shadow maps
  Visibility visibility = Visibility::kTriangles;
  float epsilon = 1.8f;      // by which rays through the octree are shortened at both ends, voxels
  int resolution = 3;        // of the voxels: one of kResolutions
  float finest_cell = 0.1f;  // m: levels are added until voxels are no larger; 0: one level
  int svo_memory = 512;      // MiB
  bool published = false;    // the published sequence, the same light paths in every frame, no clusters
};

void describe_world_options(OptionVisitor& visitor, ManyLightWorldOptions& options);

class ManyLightWorld final : public TechniqueWorld {
 public:
  explicit ManyLightWorld(const ManyLightWorldOptions& options);

  void record_world(FrameGraph& graph, WorldFrame& world) override;

  // Of this frame, for views.
  const ManyLightWorldOptions& options() const { return options_; }
  const ReflectiveShadowMaps::Frame& rsm() const { return rsm_; }
  BufferHandle points() const { return points_; }  // glsl::LightPoint, paths * bounces
  const Svo& svo() const { return svo_; }          // where the visibility needs voxels
  const LightClusters& clusters() const { return clusters_; }
  // Last frame's paths as they were, and followed again in this frame's scene; empty where nothing has changed, or
  // where there is no last frame.
  BufferHandle last_points() const { return last_points_; }
  BufferHandle replayed_points() const { return replayed_points_; }

 private:
  void record_voxels(FrameGraph& graph, WorldFrame& world);
  void watch_voxels(FrameGraph& graph, std::uint32_t resolution);

  ManyLightWorldOptions options_;
  ReflectiveShadowMaps rsm_maker_;
  ReflectiveShadowMaps::Frame rsm_;
  BufferHandle points_;
  LightClusters clusters_;
  Svo svo_;
  std::shared_ptr<bool> warned_ = std::make_shared<bool>(false);  // that the voxels are coarser than asked for
  BufferHandle last_points_, replayed_points_;
  SceneRevisions revisions_;  // of the last recorded frame
  std::optional<SvoLevels> last_levels_;
  std::uint32_t last_round_ = 0;  // of its paths
  std::vector<FocusBall> last_aims_;
};

// What the clusters' cells divide: the scene, of a large one what is about the focus. Light points beyond belong to the
// outermost cells.
Bounds cluster_bounds(const WorldFrame& world);

// Pictures of what the world part made, for one view: light points, reflective shadow maps, octree.
void add_world_views(FrameGraph& graph, const ManyLightWorld& world, const ViewFrame& view,
                     std::vector<DebugView>& views);

}  // namespace lightwell
