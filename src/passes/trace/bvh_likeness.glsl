// Which clusters belong together (Meister and Bittner 2018). The including kernel declares `lows`, `highs` and
// `clusters` (bvh_leaf_nodes.comp).
#ifndef LIGHTWELL_BVH_LIKENESS_GLSL
#define LIGHTWELL_BVH_LIKENESS_GLSL

struct Box {
  vec3 low, high;
};

Box box_of(uint node) { return Box(uintBitsToFloat(lows_at(node).xyz), uintBitsToFloat(highs_at(node).xyz)); }

// Half the surface of the box round both.
float joint_area(Box a, Box b) {
  vec3 size = max(a.high, b.high) - min(a.low, b.low);
  return size.x * (size.y + size.z) + size.y * size.z;
}

// The cluster within the radius that makes the smallest box with cluster `i`. Among equals the one whose number differs
// from i in the lowest bit: an order of pairs, not of clusters, so that many equal boxes pair up all at once.
uint nearest_cluster(uint i, uint count, uint first) {
  Box own = box_of(clusters_at(first + i));
  uint nearest = i ^ 1u;
  if (nearest >= count) nearest = i - 1;
  float smallest = joint_area(own, box_of(clusters_at(first + nearest)));
  uint end = min(i + kBvhRadius, count - 1);
  for (uint j = i < kBvhRadius ? 0 : i - kBvhRadius; j <= end; ++j) {
    if (j == i) continue;
    float area = joint_area(own, box_of(clusters_at(first + j)));
    if (area < smallest || (area == smallest && (i ^ j) < (i ^ nearest))) {
      smallest = area;
      nearest = j;
    }
  }
  return nearest;
}

// The neighbour that takes no looking; the last of an odd number has none.
uint paired_cluster(uint i, uint count) { return min(i ^ 1u, count - 1); }

#endif
