// The faces of a scene's voxels: of every cell that triangles meet, one for each of the six directions that a side of
// theirs looks in (passes/voxelize). All surfaces have two sides. Faces have slots, numbers from 0 in order of their
// cells; who keeps something a face keeps it in a buffer by slot, and finds the slot of a point on a surface with
// face_at() of voxel_faces.glsl. Triangles without an area, and those that are not finite, have no faces.
//
// What stands and what moves is voxelised apart: while something moves only that is done again, and where no triangle
// is elsewhere nothing is recorded at all. Large scenes have nested levels of voxels (voxel_levels_types.h), and faces
// in all of them. The same triangles give the same bytes.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "graph/frame_graph.h"
#include "passes/gpu_scene/gpu_scene.h"
#include "passes/voxel_faces/voxel_faces_types.h"
#include "passes/voxel_grid/voxel_levels.h"
#include "passes/world/world.h"

namespace lightwell {

struct VoxelFaceSettings {
  VoxelLevelSettings levels;
  bool areas = false;          // also the area of the surface in each face
  std::uint32_t capacity = 0;  // faces that there is room for at most; 0: kFaceCapacityLimit
};

// This frame's. Slots in use, and their number, are in `counts` on the device; what buffers hold beyond is undefined.
struct VoxelFaces {
  VoxelLevels levels;
  std::uint32_t capacity = 0;  // faces that there is room for
  BufferHandle table;          // uint a cell: where its faces are, see voxel_faces_types.h
  BufferHandle keys;           // uint a face: 8 * cell index + direction
  BufferHandle before;         // uint a face: its slot last frame, or kNoFace; only where `moved`
  BufferHandle areas;          // uint a face: fixed point, see voxel_faces_types.h; only where asked for
  BufferHandle counts;         // uint, words as in voxel_faces_types.h
  bool fresh = false;          // nothing of last frame's faces is known: all state kept by slot is void
  bool moved = false;          // slots differ from last frame's, or cells came into view: carry state along `before`
};

// The triangles that stand, as long as this is equal.
struct StandingTriangles {
  std::uint64_t revision = 0;
  std::uint32_t moving_first = 0;
  std::uint32_t moving_count = 0;
  friend bool operator==(const StandingTriangles&, const StandingTriangles&) = default;
};

// How much room there is, and was needed in the last frame that is known to be complete.
struct FaceRoom {
  std::uint64_t capacity = 0;
  std::uint32_t found = 0;
  std::uint32_t stored = 0;  // of them
  bool warned = false;
};

// What outlives a frame beside the graph's histories. Keep it until the frame was recorded or dropped.
struct VoxelFaceMemory {
  std::optional<VoxelLevels> levels;          // that the kept faces lie in; none: there are none
  std::uint32_t capacity = 0;                 // faces that there was room for
  SceneRevisions revisions;                   // that they were made of
  std::optional<StandingTriangles> standing;  // that the kept cells of what stands were made of
  std::shared_ptr<FaceRoom> room = std::make_shared<FaceRoom>();
};

// Declares what it takes to have this frame's faces of all triangles of `scene`, in levels that hold `bounds` and lie
// about `focus` (keep_voxel_levels()). Where the levels' windows move, what stands is voxelised in what they newly
// show. Room for faces grows with need, up to settings.capacity: a frame that has more of them than there was room for
// lacks those of the finest levels' last cells, and a later one has room for them; slots change then as by motion.
// Beyond settings.capacity they stay left out, and a warning is logged, once a memory. The names of the histories are
// "voxel face ..." in the scope.
VoxelFaces record_voxel_faces(FrameGraph& graph, const GpuScene::Frame& scene, const Bounds& bounds,
                              const glm::vec3& focus, const VoxelFaceSettings& settings, VoxelFaceMemory& memory);

// Of the world's grid bounds, about its focus. Where it is cut all is fresh.
VoxelFaces record_voxel_faces(FrameGraph& graph, WorldFrame& world, const VoxelFaceSettings& settings,
                              VoxelFaceMemory& memory);

}  // namespace lightwell
