// Makes wide nodes of binary ones, from the root down. A binary inner node that becomes a wide node is marked. The
// including kernel declares
//   layout(set = 0, binding = n) readonly buffer LowBuffer { uvec4 data[]; } lows;       // bvh_leaf_nodes.comp
//   layout(set = 0, binding = n) readonly buffer HighBuffer { uvec4 data[]; } highs;
//   layout(set = 0, binding = n) readonly buffer SizeBuffer { uint data[]; } sizes;
//   layout(set = 0, binding = n) buffer MarkBuffer { uint data[]; } marks;               // an inner node: 1 or 0
//   layout(set = 0, binding = n) buffer FirstBuffer { uint data[]; } firsts;             // first slot below a node
//   layout(set = 0, binding = n) writeonly buffer ChildBuffer { uvec4 data[]; } children;  // binary nodes below an inner one
//   layout(set = 0, binding = n) writeonly buffer TriangleBuffer { uvec4 data[]; } triangles;  // bvh_types.h
#ifndef LIGHTWELL_BVH_COLLAPSE_GLSL
#define LIGHTWELL_BVH_COLLAPSE_GLSL

uint triangles_below(uint node) { return node < params.count ? 1 : sizes_at(node - params.count); }

float area_of(uint node) {
  vec3 size = uintBitsToFloat(highs_at(node).xyz) - uintBitsToFloat(lows_at(node).xyz);
  return size.x * (size.y + size.z) + size.y * size.z;
}

// Writes the triangles of a leaf into its slots.
void fill_slots(uint node, uint slot) {
  uint open[kBvhLeafTriangles];
  open[0] = node;
  uint open_count = 1;
  for (uint step = 0; step < 2 * kBvhLeafTriangles && open_count > 0; ++step) {
    uint next = open[--open_count];
    uint left = lows_at(next).w;
    uint right = highs_at(next).w;
    if (next < params.count) {
      triangles_store(kBvhTriangleWords * (params.slot_first + slot++), uvec4(0, 0, 0, left));
    } else {
      open[open_count++] = right;
      open[open_count++] = left;
    }
  }
}

// The largest child that is no leaf is replaced by its two, until there are four.
void collapse_node(uint inner) {
  uint node = params.count + inner;
  uvec4 child = uvec4(lows_at(node).w, highs_at(node).w, kBvhNothing, kBvhNothing);
  for (uint count = 2; count < 4; ++count) {
    uint largest = kBvhNothing;
    float largest_area = -1.0;
    for (uint i = 0; i < count; ++i) {
      float area = area_of(child[i]);
      if (triangles_below(child[i]) > kBvhLeafTriangles && area > largest_area) {
        largest = i;
        largest_area = area;
      }
    }
    if (largest == kBvhNothing) break;
    uint opened = child[largest];
    child[largest] = lows_at(opened).w;
    child[count] = highs_at(opened).w;
  }
  children_store(inner, child);
  uint slot = firsts_at(node);
  for (uint i = 0; i < 4; ++i) {
    if (child[i] == kBvhNothing) break;
    uint below = triangles_below(child[i]);
    firsts_store(child[i], slot);
    if (below > kBvhLeafTriangles) {
      marks_store(child[i] - params.count, 1);
    } else {
      fill_slots(child[i], slot);
    }
    slot += below;
  }
}

// Inner node `i` of those made in a round of merging, if it is a wide node.
void collapse_round(uint round, uint i) {
  uint inner = state.data[kBvhRounds + 4 * round + 3] + i;
  if (inner < state.data[kBvhRounds + 4 * round + 7] && marks_at(inner) != 0) collapse_node(inner);
}

#endif
