// The scene as flat arrays: what the GPU keeps of its geometry and materials.
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/scene.h"
#include "passes/gpu_scene/gpu_scene_types.h"
#include "passes/gpu_scene/world_vertices_params.h"

namespace lightwell {

// One primitive of one instance, and where its own lie in the flat arrays.
struct FlatPart {
  std::uint32_t instance = 0;
  std::uint32_t material = 0;      // the default material's index follows the scene's
  bool has_holes = false;          // where its material's alpha cuts them
  std::uint32_t first_vertex = 0;  // of the world vertices
  std::uint32_t vertex_count = 0;
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
};

struct FlatGeometry {
  std::vector<glsl::ObjectVertex> object_vertices;  // of all primitives, shared by instances of one shape
  std::vector<glsl::VertexSource> sources;          // one a world vertex
  std::vector<std::uint32_t> indices;               // into the world vertices, 3 a triangle, part by part
  std::vector<FlatPart> parts;                      // primitive by primitive, instance by instance
};

// Geometry of all instances. Vertices of parts that `may_move` (one a part; see moving_parts.h) come last.
FlatGeometry flatten_geometry(const Scene& scene, const std::vector<MeshInstance>& instances,
                              const std::vector<bool>& may_move);

// What the GPU knows of each part where the instances are now.
std::vector<glsl::Part> make_parts(const std::vector<FlatPart>& parts, const std::vector<MeshInstance>& instances);

// The scene's materials and the default one behind them. `slots` holds the texture slot of each of the scene's
// textures.
std::vector<glsl::GpuMaterial> flatten_materials(const Scene& scene, const std::vector<std::uint32_t>& slots);

}  // namespace lightwell
