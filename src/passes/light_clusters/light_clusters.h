// Many light points, grouped into clusters that keep their identity from frame to frame: what light is sampled from
// where there are too many points to visit all.
#pragma once

#include <cstdint>

#include "graph/frame_graph.h"
#include "lightwell/scene.h"
#include "passes/light_clusters/light_clusters_types.h"

namespace lightwell {

// At most kMostClusters clusters, by place and direction of the normal.
struct LightClusters {
  BufferHandle order;     // uvec2: key of the cluster and number of the point, one a point, sorted
  BufferHandle points;    // glsl::LightPoint, in that order
  BufferHandle running;   // float: luminance of a cluster's points up to and with this one, W
  BufferHandle clusters;  // glsl::LightCluster, by rising key
  BufferHandle counts;    // kClusterCountWords words
  std::uint32_t point_count = 0;
};

// Of the first `count` of `points` (glsl::LightPoint), at most glsl::kMostLightPoints; those without light belong to no
// cluster. `bounds`: of the cells that the clusters' keys count.
LightClusters record_light_clusters(FrameGraph& graph, BufferHandle points, std::uint32_t count, const Bounds& bounds);

}  // namespace lightwell
