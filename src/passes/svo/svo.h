// A sparse voxel octree of the scene (Sun 2015, sections 3.1 and 4.3), built on the device from this frame's triangles
// without read-back: a list of occupied cells, then level by level nodes that are flagged, allocated and initialised.
// Beside it a grid of bits, a bit a cell, that finds the list's doubles; with coarser levels of itself it answers rays
// by itself, and faster.
//
// Of a large scene the grid has levels (svo_levels.h): fine cells about a point of interest, coarser ones beyond. The
// tree is one, deeper there.
//
// Kernels that trace bind Svo::set and include passes/svo/svo_trace.glsl (published traversal) or
// passes/svo/voxel_trace.glsl (ours). Layout of all buffers: passes/svo/svo_types.h.
#pragma once

#include <cstdint>

#include "graph/frame_graph.h"
#include "passes/gpu_scene/gpu_scene.h"
#include "passes/svo/svo_levels.h"
#include "passes/svo/svo_memory.h"
#include "passes/svo/svo_types.h"
#include "passes/voxel_grid/voxel_grid.h"

namespace lightwell {

// Which cells count as occupied.
enum class SvoVoxels : std::uint8_t {
  kRasterised,   // published: those whose centre line along the triangle's main axis meets it; leaves holes
  kConservative  // ours: all that a triangle meets (passes/voxelize)
};

struct SvoSettings {
  std::uint32_t resolution = 128;  // cells a side of each level: a power of two, 8 to 1024
  SvoVoxels voxels = SvoVoxels::kConservative;
  std::uint64_t budget = std::uint64_t{256} << 20;  // bytes of all buffers, those of the build included
  bool tree = true;                                 // false: the bit grid alone, enough for voxel_trace.glsl
  bool records = false;                             // each occupied leaf gets a SvoRecord
  float epsilon = 1.8f;  // by which svo_restart_blocked() shortens a ray at both ends, sides of a leaf there
  // Levels about `focus` are added until cells are no larger, m; 0: one grid, as kRasterised and records want it.
  float finest_cell = 0.0f;
  glm::vec3 focus{0.0f};  // m
};

// This frame's. Whether the tree is as fine as its grid stands in `counts` on the device.
struct Svo {
  SvoMemory memory;      // memory.level less than asked for where the budget held no more
  SvoLevels levels;      // of the bits: 2^memory.level cells a side of each
  VoxelGrid grid;        // of the coarsest level
  BufferHandle bits;     // uint
  BufferHandle coarse;   // uint
  BufferHandle counts;   // uint, words as in svo_types.h; only the number of occupied cells without a tree
  BufferHandle nodes;    // uvec4; none without a tree
  BufferHandle records;  // glsl::SvoRecord, by a node's second word; none where not asked for
  SetHandle set;         // set 3 of kernels that trace
};

// Of all triangles of `scene` inside `bounds`, over which the grid is laid (keep_svo_levels). The buffers are
// histories: `unchanged` says that the triangles and `bounds` are those of the last frame, whose levels were `last`,
// and then nothing is built where they still hold the tree. Where a level's window moves, all is built anew.
Svo record_svo(FrameGraph& graph, const GpuScene::Frame& scene, const Bounds& bounds, const SvoSettings& settings,
               bool unchanged = false, const SvoLevels* last = nullptr);

}  // namespace lightwell
