#include "passes/gpu_scene/flatten.h"

#include <bit>

#include <gtest/gtest.h>

#include "lightwell/error.h"

namespace lightwell {
namespace {

Primitive triangle(int material) {
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  primitive.normals.assign(3, {0, 0, 1});
  primitive.texcoords[1] = {{0.1f, 0.2f}, {0.3f, 0.4f}, {0.5f, 0.6f}};
  primitive.indices = {0, 1, 2};
  primitive.material = material;
  return primitive;
}

// Material 0 is opaque, 1 has holes.
Scene two_primitives() {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[1].alpha_mode = AlphaMode::kMask;
  scene.meshes.resize(1);
  scene.meshes[0].primitives = {triangle(1), triangle(0)};
  return scene;
}

TEST(Flatten, InstancesShareTheirShapeButNotTheirVertices) {
  const Scene scene = two_primitives();
  const std::vector<MeshInstance> instances{{0, -1, glm::mat4(1)}, {0, -1, glm::mat4(1)}};
  const FlatGeometry flat = flatten_geometry(scene, instances, std::vector<bool>(4));
  EXPECT_EQ(flat.object_vertices.size(), 6u);
  EXPECT_EQ(flat.sources.size(), 12u);
  EXPECT_EQ(flat.sources[9].object_vertex, 3u);
  EXPECT_EQ(flat.sources[9].part, 3u);
}

TEST(Flatten, VerticesHaveTheTextureCoordinatesThatTheirMaterialUses) {
  Scene scene = two_primitives();
  scene.materials[1].base_color_texture.texcoord = 1;
  scene.materials[1].emission_texture.texcoord = 3;
  scene.meshes[0].primitives[0].texcoords[3] = {{7, 8}, {9, 10}, {11, 12}};
  const FlatGeometry flat = flatten_geometry(scene, {{0, -1, glm::mat4(1)}}, std::vector<bool>(2));
  EXPECT_EQ(flat.object_vertices[1].u, 0.3f);
  EXPECT_EQ(flat.object_vertices[1].v, 0.4f);
  EXPECT_EQ(flat.object_vertices[1].uv1, glm::vec4(9, 10, 0, 0));
  EXPECT_EQ(flat.object_vertices[4].u, 0.0f);  // the other one's material looks at set 0, which is not there
}

TEST(Flatten, WhiteVerticesHaveNoBitsOfColor) {
  Scene scene = two_primitives();
  EXPECT_FALSE(flatten_geometry(scene, {{0, -1, glm::mat4(1)}}, std::vector<bool>(2)).has_colors);
  scene.meshes[0].primitives[0].colors = {glm::vec4(1), glm::vec4(0), {1, 1, 1, 0.5f}};
  const FlatGeometry flat = flatten_geometry(scene, {{0, -1, glm::mat4(1)}}, std::vector<bool>(2));
  EXPECT_TRUE(flat.has_colors);
  const auto bits = [&](std::size_t vertex) {
    const glm::vec4& uv1 = flat.object_vertices[vertex].uv1;
    return glm::uvec2(std::bit_cast<std::uint32_t>(uv1.z), std::bit_cast<std::uint32_t>(uv1.w));
  };
  EXPECT_EQ(bits(0), glm::uvec2(0));
  EXPECT_EQ(bits(1), glm::uvec2(0x3fff0000u, 0x3fffffffu));
  EXPECT_EQ(bits(2), glm::uvec2(128u << 22, 0));
}

TEST(Flatten, ThousandsOfInstancesStoreTheirMeshOnce) {
  Scene scene = two_primitives();
  for (Primitive& primitive : scene.meshes[0].primitives) {
    primitive.morph_targets.resize(2);
    primitive.joints.assign(3, {0, 1, 0, 0});
    primitive.weights.assign(3, {0.5f, 0.5f, 0, 0});
  }
  const std::vector<MeshInstance> instances(3000, {0, -1, glm::mat4(1)});
  const FlatGeometry flat = flatten_geometry(scene, instances, std::vector<bool>(6000));
  EXPECT_EQ(flat.object_vertices.size(), 6u);
  EXPECT_EQ(flat.influences.size(), 6u);
  EXPECT_EQ(flat.morph_offsets.size(), 12u);
  EXPECT_EQ(flat.shape_bounds.size(), 2u);
  EXPECT_EQ(flat.indices.size(), 18000u);
  EXPECT_EQ(flat.parts.back().shape.first_object_vertex, 3u);
}

TEST(Flatten, RigidVerticesThatMayMoveFollowThoseThatStand) {
  const FlatGeometry flat = flatten_geometry(two_primitives(), {{0, -1, glm::mat4(1)}}, {true, false});
  ASSERT_EQ(flat.parts.size(), 2u);
  EXPECT_TRUE(flat.parts[0].has_holes);
  EXPECT_EQ(flat.parts[0].first_vertex, 3u);
  EXPECT_EQ(flat.parts[1].first_vertex, 0u);
  EXPECT_EQ(flat.indices, (std::vector<std::uint32_t>{3, 4, 5, 0, 1, 2}));
  EXPECT_EQ(flat.sources[3].part, 0u);
  EXPECT_EQ(flat.sources[3].object_vertex, 0u);
}

TEST(Flatten, VerticesOfEachKindThatMayMoveLieTogether) {
  Scene scene = two_primitives();
  scene.meshes[0].primitives[1].morph_targets.resize(1);
  const std::vector<MeshInstance> instances(2, {0, -1, glm::mat4(1)});
  const std::vector<FlatPart> parts = flatten_geometry(scene, instances, {true, false, false, true}).parts;
  EXPECT_EQ(parts[2].first_vertex, 0u);
  EXPECT_EQ(parts[0].first_vertex, 3u);
  EXPECT_EQ(parts[3].first_vertex, 6u);
  EXPECT_EQ(parts[1].first_vertex, 9u);
}

TEST(Flatten, InstancesShareJointsAndMorphTargets) {
  Scene scene = two_primitives();
  Primitive& deformed = scene.meshes[0].primitives[1];
  deformed.joints = {{0, 1, 300, 0}, {0, 0, 0, 0}, {2, 0, 0, 0}};
  deformed.weights.assign(3, {0.25f, 0.25f, 0.5f, 0.0f});
  deformed.morph_targets = {{std::vector<glm::vec3>(3, {1, 2, 3}), {}}, {{}, std::vector<glm::vec3>(3, {4, 5, 6})}};
  const FlatGeometry flat =
      flatten_geometry(scene, {{0, -1, glm::mat4(1)}, {0, -1, glm::mat4(1)}}, std::vector<bool>(4));
  EXPECT_EQ(flat.object_vertices.size(), 6u);
  ASSERT_EQ(flat.influences.size(), 3u);
  EXPECT_EQ(flat.influences[0].joints, glm::uvec4(0, 1, 300, 0));
  ASSERT_EQ(flat.morph_offsets.size(), 6u);
  EXPECT_EQ(flat.morph_offsets[2].position, glm::vec4(1, 2, 3, 0));
  EXPECT_EQ(flat.morph_offsets[2].normal, glm::vec4(0));
  EXPECT_EQ(flat.morph_offsets[3].normal, glm::vec4(4, 5, 6, 0));
  EXPECT_EQ(flat.parts[0].shape.joint_count, 0u);
  for (const std::size_t part : {1u, 3u}) {
    EXPECT_EQ(flat.parts[part].shape.joint_count, 301u);
    EXPECT_EQ(flat.parts[part].shape.first_influence, 0u);
    EXPECT_EQ(flat.parts[part].shape.morph_target_count, 2u);
    EXPECT_EQ(flat.parts[part].shape.first_object_vertex, 3u);
  }
}

TEST(Flatten, TheDefaultMaterialFollowsTheScenes) {
  Scene scene = two_primitives();
  scene.meshes[0].primitives[0].material = -1;
  EXPECT_EQ(flatten_geometry(scene, {{0, -1, glm::mat4(1)}}, {false, false}).parts[0].material, 2u);
  EXPECT_EQ(flatten_materials(scene, {}).size(), 3u);
}

TEST(Flatten, MaterialsSayHowTheirTexturesAreRead) {
  Scene scene;
  Texture texture;
  texture.wrap_u = Wrap::kMirroredRepeat;
  texture.wrap_v = Wrap::kClampToEdge;
  texture.nearest = true;
  texture.width = 40;
  texture.height = 5000;
  scene.textures.push_back(texture);
  Material material;
  material.alpha_mode = AlphaMode::kBlend;
  material.emission = {1, 2, 3};
  material.base_color_texture = {0, 1, {1, 2, 3, 4, 5, 6}};
  scene.materials.push_back(material);
  const glsl::GpuMaterial flat = flatten_materials(scene, {77})[0];
  EXPECT_EQ(flat.base_texture, 77u);
  EXPECT_EQ(flat.emission_texture, glsl::kNoTexture);
  EXPECT_EQ(flat.base_transform_0, glm::vec4(1, 3, 5, 2 * 1 + 8 * 2 + 32));
  EXPECT_EQ(flat.base_transform_1, glm::vec4(2, 4, 6, 40 + 4096 * 2048));
  EXPECT_EQ(flat.alpha_cutoff, 0.5f);
  EXPECT_EQ(flat.emission, glm::vec4(1, 2, 3, 0));
}

TEST(Flatten, MoreMaterialsThanIndicesAreInputErrors) {
  Scene scene;
  scene.materials.resize(glsl::kMaxMaterials);
  EXPECT_EQ(flatten_materials(scene, {}).size(), 65536u);
  scene.materials.emplace_back();
  EXPECT_THROW(flatten_materials(scene, {}), InputError);
}

}  // namespace
}  // namespace lightwell
