#include "passes/gpu_scene/gpu_scene.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gpu/device.h"
#include "graph/linear_dispatch.h"
#include "kernels/passes/gpu_scene/world_vertices.comp.h"
#include "lightwell/error.h"
#include "passes/gpu_scene/flatten.h"
#include "passes/gpu_scene/moving_parts.h"
#include "passes/gpu_scene/posed_parts.h"
#include "passes/gpu_scene/scene_motion.h"
#include "passes/gpu_scene/static_resources.h"
#include "passes/gpu_scene/texture_buckets.h"
#include "passes/gpu_scene/triangle_order.h"

namespace lightwell {
namespace {

struct VertexSpan {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

// From the first to the last world vertex of the flagged parts of one kind.
VertexSpan span_vertices(const std::vector<FlatPart>& parts, const std::vector<bool>& flags, bool deformable) {
  std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t end = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!flags[i] || is_deformable(parts[i]) != deformable) continue;
    first = std::min(first, parts[i].first_vertex);
    end = std::max(end, parts[i].first_vertex + parts[i].vertex_count);
  }
  return first < end ? VertexSpan{first, end - first} : VertexSpan{};
}

void describe_materials(const std::vector<glsl::GpuMaterial>& materials, GpuScene::Frame& frame) {
  for (const glsl::GpuMaterial& material : materials) {
    if (material.base_texture != glsl::kNoTexture) frame.texture_arrays |= 1u << (material.base_texture >> 16);
    if (material.emission_texture != glsl::kNoTexture) frame.texture_arrays |= 16u << (material.emission_texture >> 16);
    for (int c = 0; c < 3; ++c) {
      frame.emission_maximum = std::max(frame.emission_maximum, material.emission[c]);
      // The last one is that of surfaces without a material.
      if (material.base_texture == glsl::kNoTexture && &material != &materials.back())
        frame.albedo_maximum = std::max(frame.albedo_maximum, material.base_color[c]);
    }
  }
}

// What the GPU holds after a frame, as far as it differs from frame to frame.
struct ShownFrame {
  SceneMotion motion;
  std::vector<Bounds> bounds;             // one a part, in the world
  std::vector<std::uint32_t> part_order;  // OrderedTriangles::parts
  std::vector<PartRange> ranges;          // in that order
  GpuScene::Frame frame;                  // without handles
};

void list_ranges(const std::vector<FlatPart>& parts, ShownFrame& shown) {
  shown.ranges.clear();
  std::uint32_t first_index = 0;
  for (const std::uint32_t i : shown.part_order) {
    const FlatPart& part = parts[i];
    shown.ranges.push_back({first_index, part.index_count, shown.bounds[i], part.has_holes, shown.motion.moving[i]});
    first_index += part.index_count;
  }
}

}  // namespace

struct GpuScene::State {
  std::vector<FlatPart> parts;
  std::vector<ShapeBounds> shape_bounds;    // FlatGeometry::shape_bounds
  std::vector<std::uint32_t> part_indices;  // FlatGeometry::indices
  std::vector<bool> animated;               // one a part
  StaticBuffer object_vertices;
  StaticBuffer influences;
  StaticBuffer morph_offsets;
  StaticBuffer sources;
  StaticBuffer materials;
  std::array<StaticImage, 4> textures;
  std::unique_ptr<Buffer> indices;
  std::unique_ptr<Buffer> emissive_triangles;
  std::unique_ptr<Buffer> vertices;
  std::unique_ptr<Buffer> previous_positions;
  std::shared_ptr<const ShownFrame> shown;     // the last one that was recorded
  std::shared_ptr<const ShownFrame> declared;  // the last one, recorded or not
  SceneRevisions newest;                       // of any frame, recorded or not

  std::shared_ptr<ShownFrame> advance(const std::vector<MeshInstance>& instances);
  OrderedTriangles order(ShownFrame& next) const;
  void write_vertices(FrameGraph& graph, const SceneMotion& motion, Frame& frame);
};

