// One cluster each: bounds, mean normal, and the running sums of its points' light. An invocation a point; those where a
// cluster begins do the work, always in the same order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_clusters/light_clusters_params.h"
#include "passes/sort/sort_types.h"
#include "shaders/light_point.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer KeyBuffer { uvec2 data[]; } keys;
layout(set = 0, binding = 1) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 2) readonly buffer FlagBuffer { uint data[]; } flags;
layout(set = 0, binding = 3) readonly buffer RankBuffer { uint data[]; } ranks;
layout(set = 0, binding = 4) readonly buffer BlockBuffer { uvec2 data[]; } blocks;
layout(set = 0, binding = 5) readonly buffer PointBuffer { LightPoint data[]; } points;  // in order
layout(set = 0, binding = 6) writeonly buffer RunningBuffer { float data[]; } running;
layout(set = 0, binding = 7) writeonly buffer ClusterBuffer { LightCluster data[]; } clusters;

#include "passes/light_clusters/clusters_key.glsl"
#include "shaders/light_point.glsl"
#include "shaders/linear_dispatch.glsl"
#include "shaders/luminance.glsl"

void main() {
  uint first = linear_invocation();
  bool begins = first < params.point_count && flags.data[first] != 0;
  if (!begins) return;
  uint shift = 3 * cluster_shift_index();
  uint key = keys.data[first].x >> shift;
  vec3 low = vec3(3e38);
  vec3 high = vec3(-3e38);
  vec3 normal = vec3(0.0);
  float flux = 0.0;
  uint end = first;
  do {
    LightPoint point = points.data[end];
    float light = luminance(point.flux);
    low = min(low, point.position);
    high = max(high, point.position);
    normal += light * unpack_unit_vector(point.normal);
    flux += light;
    running.data[end] = flux;
    ++end;
  } while (end < params.point_count && keys.data[end].x >> shift == key && keys.data[end].x != kNoClusterKey);

  LightCluster cluster;
  cluster.center = 0.5 * (low + high);
  cluster.radius = 0.5 * length(high - low);
  cluster.cosine = min(length(normal) / max(flux, 1e-37), 1.0);
  cluster.axis = normal / max(length(normal), 1e-37);
  cluster.first = first;
  cluster.count = end - first;
  cluster.key = key << shift;
  cluster.flux = flux;
  uint rank = ranks.data[first] + blocks.data[first / kScanBlock].x;
  if (rank < kMostClusters) clusters.data[rank] = cluster;
}
