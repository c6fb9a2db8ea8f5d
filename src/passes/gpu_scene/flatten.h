// The scene as flat arrays: what the GPU keeps of its geometry and materials.
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/scene.h"
#include "passes/gpu_scene/gpu_scene_types.h"
#include "passes/gpu_scene/world_vertices_params.h"

namespace lightwell {

struct FlatGeometry {
  std::vector<glsl::ObjectVertex> object_vertices;  // of all primitives, shared by instances of one shape
  std::vector<glsl::VertexSource> sources;          // one a world vertex
  std::vector<std::uint32_t> indices;               // into the world vertices, 3 a triangle; opaque triangles first
  std::uint32_t opaque_triangle_count = 0;
};

// Material of each primitive, by mesh. -1 of the scene becomes the default material's index, which follows the scene's.
using PrimitiveMaterials = std::vector<std::vector<std::uint32_t>>;
PrimitiveMaterials list_primitive_materials(const Scene& scene);

// One part for each primitive of each instance, in that order.
std::vector<glsl::Part> make_parts(const PrimitiveMaterials& materials, const std::vector<MeshInstance>& instances);

// Geometry of all instances; its parts are those of make_parts(). Skins are shown as modelled, morph targets with the
// weights of the instance's node or mesh.
FlatGeometry flatten_geometry(const Scene& scene, const std::vector<MeshInstance>& instances);

// The scene's materials and the default one behind them. `slots` holds the texture slot of each of the scene's
// textures.
std::vector<glsl::GpuMaterial> flatten_materials(const Scene& scene, const std::vector<std::uint32_t>& slots);

}  // namespace lightwell
