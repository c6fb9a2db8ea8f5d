#include "passes/gpu_scene/gpu_scene.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
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
#include "passes/gpu_scene/static_resources.h"
#include "passes/gpu_scene/texture_buckets.h"
#include "passes/gpu_scene/triangle_order.h"

namespace lightwell {
namespace {

bool any(const std::vector<bool>& flags) {
  return std::find(flags.begin(), flags.end(), true) != flags.end();
}

bool has_any_beyond(const std::vector<bool>& flags, const std::vector<bool>& others) {
  for (std::size_t i = 0; i < flags.size(); ++i)
    if (flags[i] && !others[i]) return true;
  return false;
}

void add_flags(std::vector<bool>& flags, const std::vector<bool>& others) {
  for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = flags[i] || others[i];
}

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
  constexpr std::uint32_t kNoTexture = 0xffffffffu;
  for (const glsl::GpuMaterial& material : materials) {
    if (material.base_texture != kNoTexture) frame.texture_arrays |= 1u << (material.base_texture >> 16);
    if (material.emission_texture != kNoTexture) frame.texture_arrays |= 16u << (material.emission_texture >> 16);
    for (int c = 0; c < 3; ++c) frame.emission_maximum = std::max(frame.emission_maximum, material.emission[c]);
  }
}

}  // namespace

struct GpuScene::State {
  std::vector<FlatPart> parts;
  std::vector<std::uint32_t> part_indices;  // FlatGeometry::indices
  std::vector<bool> moving;                 // one a part: may move, or has moved
  std::vector<bool> moved;                  // one a part: did so in the last frame
  std::vector<MeshInstance> instances;      // as last seen to move; none before the first frame
  std::vector<ShapeBounds> shape_bounds;    // FlatGeometry::shape_bounds
  std::vector<std::uint32_t> part_order;    // OrderedTriangles::parts
  std::vector<Bounds> bounds;               // one a part
  std::vector<PartRange> ranges;            // of the last frame
  StaticBuffer object_vertices;
  StaticBuffer influences;
  StaticBuffer morph_offsets;
  StaticBuffer sources;
  StaticBuffer indices;
  StaticBuffer materials;
  StaticBuffer emissive_triangles;
  std::array<StaticImage, 4> textures;
  std::unique_ptr<Buffer> vertices;
  std::unique_ptr<Buffer> previous_positions;
  Frame frame;  // the last one, without its handles

  void order();
  void list_ranges(const std::vector<bool>& moved_now);
  std::vector<bool> follow(const std::vector<MeshInstance>& instances);
  void write_vertices(FrameGraph& graph, const std::vector<bool>& dirty, bool first_frame, Frame& next);
};

// Puts the triangles in the order that `moving` asks for.
void GpuScene::State::order() {
  OrderedTriangles ordered = order_triangles(parts, part_indices, moving);
  indices.pending = to_bytes(ordered.indices);
  emissive_triangles.pending = to_bytes(ordered.emissive);
  frame.opaque_triangle_count = ordered.opaque_triangle_count;
  frame.moving_first = ordered.moving_first;
  frame.moving_count = ordered.moving_count;
  part_order = std::move(ordered.parts);
  ++frame.static_revision;
}

// Brings the boxes of parts that moved up to date, and all parts into the order of their triangles.
void GpuScene::State::list_ranges(const std::vector<bool>& moved_now) {
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (moved_now[i]) bounds[i] = bound_part(shape_bounds[parts[i].shape.bounds], instances[parts[i].instance]);
  ranges.clear();
  std::uint32_t first_index = 0;
  for (const std::uint32_t i : part_order) {
    ranges.push_back({first_index, parts[i].index_count, bounds[i], parts[i].has_holes, moving[i]});
    first_index += parts[i].index_count;
  }
}

// Takes notice of where the instances are now. Returns the parts whose vertices must be written: those that moved, and
// those that did so a frame ago, whose previous positions are behind.
std::vector<bool> GpuScene::State::follow(const std::vector<MeshInstance>& now) {
  LW_ASSERT(now.size() == instances.size(),
            "snapshot has " + std::to_string(now.size()) + " instances, the scene " + std::to_string(instances.size()));
  const std::vector<bool> moved_now = list_moved_parts(parts, instances, now);
  if (any(moved_now)) {
    ++frame.revision;
    instances = now;
  }
  if (has_any_beyond(moved_now, moving)) {
    add_flags(moving, moved_now);
    order();
  }
  std::vector<bool> dirty = std::exchange(moved, moved_now);
  add_flags(dirty, moved_now);
  return dirty;
}

