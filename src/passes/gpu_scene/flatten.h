// The scene as flat arrays: what the GPU keeps of its geometry and materials.
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/scene.h"
#include "passes/gpu_scene/gpu_scene_types.h"
#include "passes/gpu_scene/part_bounds.h"
#include "passes/gpu_scene/world_vertices_params.h"

namespace lightwell {

// What instances of one primitive share: where it lies in the flat arrays.
struct FlatShape {
  std::uint32_t bounds = 0;  // its ShapeBounds
  std::uint32_t first_object_vertex = 0;
  std::uint32_t first_influence = 0;
  std::uint32_t joint_count = 0;  // that its influences ask for; 0: not skinned
  std::uint32_t first_morph_offset = 0;
  std::uint32_t morph_target_count = 0;
};

// One primitive of one instance.
struct FlatPart {
  FlatShape shape;
  std::uint32_t instance = 0;
  std::uint32_t primitive = 0;     // of the instance's mesh
  std::uint32_t material = 0;      // the default material's index follows the scene's
  bool has_holes = false;          // where its material's alpha cuts them
  bool emits = false;              // light
  std::uint32_t first_vertex = 0;  // of the world vertices
  std::uint32_t vertex_count = 0;
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
};

struct FlatGeometry {
  std::vector<glsl::ObjectVertex> object_vertices;  // of all primitives
  std::vector<glsl::Influence> influences;          // one a vertex of those primitives that have joints
  std::vector<glsl::MorphOffset> morph_offsets;     // of all primitives, one a vertex, target by target
  std::vector<glsl::VertexSource> sources;          // one a world vertex
  std::vector<ShapeBounds> shape_bounds;
  std::vector<std::uint32_t> indices;  // into the world vertices, 3 a triangle, part by part
  std::vector<FlatPart> parts;         // primitive by primitive, instance by instance
  bool has_colors = false;             // some vertices are not white
};

// Whether joints or morph targets may move the part's vertices apart.
bool is_deformable(const FlatPart& part);

// Geometry of all instances. The world vertices of rigid parts come first; `may_move` (one a part; see moving_parts.h)
// keeps those that move together.
FlatGeometry flatten_geometry(const Scene& scene, const std::vector<MeshInstance>& instances,
                              const std::vector<bool>& may_move);

// The scene's materials and the default one behind them. `slots` holds the texture slot of each of the scene's
// textures. Throws InputError if there are more than glsl::kMaxMaterials.
std::vector<glsl::GpuMaterial> flatten_materials(const Scene& scene, const std::vector<std::uint32_t>& slots);

}  // namespace lightwell
