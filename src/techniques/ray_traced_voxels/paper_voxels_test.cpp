// Material voxels of the published ray-traced voxels.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "techniques/ray_traced_voxels/paper_replay.h"
#include "techniques/ray_traced_voxels/paper_test_frame.h"

namespace lightwell {
namespace {

class PaperMaterialVoxels : public PaperStagesTest {};

constexpr std::uint32_t kSide = 16;

// Places on the walls of make_room(), one in each cell.
std::vector<std::pair<glm::vec3, glm::vec3>> wall_points(const VoxelGrid& grid) {
  std::vector<std::pair<glm::vec3, glm::vec3>> points;
  const glm::vec3 low(-1, 0, -1);
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1})
      for (std::uint32_t j = 0; j < kSide; ++j)
        for (std::uint32_t i = 0; i < kSide; ++i) {
          glm::vec3 at;
          at[axis] = low[axis] + 2.0f * static_cast<float>(side);
          for (const auto& [k, cell] : {std::pair{(axis + 1) % 3, i}, {(axis + 2) % 3, j}})
            at[k] = grid.origin[k] + (static_cast<float>(cell) + 0.5f) * grid.cell_size;
          glm::vec3 normal(0.0f);
          normal[axis] = side == 0 ? 1.0f : -1.0f;
          points.emplace_back(at, normal);
        }
  return points;
}

// Every wall of a room fills the cells that it lies in, as far as they are stored; nothing else is filled.
TEST_F(PaperMaterialVoxels, LieWhereWallsAre) {
  load(make_room({0.8f, 0.4f, 0.2f}).scene, {});
  const auto points = wall_points(grid(kSide));
  std::map<std::uint32_t, std::vector<glm::vec3>> expected;
  for (const auto& [at, normal] : points) expected[stored_index(grid(kSide), at)].push_back(normal);
  for (const VoxelWriter writer : kAllWriters) {
    const MaterialWords words = materials(kSide, writer);
    for (std::uint32_t i = 0; i < words.albedo.size(); ++i) {
      const auto found = expected.find(i);
      ASSERT_EQ(words.albedo[i] != 0, found != expected.end()) << i << " writer " << static_cast<int>(writer);
      ASSERT_EQ(words.normals[i] != 0, words.albedo[i] != 0);
      if (found == expected.end()) continue;
      const glm::vec3 albedo = unpack(words.albedo[i]);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(albedo[k], (glm::vec3(0.8f, 0.4f, 0.2f)[k]), 0.6f / 255.0f);
      const std::set<float> sides = [&] {
        std::set<float> all;
        for (const glm::vec3& n : found->second) all.insert(n.x + 3.0f * n.y + 9.0f * n.z);
        return all;
      }();
      if (sides.size() > 1) continue;  // an edge: the writer decides
      const glm::vec3 normal = glm::vec3(unpack(words.normals[i])) * 2.0f - 1.0f;
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(normal[k], found->second[0][k], 1.1f / 255.0f);
    }
  }
}

// The two lowest layers of cells share one, and nothing is stored in the highest: the published offset.
TEST_F(PaperMaterialVoxels, AreStoredOneTooLow) {
  load(make_room().scene, {});
  const MaterialWords words = materials(kSide, VoxelWriter::kMaximum);
  for (std::uint32_t i = 0; i < words.albedo.size(); ++i) {
    const glm::uvec3 cell(i % kSide, i / kSide % kSide, i / kSide / kSide);
    const bool is_last = cell.x == kSide - 1 || cell.y == kSide - 1 || cell.z == kSide - 1;
    EXPECT_TRUE(!is_last || words.albedo[i] == 0) << i;
  }
}

