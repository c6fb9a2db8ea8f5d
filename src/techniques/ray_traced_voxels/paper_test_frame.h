// Runs stages of the published ray-traced voxels on scenes made in code, and reads their buffers back. For tests only.
#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>

#include "graph/testing/graph_test.h"
#include "passes/view/view_frame.h"
#include "techniques/ray_traced_voxels/paper.h"

namespace lightwell {

// A scene of quads.
struct QuadScene {
  Scene scene;

  int add_material(const glm::vec3& albedo) {
    scene.materials.emplace_back().base_color = glm::vec4(albedo, 1.0f);
    return static_cast<int>(scene.materials.size()) - 1;
  }
  // Front towards a x b.
  void add_quad(const glm::vec3& corner, const glm::vec3& a, const glm::vec3& b, int material) {
    Primitive quad;
    quad.positions = {corner, corner + a, corner + a + b, corner + b};
    quad.normals.assign(4, glm::normalize(glm::cross(a, b)));
    quad.indices = {0, 1, 2, 0, 2, 3};
    quad.material = material;
    Node node;
    node.mesh = static_cast<int>(scene.meshes.size());
    scene.meshes.emplace_back().primitives.push_back(std::move(quad));
    scene.nodes.push_back(node);
  }
};

// A floor of 2 x 2 m at y = 0 that looks up, with something black high above that makes the bounds a cube.
inline QuadScene make_floor(const glm::vec3& albedo = glm::vec3(0.5f)) {
  QuadScene floor;
  const int material = floor.add_material(albedo);
  floor.add_quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, material);
  floor.add_quad({-1, 2, -1}, {0.01f, 0, 0}, {0, 0, 0.01f}, material);
  return floor;
}

// A closed room of 2 x 2 x 2 m, walls looking inwards.
inline QuadScene make_room(const glm::vec3& albedo = glm::vec3(0.5f)) {
  QuadScene room;
  const int material = room.add_material(albedo);
  const glm::vec3 x(2, 0, 0), y(0, 2, 0), z(0, 0, 2), low(-1, 0, -1);
  room.add_quad(low, z, x, material);
  room.add_quad(low + y, x, z, material);
  room.add_quad(low, y, z, material);
  room.add_quad(low + x, z, y, material);
  room.add_quad(low, x, y, material);
  room.add_quad(low + z, y, x, material);
  return room;
}

inline WorldLight make_light(LightType type, const glm::vec3& position, const glm::vec3& direction,
                             const glm::vec3& intensity) {
  WorldLight light;
  light.type = type;
  light.position = position;
  light.direction = direction;
  light.intensity = intensity;
  light.cos_inner = 0.9f;
  light.cos_outer = 0.7f;
  return light;
}

// Where listings 7.6 and 7.7 put what is at `position`.
inline std::uint32_t stored_index(const VoxelGrid& grid, const glm::vec3& position) {
  const glm::ivec3 cell((position - grid.origin) / grid.cell_size - 1.0f);  // rounds towards 0
  return (static_cast<std::uint32_t>(cell.z) * grid.resolution.y + static_cast<std::uint32_t>(cell.y)) *
             grid.resolution.x +
         static_cast<std::uint32_t>(cell.x);
}

inline WorldCamera look_from(const glm::vec3& position, const glm::vec3& forward, const glm::vec3& up) {
  WorldCamera camera;
  camera.position = position;
  camera.forward = glm::normalize(forward);
  camera.up = up;
  camera.yfov = 1.2f;
  return camera;
}

inline glm::vec4 unpack(std::uint32_t word) {
  return glm::unpackUnorm4x8(word);
}

class PaperStagesTest : public GraphTest {
 protected:
  void load(const Scene& scene, std::vector<WorldLight> lights) {
    world_.reset();
    scene_ = scene;
    snapshot_ = take_snapshot(scene_);
    snapshot_.lights = std::move(lights);
    world_.emplace(device(), scene_, snapshot_, WorldOptions{});
  }

