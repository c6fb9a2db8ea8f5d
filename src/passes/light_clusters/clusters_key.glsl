// How keys are cut into clusters. The including kernel declares
//   layout(set = 0, binding = n) readonly buffer CountBuffer { uint data[]; } counts;
#ifndef LIGHTWELL_CLUSTERS_KEY_GLSL
#define LIGHTWELL_CLUSTERS_KEY_GLSL

// The shift with the most clusters that are not too many.
uint cluster_shift_index() {
  if (counts.data[kClustersAtShift] <= kMostClusters) return 0;
  return counts.data[kClustersAtShift + 1] <= kMostClusters ? 1 : 2;
}

uint cluster_count() { return min(counts.data[kClustersAtShift + cluster_shift_index()], kMostClusters); }

#endif