// What the frame with these instances shows, but for the order of its triangles.
std::shared_ptr<ShownFrame> GpuScene::State::advance(const std::vector<MeshInstance>& instances) {
  const auto next = std::make_shared<ShownFrame>(*shown);
  next->motion.advance(parts, animated, instances);
  const bool first = !shown->motion.instances;
  bool moved = first;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!first && !next->motion.moved[i]) continue;
    next->bounds[i] = bound_part(shape_bounds[parts[i].shape.bounds], instances[parts[i].instance]);
    moved = true;
  }
  SceneRevisions& revisions = next->frame.revisions;
  if (moved) revisions.moving_geometry = ++newest.moving_geometry;
  if (first || next->motion.moving != shown->motion.moving) revisions.static_geometry = ++newest.static_geometry;
  return next;
}

// Puts the triangles in the order that the parts' motion asks for.
OrderedTriangles GpuScene::State::order(ShownFrame& next) const {
  OrderedTriangles ordered = order_triangles(parts, part_indices, next.motion.moving);
  next.part_order = ordered.parts;
  next.frame.opaque_triangle_count = ordered.opaque_triangle_count;
  next.frame.moving_first = ordered.moving_first;
  next.frame.moving_count = ordered.moving_count;
  return ordered;
}

// Of the parts that moved, and of those that did so in the frame that is shown, whose previous positions are behind.
// One dispatch over the vertices of rigid parts and one over the others, each from the first such part's to the last
// one's; those between stay as they are.
void GpuScene::State::write_vertices(FrameGraph& graph, const SceneMotion& motion, Frame& frame) {
  const bool first = !shown->motion.instances;
  std::vector<bool> dirty(parts.size(), first);
  for (std::size_t i = 0; i < parts.size() && !first; ++i) dirty[i] = motion.moved[i] || shown->motion.moved[i];
  const VertexSpan rigid = span_vertices(parts, dirty, false);
  const VertexSpan deformed = span_vertices(parts, dirty, true);
  if (rigid.count + deformed.count == 0) return;
  const BufferHandle from = import(graph, sources);
  const BufferHandle objects = import(graph, object_vertices);
  const BufferHandle moved_by = import(graph, influences);
  const BufferHandle offsets = import(graph, morph_offsets);
  const PosedParts posed = pose_parts(parts, *motion.instances);
  const BufferHandle posed_parts = graph.upload<glsl::Part>("parts", posed.parts);
  const BufferHandle joints = graph.upload<glsl::Joint>("joints", posed.joints);
  const BufferHandle morphs = graph.upload<glsl::Morph>("morphs", posed.morphs);
  const auto write = [&](const VertexSpan& span, bool deforms) {
    if (span.count == 0) return;
    ComputePass& pass = graph.compute("world vertices", kernels::gpu_scene_world_vertices_comp);
    pass.read("sources", from)
        .read("object_vertices", objects)
        .read("parts", posed_parts)
        .read("influences", moved_by)
        .read("joints", joints)
        .read("morphs", morphs)
        .read("morph_offsets", offsets)
        .write("vertices", frame.vertices)
        .write("previous_positions", frame.previous_positions)
        .constant("kDeforms", deforms ? 1 : 0)
        .push(glsl::WorldVerticesParams{span.first, span.count, first ? 1u : 0u});
    dispatch_linear(pass, span.count);
  };
  write(rigid, false);
  write(deformed, true);
}

