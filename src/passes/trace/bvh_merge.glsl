// Merges clusters. The including kernel declares `lows`, `highs` (bvh_leaf_nodes.comp), writable, and
//   layout(set = 0, binding = n) writeonly buffer SizeBuffer { uint data[]; } sizes;  // triangles below an inner node
#ifndef LIGHTWELL_BVH_MERGE_GLSL
#define LIGHTWELL_BVH_MERGE_GLSL

uint triangles_below(uint node) { return node < params.count ? 1 : sizes_at(node - params.count); }

void make_inner_node(uint node, uint left, uint right) {
  uvec4 low_left = lows_at(left);
  uvec4 low_right = lows_at(right);
  uvec4 high_left = highs_at(left);
  uvec4 high_right = highs_at(right);
  lows_store(node, uvec4(floatBitsToUint(min(uintBitsToFloat(low_left.xyz), uintBitsToFloat(low_right.xyz))), left));
  highs_store(node, uvec4(floatBitsToUint(max(uintBitsToFloat(high_left.xyz), uintBitsToFloat(high_right.xyz))), right));
  sizes_store(node - params.count, triangles_below(left) + triangles_below(right));
}

#endif
