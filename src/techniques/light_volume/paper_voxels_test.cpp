// Voxelisation against an oracle on the CPU, in double precision: three scan conversions under MAX.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>

#include "passes/gpu_scene/gpu_scene_types.h"
#include "shaders/lights.h"
#include "techniques/light_volume/paper_test_volume.h"

namespace lightwell {
namespace {

// Wound so that it looks along its normal; emits constant radiance in front, or from both sides.
struct TestTriangle {
  std::array<glm::dvec3, 3> corners;
  glm::vec3 emission{0.0f};
  glm::vec3 albedo{0.0f};

  glm::vec3 normal() const {
    return glm::vec3(glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0])));
  }
};

struct TestVoxels {
  std::vector<float> planes;
  glm::vec3 value(const VoxelGrid& grid, std::uint32_t first_plane, std::size_t cell) const {
    const std::size_t count = grid.cell_count;
    return {planes[first_plane * count + cell], planes[(first_plane + 1) * count + cell],
            planes[(first_plane + 2) * count + cell]};
  }
};

class PaperVoxelsTest : public PaperVolumeTest {
 protected:
  static void add_triangle(const TestTriangle& triangle, std::vector<glsl::WorldVertex>& vertices,
                           std::vector<glsl::GpuMaterial>& materials) {
    for (const glm::dvec3& corner : triangle.corners) {
      const auto material = static_cast<std::uint32_t>(materials.size());
      vertices.push_back({glm::vec4(glm::vec3(corner), std::bit_cast<float>(material)),
                          glm::vec4(triangle.normal(), 0.0f), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)});
    }
    glsl::GpuMaterial material{};
    material.base_color = glm::vec4(triangle.albedo, 1.0f);
    material.emission = glm::vec4(triangle.emission, 0.0f);
    material.base_texture = material.emission_texture = UINT32_MAX;
    materials.push_back(material);
  }

  // One texel, for bindings that nothing samples.
  static ImageHandle blank(FrameGraph& graph, bool array, VkFormat format) {
    ImageHandle image = graph.create_image("blank", {.format = format, .array = array});
    const std::array<std::uint32_t, 1> zero{};
    graph.copy("stage blank", graph.upload("zero", std::span<const std::uint32_t>(zero)), image);
    return image;
  }

  TestVoxels voxelize(const VoxelGrid& grid, const std::vector<TestTriangle>& triangles,
                      const std::vector<WorldLight>& lights = {}) {
    std::vector<glsl::WorldVertex> vertices;
    std::vector<glsl::GpuMaterial> materials;
    for (const TestTriangle& triangle : triangles) add_triangle(triangle, vertices, materials);
    std::vector<std::uint32_t> indices(vertices.size());
    for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;

    FrameGraph graph(executor().context());
    GpuScene::Frame scene;
    scene.vertices = graph.upload("vertices", std::span<const glsl::WorldVertex>(vertices));
    scene.indices = graph.upload("indices", std::span<const std::uint32_t>(indices));
    scene.materials = graph.upload("materials", std::span<const glsl::GpuMaterial>(materials));
    for (ImageHandle& textures : scene.textures) textures = blank(graph, true, VK_FORMAT_R8G8B8A8_UNORM);
    scene.triangle_count = static_cast<std::uint32_t>(triangles.size());
    scene.texture_arrays = 0xffu;
    scene.set = create_scene_set(graph, scene);
    const LightTable::Frame light_frame = LightTable().record(graph, lights);
    const std::vector<glsl::ShadowView> no_shadows(lights.size());
    ShadowMaps::Frame shadows;
    shadows.views = graph.upload("shadow views", std::span<const glsl::ShadowView>(no_shadows));
    shadows.atlas = blank(graph, false, VK_FORMAT_R32_SFLOAT);
    const ReadbackTicket ticket = graph.read_back(record_paper_voxels(graph, scene, light_frame, shadows, grid));
    run(graph);
    return {fetch<float>(ticket)};
  }
};

// What the oracle knows of a cell. `sure` false: rounding decides whether some triangle fills it.
struct OracleCell {
  bool sure = true;
  glm::vec3 code{0.0f};
  glm::vec3 radiance{0.0f};
};

