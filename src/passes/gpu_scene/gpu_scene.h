// The scene on the GPU. Geometry is dynamic by design: one pass writes the vertices of what moves in world space (and
// keeps last frame's); raster, voxelisation and tracing read those.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "graph/frame_graph.h"
#include "lightwell/scene.h"
#include "passes/gpu_scene/scene_revisions.h"

namespace lightwell {

class Device;

// One primitive of one instance, drawn by indices [first_index, first_index + index_count).
struct PartRange {
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  Bounds world_bounds;  // hold all its vertices this frame; a little larger than need be (part_bounds.h)
  bool has_holes = false;
  bool moving = false;
};

class GpuScene {
 public:
  // This frame's handles. Element types: passes/gpu_scene/gpu_scene_types.h.
  struct Frame {
    BufferHandle vertices;             // glsl::WorldVertex: position + material, normal, texture coordinates
    BufferHandle previous_positions;   // vec4 a vertex, last frame's world position
    BufferHandle indices;              // uint, 3 a triangle; in this order: opaque standing, opaque moving, moving
                                       // with holes, standing with holes
    BufferHandle materials;            // glsl::GpuMaterial
    BufferHandle emissive_triangles;   // uint, rising
    ImageHandle textures[4];           // RGBA8 2D arrays, sides 128, 512, 1024, 2048 (1x1 where unused), with mips
    std::uint32_t texture_arrays = 0;  // kTextureArrays of shaders/material.glsl
    bool vertex_colors = false;        // kVertexColors of shaders/vertex_color.glsl
    std::uint32_t vertex_count = 0;
    std::uint32_t triangle_count = 0;
    std::uint32_t emissive_triangle_count = 0;
    std::uint32_t opaque_triangle_count = 0;  // of the first triangles; the alpha of the others' materials cuts holes
    std::span<const PartRange> parts;         // in the order of their triangles; lives until the next record()
    // Of all triangles, those in [moving_first, moving_first + moving_count) are animated or moved not long ago
    // (scene_motion.h); the others, and the order of all, stay the same as long as `revisions.static_geometry` does.
    std::uint32_t moving_first = 0;
    std::uint32_t moving_count = 0;
    SceneRevisions revisions;       // without those of lights and environment, which others count
    float emission_maximum = 0.0f;  // largest emission channel of any material, W/(sr m^2)
    float albedo_maximum = 0.0f;    // largest channel of any material's base colour without a texture
    SetHandle set;                  // all of it that kernels read, see create_scene_set()
  };

  // Copies what it needs of `scene` as `snapshot` shows it; large data are staged and copied by the first frame.
  // Throws InputError if the scene is too large for the device.
  GpuScene(Device& device, const Scene& scene, const SceneSnapshot& snapshot);
  ~GpuScene();

  // Declares the passes that bring the GPU's copy from the last recorded frame up to `snapshot` (the same instances,
  // elsewhere). A frame that is declared and never recorded leaves no trace. Declare a frame when the one before it was
  // recorded or dropped, and keep this scene until then.
  Frame record(FrameGraph& graph, const SceneSnapshot& snapshot);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The frame's resources, as far as it has them, as set 1 of kernels that include shaders/geometry.glsl or
// material.glsl; with the constants of these files.
SetHandle create_scene_set(FrameGraph& graph, const GpuScene::Frame& scene);

}  // namespace lightwell
