// Brings the boxes of wide nodes to where their triangles are. The including kernel declares
//   layout(set = 0, binding = n) readonly buffer LevelBuffer { uint data[]; } levels;       // bvh_types.h
//   layout(set = 0, binding = n) readonly buffer TriangleBuffer { uvec4 data[]; } triangles;
//   layout(set = 0, binding = n) buffer NodeBuffer { uvec4 data[]; } nodes;
//   layout(set = 0, binding = n) buffer NodeBoxBuffer { vec4 data[]; } node_boxes;          // a node: low, high; relative
#ifndef LIGHTWELL_BVH_REFIT_GLSL
#define LIGHTWELL_BVH_REFIT_GLSL

struct Box {
  vec3 low, high;
};

Box leaf_box(uint reference) {
  uint first = kBvhTriangleWords * (reference & kBvhSlotMask);
  uint count = ((reference >> kBvhLeafCountShift) & 3u) + 1;
  Box box;
  box.low = box.high = uintBitsToFloat(triangles_at(first).xyz);
  for (uint i = 1; i < kBvhTriangleWords * count; ++i) {
    vec3 p = uintBitsToFloat(triangles_at(first + i).xyz);
    box.low = min(box.low, p);
    box.high = max(box.high, p);
  }
  return box;
}

Box child_box(uint reference) {
  if ((reference & kBvhLeafFlag) != 0) return leaf_box(reference);
  uint node = reference - params.node_first;
  return Box(node_boxes_at(2 * node).xyz, node_boxes_at(2 * node + 1).xyz);
}

// Exponent of the smallest power of two of which 255 steps span `size`, with some room for rounding.
uint step_exponent(float size) {
  uint bits = floatBitsToUint(size * (1.00001 / 255.0));
  return clamp((bits >> 23) + 1u, 1u, 254u);
}

float plane_at(float origin, float plane, float step_size) { return origin + plane * step_size; }

void fit_node(uint node) {
  uint word = kBvhNodeWords * (params.node_first + node);
  uvec4 references = nodes_at(word + 3);
  Box boxes[4];
  Box all_of_them;
  for (uint i = 0; i < 4; ++i) {
    if (references[i] == kBvhNothing) {
      boxes[i] = boxes[0];
      continue;
    }
    boxes[i] = child_box(references[i]);
    all_of_them.low = i == 0 ? boxes[0].low : min(all_of_them.low, boxes[i].low);
    all_of_them.high = i == 0 ? boxes[0].high : max(all_of_them.high, boxes[i].high);
  }
  uint exponents = 0;
  uint low_planes[3];
  uint high_planes[3];
  for (uint axis = 0; axis < 3; ++axis) {
    float origin = all_of_them.low[axis];
    uint exponent = step_exponent(all_of_them.high[axis] - origin);
    float step_size = uintBitsToFloat(exponent << 23);
    exponents |= exponent << (8 * axis);
    low_planes[axis] = high_planes[axis] = 0;
    for (uint i = 0; i < 4; ++i) {
      float low = boxes[i].low[axis];
      float high = boxes[i].high[axis];
      float below = clamp(floor((low - origin) / step_size), 0.0, 255.0);
      float above = clamp(ceil((high - origin) / step_size), 0.0, 255.0);
      if (plane_at(origin, below, step_size) > low) below -= 1.0;
      if (plane_at(origin, above, step_size) < high) above += 1.0;
      low_planes[axis] |= uint(below) << (8 * i);
      high_planes[axis] |= uint(above) << (8 * i);
    }
  }
  nodes_store(word, uvec4(floatBitsToUint(all_of_them.low), exponents));
  nodes_store(word + 1, uvec4(low_planes[0], low_planes[1], low_planes[2], high_planes[0]));
  nodes_store(word + 2, uvec4(high_planes[1], high_planes[2], 0, 0));
  node_boxes_store(2 * node, vec4(all_of_them.low, 0.0));
  node_boxes_store(2 * node + 1, vec4(all_of_them.high, 0.0));
}

// Node `i` of a level.
void fit_level(uint level, uint i) {
  uint node = levels.data[4 * level + 7] + i;
  if (node < levels.data[4 * level + 3]) fit_node(node);
}

#endif