GpuScene::GpuScene(Device& device, const Scene& scene, const SceneSnapshot& snapshot)
    : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.animated = list_animated_parts(scene, snapshot.instances);
  FlatGeometry geometry = flatten_geometry(scene, snapshot.instances, state.animated);
  const std::size_t vertex_count = geometry.sources.size();
  const std::size_t joint_count = pose_parts(geometry.parts, snapshot.instances).joints.size();
  check_buffer_size(device, std::to_string(joint_count) + " joints", joint_count * sizeof(glsl::Joint));
  const TextureBuckets textures = build_texture_buckets(scene, std::min(device.limits().maxImageArrayLayers, 65536u));
  const std::vector<glsl::GpuMaterial> materials = flatten_materials(scene, textures.slots);

  const auto shown = std::make_shared<ShownFrame>();
  shown->bounds.resize(geometry.parts.size());
  shown->frame.vertex_count = static_cast<std::uint32_t>(vertex_count);
  shown->frame.triangle_count = static_cast<std::uint32_t>(geometry.indices.size() / 3);
  for (const FlatPart& part : geometry.parts)
    if (part.emits) shown->frame.emissive_triangle_count += part.index_count / 3;
  shown->frame.revisions.materials = 1;
  describe_materials(materials, shown->frame);
  shown->frame.vertex_colors = geometry.has_colors;

  state.object_vertices = make_buffer(device, "object vertices", as_byte_span(geometry.object_vertices));
  state.influences = make_buffer(device, "vertex influences", as_byte_span(geometry.influences));
  state.morph_offsets = make_buffer(device, "morph offsets", as_byte_span(geometry.morph_offsets));
  state.sources = make_buffer(device, "vertex sources", as_byte_span(geometry.sources));
  state.materials = make_buffer(device, "materials", as_byte_span(materials));
  for (std::size_t i = 0; i < textures.buckets.size(); ++i)
    state.textures[i] = make_textures(device, i, textures.buckets[i]);
  const auto make_device_buffer = [&](std::string_view name, std::size_t count, std::size_t stride) {
    return std::make_unique<Buffer>(device, name, count * stride, MemoryKind::kDevice);
  };
  state.indices = make_device_buffer("indices", geometry.indices.size(), sizeof(std::uint32_t));
  state.emissive_triangles =
      make_device_buffer("emissive triangles", shown->frame.emissive_triangle_count, sizeof(std::uint32_t));
  state.vertices = make_device_buffer("world vertices", vertex_count, sizeof(glsl::WorldVertex));
  state.previous_positions = make_device_buffer("previous positions", vertex_count, sizeof(glm::vec4));
  state.parts = std::move(geometry.parts);
  state.part_indices = std::move(geometry.indices);
  state.shape_bounds = std::move(geometry.shape_bounds);
  state.shown = shown;
}

GpuScene::~GpuScene() = default;

GpuScene::Frame GpuScene::record(FrameGraph& graph, const SceneSnapshot& snapshot) {
  State& state = *state_;
  const std::shared_ptr<ShownFrame> next = state.advance(snapshot.instances);
  std::optional<OrderedTriangles> ordered;
  if (next->frame.revisions.static_geometry != state.shown->frame.revisions.static_geometry)
    ordered = state.order(*next);
  list_ranges(state.parts, *next);

  Frame frame = next->frame;
  frame.parts = next->ranges;
  frame.vertices = graph.import_buffer(*state.vertices, sizeof(glsl::WorldVertex));
  frame.previous_positions = graph.import_buffer(*state.previous_positions, sizeof(glm::vec4));
  frame.indices = graph.import_buffer(*state.indices);
  frame.materials = import(graph, state.materials);
  frame.emissive_triangles = graph.import_buffer(*state.emissive_triangles);
  for (std::size_t i = 0; i < state.textures.size(); ++i) frame.textures[i] = import(graph, state.textures[i]);
  if (ordered) {
    upload(graph, frame.indices, as_byte_span(ordered->indices));
    upload(graph, frame.emissive_triangles, as_byte_span(ordered->emissive));
  }
  state.write_vertices(graph, next->motion, frame);
  frame.set = create_scene_set(graph, frame);
  state.declared = next;
  graph.on_recorded([&state, next] { state.shown = next; });
  return frame;
}

SetHandle create_scene_set(FrameGraph& graph, const GpuScene::Frame& scene) {
  constexpr std::uint32_t kNoneMasked = 0xffffffffu;
  ResourceSet set{.name = "scene", .number = 1, .members = {}, .constants = {}};
  set.members = {{.binding = "vertices", .buffer = scene.vertices}, {.binding = "indices", .buffer = scene.indices}};
  if (scene.materials) set.members.push_back({.binding = "materials", .buffer = scene.materials});
  for (std::size_t i = 0; i < std::size(scene.textures); ++i)
    if (scene.textures[i])
      set.members.push_back({.binding = "textures_" + std::to_string(i),
                             .image = scene.textures[i],
                             .sampler = SamplerKind::kLinearRepeat});
  const bool any_masked = scene.opaque_triangle_count < scene.triangle_count;
  set.constants = {{"kTextureArrays", scene.texture_arrays},
                   {"kVertexColors", scene.vertex_colors ? 1u : 0u},
                   {"kOpaqueTriangles", any_masked ? scene.opaque_triangle_count : kNoneMasked}};
  return graph.create_set(std::move(set));
}

}  // namespace lightwell