// One dispatch over the vertices of rigid parts and one over the others, each from the first dirty part's to the last
// one's; those between stay as they are.
void GpuScene::State::write_vertices(FrameGraph& graph, const std::vector<bool>& dirty, bool first_frame, Frame& next) {
  const VertexSpan rigid = span_vertices(parts, dirty, false);
  const VertexSpan deformed = span_vertices(parts, dirty, true);
  if (rigid.count + deformed.count == 0) return;
  const BufferHandle from = import(graph, sources);
  const BufferHandle objects = import(graph, object_vertices);
  const BufferHandle moved_by = import(graph, influences);
  const BufferHandle offsets = import(graph, morph_offsets);
  const PosedParts posed = pose_parts(parts, instances);
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
        .write("vertices", next.vertices)
        .write("previous_positions", next.previous_positions)
        .constant("kDeforms", deforms ? 1 : 0)
        .push(glsl::WorldVerticesParams{span.first, span.count, first_frame ? 1u : 0u});
    dispatch_linear(pass, span.count);
  };
  write(rigid, false);
  write(deformed, true);
}

GpuScene::GpuScene(Device& device, const Scene& scene, const SceneSnapshot& snapshot)
    : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.moving = list_animated_parts(scene, snapshot.instances);
  FlatGeometry geometry = flatten_geometry(scene, snapshot.instances, state.moving);
  const std::size_t vertex_count = geometry.sources.size();
  check_buffer_size(device, std::to_string(vertex_count) + " vertices", vertex_count * sizeof(glsl::WorldVertex));
  const std::size_t joint_count = pose_parts(geometry.parts, snapshot.instances).joints.size();
  check_buffer_size(device, std::to_string(joint_count) + " joints", joint_count * sizeof(glsl::Joint));
  TextureBuckets textures = build_texture_buckets(scene);
  const std::vector<glsl::GpuMaterial> materials = flatten_materials(scene, textures.slots);

  state.frame.vertex_count = static_cast<std::uint32_t>(vertex_count);
  state.frame.triangle_count = static_cast<std::uint32_t>(geometry.indices.size() / 3);
  describe_materials(materials, state.frame);
  state.object_vertices = make_buffer(device, "object vertices", to_bytes(geometry.object_vertices));
  state.influences = make_buffer(device, "vertex influences", to_bytes(geometry.influences));
  state.morph_offsets = make_buffer(device, "morph offsets", to_bytes(geometry.morph_offsets));
  state.sources = make_buffer(device, "vertex sources", to_bytes(geometry.sources));
  state.indices = make_buffer(device, "indices", to_bytes(geometry.indices));
  state.materials = make_buffer(device, "materials", to_bytes(materials));
  for (const FlatPart& part : geometry.parts)
    if (part.emits) state.frame.emissive_triangle_count += part.index_count / 3;
  state.emissive_triangles =
      make_buffer(device, "emissive triangles",
                  std::vector<std::byte>(state.frame.emissive_triangle_count * sizeof(std::uint32_t)));
  for (std::size_t i = 0; i < textures.buckets.size(); ++i) {
    state.textures[i] = make_textures(device, i, std::move(textures.buckets[i]));
  }
  const auto make_vertex_buffer = [&](std::string_view name, std::size_t stride) {
    return std::make_unique<Buffer>(device, name, std::max<std::size_t>(vertex_count, 1) * stride, MemoryKind::kDevice);
  };
  state.vertices = make_vertex_buffer("world vertices", sizeof(glsl::WorldVertex));
  state.previous_positions = make_vertex_buffer("previous positions", sizeof(glm::vec4));
  state.parts = std::move(geometry.parts);
  state.part_indices = std::move(geometry.indices);
  state.shape_bounds = std::move(geometry.shape_bounds);
  state.bounds.resize(state.parts.size());
}

GpuScene::~GpuScene() = default;

std::uint32_t GpuScene::emissive_triangle_count() const {
  return state_->frame.emissive_triangle_count;
}

GpuScene::Frame GpuScene::record(FrameGraph& graph, const SceneSnapshot& snapshot) {
  State& state = *state_;
  const bool first = state.frame.revision == 0;
  std::vector<bool> dirty(state.parts.size(), first);
  std::vector<bool> moved_now = dirty;
  if (first) {
    state.instances = snapshot.instances;
    state.moved.assign(state.parts.size(), false);
    state.order();
    ++state.frame.revision;
  } else {
    dirty = state.follow(snapshot.instances);
    moved_now = state.moved;
  }
  state.list_ranges(moved_now);

  Frame frame = state.frame;
  frame.parts = state.ranges;
  frame.vertices = graph.import_buffer(*state.vertices, sizeof(glsl::WorldVertex));
  frame.previous_positions = graph.import_buffer(*state.previous_positions, sizeof(glm::vec4));
  frame.indices = import(graph, state.indices);
  frame.materials = import(graph, state.materials);
  frame.emissive_triangles = import(graph, state.emissive_triangles);
  for (std::size_t i = 0; i < state.textures.size(); ++i) frame.textures[i] = import(graph, state.textures[i]);
  state.write_vertices(graph, dirty, first, frame);
  frame.set = create_scene_set(graph, frame);
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
                   {"kOpaqueTriangles", any_masked ? scene.opaque_triangle_count : kNoneMasked}};
  return graph.create_set(std::move(set));
}

}  // namespace lightwell