// Many triangles of two colours in one place: the exact writer's mean is that of all; the moving average's is near it.
// A voxel's count is that of fragments, up to 255.
TEST_F(PaperMaterialVoxels, MeanOfManyFragments) {
  QuadScene stack = make_floor();
  const int red = stack.add_material({1.0f, 0.0f, 0.0f});
  const int blue = stack.add_material({0.0f, 0.0f, 1.0f});
  constexpr int kQuads = 60;
  for (int i = 0; i < kQuads; ++i)
    stack.add_quad({-0.5f, 1.0f + 1e-4f * static_cast<float>(i), -0.5f}, {0, 0, 1}, {1, 0, 0}, i % 3 == 0 ? red : blue);
  load(stack.scene, {});
  const std::uint32_t voxel = stored_index(grid(kSide), {0.05f, 1.003f, 0.05f});
  const glm::vec4 exact = unpack(materials(kSide, VoxelWriter::kExact).albedo[voxel]);
  EXPECT_NEAR(exact.r, 1.0 / 3.0, 0.6 / 255.0);
  EXPECT_NEAR(exact.b, 2.0 / 3.0, 0.6 / 255.0);
  EXPECT_NEAR(exact.a * 255.0f, kQuads, 1e-3);
  const glm::vec4 average = unpack(materials(kSide, VoxelWriter::kAverage).albedo[voxel]);
  EXPECT_EQ(average.a, exact.a);
  EXPECT_NEAR(average.r, exact.r, 0.1);
  const glm::vec4 largest = unpack(materials(kSide, VoxelWriter::kMaximum).albedo[voxel]);
  EXPECT_EQ(glm::vec3(largest), glm::vec3(0.0f, 0.0f, 1.0f));  // blue counts first
  const glm::vec4 any = unpack(materials(kSide, VoxelWriter::kNone).albedo[voxel]);
  EXPECT_EQ(any.r + any.b, 1.0f);
}

// Opposite sides of a thin sheet cancel: one normal a voxel, as published.
TEST_F(PaperMaterialVoxels, OppositeNormalsCancel) {
  QuadScene sheet = make_floor();
  sheet.add_quad({-0.5f, 1.0f, -0.5f}, {0, 0, 1}, {1, 0, 0}, 0);
  sheet.add_quad({-0.5f, 1.001f, -0.5f}, {1, 0, 0}, {0, 0, 1}, 0);
  load(sheet.scene, {});
  const std::uint32_t voxel = stored_index(grid(kSide), {0.05f, 1.0005f, 0.05f});
  for (const VoxelWriter writer : {VoxelWriter::kAverage, VoxelWriter::kExact}) {
    const glm::vec3 normal = glm::vec3(unpack(materials(kSide, writer).normals[voxel])) * 2.0f - 1.0f;
    EXPECT_LT(glm::length(normal), 0.02f);
  }
}

// Textures colour voxels, alpha masks leave holes.
TEST_F(PaperMaterialVoxels, MasksLeaveHoles) {
  QuadScene floor = make_floor();
  Texture texture;
  texture.width = 2;
  texture.height = 1;
  texture.nearest = true;
  texture.rgba = {255, 255, 255, 255, 255, 255, 255, 0};
  floor.scene.textures.push_back(texture);
  Material& material = floor.scene.materials[0];
  material.base_color_texture.texture = 0;
  material.alpha_mode = AlphaMode::kMask;
  floor.scene.meshes[0].primitives[0].texcoords[0] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  load(floor.scene, {});
  const MaterialWords words = materials(kSide, VoxelWriter::kExact);
  EXPECT_NE(words.albedo[stored_index(grid(kSide), {-0.45f, 0.0f, 0.05f})], 0u);
  EXPECT_EQ(words.albedo[stored_index(grid(kSide), {0.45f, 0.0f, 0.05f})], 0u);
}

// Triangles at random: every voxel that is filled has one, and with the exact writer the same bytes come twice.
TEST_F(PaperMaterialVoxels, ExactIsTheSameTwice) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  QuadScene soup;
  for (int i = 0; i < 40; ++i) {
    const int material = soup.add_material({uniform(random), uniform(random), uniform(random)});
    const auto point = [&] { return glm::vec3(uniform(random), uniform(random), uniform(random)); };
    soup.add_quad(point(), 0.3f * (point() - 0.5f), 0.3f * (point() - 0.5f), material);
  }
  load(soup.scene, {});
  const MaterialWords once = materials(48, VoxelWriter::kExact);
  const MaterialWords again = materials(48, VoxelWriter::kExact);
  EXPECT_EQ(once.albedo, again.albedo);
  EXPECT_EQ(once.normals, again.normals);
  EXPECT_GT(std::count_if(once.albedo.begin(), once.albedo.end(), [](std::uint32_t w) { return w != 0; }), 100);
}

}  // namespace
}  // namespace lightwell