  // Records what `declare(graph, world)` does, and runs it.
  template <class Declare>
  void frame(const Declare& declare) {
    FrameGraph graph(executor().context());
    WorldFrame world(graph, *world_, snapshot_, 0.0);
    declare(graph, world);
    run(graph);
  }

  VoxelGrid grid(std::uint32_t resolution) const { return fit_voxel_grid(snapshot_.bounds, resolution); }

  static ExactSums exact_sums(FrameGraph& graph, const VoxelGrid& grid, VoxelWriter writer) {
    return writer == VoxelWriter::kExact ? record_exact_sums(graph, grid.cell_count) : ExactSums{};
  }

  struct MaterialWords {
    std::vector<std::uint32_t> albedo;
    std::vector<std::uint32_t> normals;
  };
  MaterialWords materials(std::uint32_t resolution, VoxelWriter writer) {
    ReadbackTicket albedo, normals;
    frame([&](FrameGraph& graph, WorldFrame& world) {
      ExactSums sums = exact_sums(graph, grid(resolution), writer);
      const PaperMaterials made = record_paper_materials(graph, world.scene, grid(resolution), writer, sums);
      albedo = graph.read_back(made.albedo);
      normals = graph.read_back(made.normals);
    });
    return {fetch<std::uint32_t>(albedo), fetch<std::uint32_t>(normals)};
  }

  // Irradiance of every voxel, W/m^2; a: samples, 1 with the exact writer. `camera`: who injects, else lights do.
  std::vector<glm::vec4> inject(std::uint32_t resolution, const PaperInjection& settings,
                                const WorldCamera* camera = nullptr) {
    ReadbackTicket ticket;
    frame([&](FrameGraph& graph, WorldFrame& world) {
      ExactSums sums = exact_sums(graph, grid(resolution), settings.writer);
      const PaperMaterials made = record_paper_materials(graph, world.scene, grid(resolution), settings.writer, sums);
      PaperIrradiance irradiance;
      if (camera != nullptr) {
        const ViewFrame view(graph, world, {64, 64}, *camera, PixelSample{}, nullptr);
        irradiance = record_camera_injection(graph, world, view.camera_buffer, made, settings, sums);
      } else {
        irradiance = record_light_injection(graph, world, made, settings, sums);
      }
      ticket = graph.read_back(irradiance.voxels);
    });
    std::vector<glm::vec4> values(grid(resolution).cell_count);
    const auto words = fetch<std::uint32_t>(ticket);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (settings.writer == VoxelWriter::kExact)
        values[i] = {std::bit_cast<float>(words[3 * i]), std::bit_cast<float>(words[3 * i + 1]),
                     std::bit_cast<float>(words[3 * i + 2]), 1.0f};
      else
        values[i] = unpack(words[i]) * glm::vec4(glm::vec3(settings.range), 255.0f);
    }
    return values;
  }

  // Irradiance of the whole technique, W/m^2, at each of 32 x 32 pixels; w of the second: 0 where there is no surface.
  using Pixels = std::pair<std::vector<glm::vec4>, std::vector<glm::vec4>>;
  Pixels picture(const RayTracedVoxelsPaperOptions& options, const WorldCamera& camera) {
    RayTracedVoxelsPaper technique(options);
    const std::unique_ptr<TechniqueWorld> part = technique.create_world(LightKinds::kAll);
    ReadbackTicket irradiance, position;
    frame([&](FrameGraph& graph, WorldFrame& world) {
      ViewFrame view(graph, world, {32, 32}, camera, PixelSample{}, nullptr);
      part->record_world(graph, world);
      irradiance = graph.read_back(technique.record_view(graph, part.get(), view).irradiance);
      position = graph.read_back(view.gbuffer.position);
    });
    return {fetch<glm::vec4>(irradiance), fetch<glm::vec4>(position)};
  }

  Scene scene_;
  SceneSnapshot snapshot_;
  std::optional<World> world_;
};

}  // namespace lightwell
