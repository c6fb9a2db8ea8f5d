// The passes that build and refit a bounding volume hierarchy on the device. Layout: passes/trace/bvh_types.h.
#pragma once

#include <cstdint>
#include <string_view>

#include "graph/frame_graph.h"
#include "passes/gpu_scene/gpu_scene.h"

namespace lightwell {

// What one of the two hierarchies covers: the scene's triangles without [gap_first, gap_first + gap_count), `count` of
// them.
struct BvhPart {
  std::uint32_t count = 0;
  std::uint32_t gap_first = 0;
  std::uint32_t gap_count = 0;
  std::uint32_t node_first = 1;
  std::uint32_t slot_first = 0;
  std::uint32_t root_word = 0;
};

struct BvhBuffers {
  BufferHandle nodes;       // uvec4, kBvhNodeWords a node; of both hierarchies
  BufferHandle triangles;   // uvec4, kBvhTriangleWords a triangle; of both
  BufferHandle levels;      // uint, kBvhLevelWords
  BufferHandle node_boxes;  // vec4, two a node
};

// Wide nodes that n triangles need at most: a node whose children are all leaves holds 3 triangles or more, so there
// are at most n / 3; every other has four children, so there are at most (n - n / 3) / 3 of them: 5/9 n together.
std::uint32_t bvh_node_capacity(std::uint32_t triangles);

// Topology and boxes anew.
void record_bvh_build(FrameGraph& graph, const GpuScene::Frame& scene, const BvhPart& part, BvhBuffers& buffers);

// The same topology round the triangles as they are now.
void record_bvh_refit(FrameGraph& graph, const GpuScene::Frame& scene, const BvhPart& part, BvhBuffers& buffers);

}  // namespace lightwell