// Distance in pixels of the point inside the edges of a 2D triangle; negative outside.
double inside_distance(const std::array<glm::dvec2, 3>& corners, glm::dvec2 point) {
  const auto cross = [](glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; };
  const double turn = cross(corners[1] - corners[0], corners[2] - corners[0]) < 0.0 ? -1.0 : 1.0;
  double distance = 1e30;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 edge = corners[(i + 1) % 3] - corners[i];
    distance = std::min(distance, turn * cross(edge, point - corners[i]) / std::max(1e-12, glm::length(edge)));
  }
  return distance;
}

// `snap`: how far the rasteriser may move a corner, in pixels along each axis; edges and depths are unsure by as much.
void scan_convert(const VoxelGrid& grid, const TestTriangle& triangle, int axis, double snap, TestVolume& shape,
                  std::vector<OracleCell>& cells) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  std::array<glm::dvec3, 3> in_cells;
  std::array<glm::dvec2, 3> projected;
  for (std::size_t i = 0; i < 3; ++i) {
    in_cells[i] = (triangle.corners[i] - glm::dvec3(grid.origin)) / double{grid.cell_size};
    projected[i] = {in_cells[i][u], in_cells[i][v]};
  }
  const glm::dvec3 normal = glm::cross(in_cells[1] - in_cells[0], in_cells[2] - in_cells[0]);
  const double slope = (std::abs(normal[u]) + std::abs(normal[v])) / std::max(1e-12, std::abs(normal[axis]));
  const double depth_error = 1e-3 + slope * snap;
  const int resolution = static_cast<int>(grid.resolution.x);
  for (int j = 0; j < resolution; ++j) {
    for (int i = 0; i < resolution; ++i) {
      const glm::dvec2 center(i + 0.5, j + 0.5);
      const double distance = inside_distance(projected, center);
      if (distance < -1.5 * snap) continue;
      const double depth =
          in_cells[0][axis] -
          (normal[u] * (center.x - in_cells[0][u]) + normal[v] * (center.y - in_cells[0][v])) / normal[axis];
      const int low = static_cast<int>(std::floor(std::max(depth - depth_error, -1.0)));
      const int high = static_cast<int>(std::floor(std::min(depth + depth_error, double(resolution))));
      for (int k = std::max(low, 0); k <= std::min(high, resolution - 1); ++k) {
        glm::ivec3 cell;
        cell[u] = i;
        cell[v] = j;
        cell[axis] = k;
        OracleCell& entry = cells[shape.index(cell)];
        entry.sure = entry.sure && low == high && distance > 1.5 * snap;
        entry.code = glm::max(entry.code, triangle.normal() * 0.5f + 0.5f);
        entry.radiance = glm::max(entry.radiance, triangle.emission);
      }
    }
  }
}

TEST_F(PaperVoxelsTest, ThreeSlicingsUnderMaxEqualTheOracle) {
  // Corners are rounded to a grid in the pixel: by half a step at most. A whole one leaves room for the interpolation.
  const double snap = std::ldexp(1.0, -static_cast<int>(device().limits().subPixelPrecisionBits));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const std::uint32_t resolution : {8u, 24u}) {
    TestVolume shape(resolution);
    std::vector<TestTriangle> triangles(12);
    for (TestTriangle& triangle : triangles) {
      for (glm::dvec3& corner : triangle.corners) corner = {uniform(random), uniform(random), uniform(random)};
      triangle.emission = glm::vec3(uniform(random), uniform(random), uniform(random));
    }
    std::vector<OracleCell> oracle(shape.grid.cell_count);
    for (const TestTriangle& triangle : triangles) {
      for (int axis = 0; axis < 3; ++axis) scan_convert(shape.grid, triangle, axis, snap, shape, oracle);
    }
    const TestVoxels voxels = voxelize(shape.grid, triangles);
    std::size_t sure_and_filled = 0;
    shape.for_each_cell([&](glm::ivec3 c, std::size_t i) {
      if (!oracle[i].sure) return;
      sure_and_filled += oracle[i].code == glm::vec3(0.0f) ? 0 : 1;
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(voxels.value(shape.grid, 0, i)[k], oracle[i].code[k], 1e-4f) << c.x << " " << c.y << " " << c.z;
        EXPECT_NEAR(voxels.value(shape.grid, 3, i)[k], oracle[i].radiance[k], 1e-4f);
      }
    });
    EXPECT_GT(sure_and_filled, resolution * resolution / 4);
  }
}

TEST_F(PaperVoxelsTest, TheSameBytesEveryTime) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<TestTriangle> triangles(40);
  for (TestTriangle& triangle : triangles) {
    for (glm::dvec3& corner : triangle.corners) corner = {uniform(random), uniform(random), uniform(random)};
    triangle.emission = glm::vec3(uniform(random));
  }
  const VoxelGrid grid = TestVolume(24).grid;
  EXPECT_EQ(voxelize(grid, triangles).planes, voxelize(grid, triangles).planes);
}

// A floor of albedo 0.6 under a sun of 5 W/m^2 straight above, seen from its back or its front: the cell takes the lit
// side, and its radiance is rho E / pi.
TEST_F(PaperVoxelsTest, TheLitSideDecidesTheNormal) {
  WorldLight sun;
  sun.type = LightType::kDirectional;
  sun.direction = {0.0f, -1.0f, 0.0f};
  sun.intensity = glm::vec3(5.0f);
  const VoxelGrid grid = TestVolume(8).grid;
  for (const bool looks_up : {true, false}) {
    TestTriangle floor{{glm::dvec3(0.0, 0.4, 0.0), glm::dvec3(0.0, 0.4, 3.0), glm::dvec3(3.0, 0.4, 0.0)}};
    floor.albedo = glm::vec3(0.6f, 0.3f, 0.0f);
    if (!looks_up) std::swap(floor.corners[1], floor.corners[2]);
    ASSERT_EQ(floor.normal().y > 0.0f, looks_up);
    const std::size_t cell = TestVolume(8).index({3, 3, 3});

    const TestVoxels lit = voxelize(grid, {floor}, {sun});
    EXPECT_NEAR(lit.value(grid, 0, cell).y, 1.0f, 1e-6f);
    EXPECT_NEAR(lit.value(grid, 3, cell).x, 0.6f * 5.0f / static_cast<float>(std::numbers::pi), 1e-5f);
    EXPECT_NEAR(lit.value(grid, 3, cell).y, 0.3f * 5.0f / static_cast<float>(std::numbers::pi), 1e-5f);
    EXPECT_EQ(lit.value(grid, 3, cell).z, 0.0f);

    const TestVoxels dark = voxelize(grid, {floor});
    EXPECT_NEAR(dark.value(grid, 0, cell).y, looks_up ? 1.0f : 0.0f, 1e-6f);
  }
}

// Injection: a hemisphere of the voxel's radiance about its decoded normal.
TEST_F(PaperVoxelsTest, VoxelsBecomeHemispheres) {
  const TestVolume shape(8);
  const std::size_t cell = shape.index({2, 5, 1});
  const glm::vec3 normal = glm::normalize(glm::vec3(-0.3f, 0.8f, 0.5f));
  std::vector<float> planes(std::size_t{glsl::kPaperVoxelPlanes} * shape.grid.cell_count, 0.0f);
  for (std::size_t k = 0; k < 3; ++k) {
    planes[k * shape.grid.cell_count + cell] = normal[static_cast<int>(k)] * 0.5f + 0.5f;
    planes[(3 + k) * shape.grid.cell_count + cell] = static_cast<float>(k + 1);
  }
  FrameGraph graph(executor().context());
  const BufferHandle voxels = graph.upload("voxels", std::span<const float>(planes));
  const PaperVolume volume = record_paper_injection(graph, shape.grid, voxels);
  const ReadbackTicket cells_ticket = graph.read_back(volume.cells);
  const ReadbackTicket light_ticket = graph.read_back(volume.light);
  run(graph);
  const auto cells = fetch<glm::vec4>(cells_ticket);
  const auto light = fetch<float>(light_ticket);
  shape.for_each_cell([&](glm::ivec3, std::size_t i) {
    EXPECT_EQ(cells[i].w, i == cell ? 1.0f : 0.0f);
    for (std::uint32_t channel = 0; channel < 3; ++channel) {
      const glm::vec4 sh = shape.coefficients(light, i, channel);
      const float radiance = i == cell ? static_cast<float>(channel + 1) : 0.0f;
      EXPECT_NEAR(sh.x, radiance * std::sqrt(std::numbers::pi), 1e-4);  // 2 pi / (2 sqrt(pi))
      const glm::vec3 linear = radiance * static_cast<float>(std::sqrt(3.0 * std::numbers::pi) / 2.0) * normal;
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(sh[k + 1], linear[k], 1e-4f);
    }
  });
}

}  // namespace
}  // namespace lightwell
