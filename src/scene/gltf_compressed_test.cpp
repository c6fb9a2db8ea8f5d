// Compressed geometry is that of the same file without compression.
#include <gtest/gtest.h>

#include "scene/test_files.h"

#if LIGHTWELL_MESHOPT
#include <meshoptimizer.h>
#endif
#if LIGHTWELL_DRACO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#pragma GCC diagnostic pop
#endif

namespace lightwell {
namespace {

using namespace test;

class GltfCompressed : public testing::Test {
 protected:
  // A grid of vertices in the plane z = 0, side - 1 squares a side.
  static std::vector<float> grid_positions(int side) {
    std::vector<float> positions;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) positions.insert(positions.end(), {float(x), float(y), 0.0f});
    return positions;
  }
  static std::vector<std::uint32_t> grid_indices(int side) {
    std::vector<std::uint32_t> indices;
    for (int y = 0; y + 1 < side; ++y)
      for (int x = 0; x + 1 < side; ++x) {
        const auto v = static_cast<std::uint32_t>(y * side + x);
        const auto above = v + static_cast<std::uint32_t>(side);
        indices.insert(indices.end(), {v, v + 1, above + 1, v, above + 1, above});
      }
    return indices;
  }
  static std::string n(std::size_t value) { return std::to_string(value); }

  TempFolder folder_;
};

#if LIGHTWELL_MESHOPT

// glTF text of the grid with its two buffer views compressed; `filter` and `damage` go into the first view's extension.
std::string meshopt_grid(int side, const std::vector<float>& positions, const std::vector<std::uint32_t>& indices,
                         const std::string& mode, std::size_t lost_bytes = 0) {
  const auto n = [](std::size_t value) { return std::to_string(value); };
  const auto count = static_cast<std::size_t>(side * side);
  std::vector<unsigned char> vertices(meshopt_encodeVertexBufferBound(count, 12));
  vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), positions.data(), count, 12));
  std::vector<unsigned char> triangles(mode == "TRIANGLES" ? meshopt_encodeIndexBufferBound(indices.size(), count)
                                                           : meshopt_encodeIndexSequenceBound(indices.size(), count));
  triangles.resize(
      mode == "TRIANGLES"
          ? meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), indices.data(), indices.size())
          : meshopt_encodeIndexSequence(triangles.data(), triangles.size(), indices.data(), indices.size()));
  std::string data = raw_bytes(vertices) + raw_bytes(triangles);
  const std::size_t fallback = count * 12 + indices.size() * 4;
  return gltf_of(R"("extensionsRequired":["EXT_meshopt_compression"],"buffers":[{"byteLength":)" + n(data.size()) +
                 R"(,"uri":"data:a;base64,)" + base64(data) + R"("},{"byteLength":)" + n(fallback) +
                 R"(,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}],"bufferViews":[
      {"buffer":1,"byteLength":)" +
                 n(count * 12) + R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteLength":)" +
                 n(vertices.size() - lost_bytes) + R"(,"byteStride":12,"count":)" + n(count) +
                 R"(,"mode":"ATTRIBUTES"}}},{"buffer":1,"byteOffset":)" + n(count * 12) + R"(,"byteLength":)" +
                 n(indices.size() * 4) + R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteOffset":)" +
                 n(vertices.size()) + R"(,"byteLength":)" + n(triangles.size()) + R"(,"byteStride":4,"count":)" +
                 n(indices.size()) + R"(,"mode":")" + mode + R"("}}}],"accessors":[
      {"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
                 n(count) + R"(},{"bufferView":1,"componentType":5125,"type":"SCALAR","count":)" + n(indices.size()) +
                 R"(}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])");
}

TEST_F(GltfCompressed, MeshoptBuffersAreTheGrid) {
  for (const int side : {2, 9, 40})
    for (const char* mode : {"TRIANGLES", "INDICES"}) {
      const Scene scene = folder_.load("a.gltf", meshopt_grid(side, grid_positions(side), grid_indices(side), mode));
      EXPECT_EQ(triangle_count(scene), 2L * (side - 1) * (side - 1));
      EXPECT_VEC3_NEAR(area_vector(first_primitive(scene)), glm::vec3(0, 0, (side - 1) * (side - 1)), 0.01f);
    }
}

TEST_F(GltfCompressed, DamagedMeshoptBuffersAreErrors) {
  const std::string good = meshopt_grid(9, grid_positions(9), grid_indices(9), "TRIANGLES");
  EXPECT_NE(folder_.error("a.gltf", meshopt_grid(9, grid_positions(9), grid_indices(9), "TRIANGLES", 40)), "");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  for (const std::string& bad :
       {with("\"byteStride\":12", "\"byteStride\":10"), with("\"byteStride\":12", "\"byteStride\":260"),
        with("\"byteStride\":4", "\"byteStride\":3"), with("\"mode\":\"ATTRIBUTES\"", "\"mode\":\"POINTS\""),
        with("\"count\":81", "\"count\":9007199254740991"), with("\"count\":81", "\"count\":40"),
        with("\"mode\":\"ATTRIBUTES\"", "\"mode\":\"ATTRIBUTES\",\"filter\":\"QUATERNION\"")})
    EXPECT_NE(folder_.error("a.gltf", bad), "");
}

#endif

#if LIGHTWELL_DRACO

TEST_F(GltfCompressed, DracoMeshesAreTheGrid) {
  for (const int side : {2, 9, 20}) {
    const std::vector<float> positions = grid_positions(side);
    const std::vector<std::uint32_t> indices = grid_indices(side);
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(static_cast<int>(indices.size() / 3));
    const int id = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (std::size_t i = 0; i < indices.size(); i += 3)
      builder.SetAttributeValuesForFace(id, draco::FaceIndex(static_cast<std::uint32_t>(i / 3)),
                                        &positions[3 * indices[i]], &positions[3 * indices[i + 1]],
                                        &positions[3 * indices[i + 2]]);
    const auto mesh = builder.Finalize();
    draco::Encoder encoder;
    draco::EncoderBuffer buffer;
    ASSERT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    const std::string data(buffer.data(), buffer.size());
    const auto text = [&](std::size_t size, std::size_t count) {
      return gltf_of(R"("extensionsRequired":["KHR_draco_mesh_compression"],"buffers":[{"byteLength":)" +
                     n(data.size()) + R"(,"uri":"data:a;base64,)" + base64(data) +
                     R"("}],"bufferViews":[{"buffer":0,"byteLength":)" + n(size) + R"(}],"accessors":[
        {"componentType":5126,"type":"VEC3","count":)" +
                     n(count) + R"(},{"componentType":5123,"type":"SCALAR","count":)" + n(indices.size()) +
                     R"(}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,
        "extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}}]}])");
    };
    const auto points = static_cast<std::size_t>(side * side);
    const Scene scene = folder_.load("a.gltf", text(data.size(), points));
    EXPECT_EQ(triangle_count(scene), 2L * (side - 1) * (side - 1));
    EXPECT_VEC3_NEAR(area_vector(first_primitive(scene)), glm::vec3(0, 0, (side - 1) * (side - 1)), 0.01f);
    EXPECT_NE(folder_.error("a.gltf", text(data.size() / 2, points)), "");
    EXPECT_NE(folder_.error("a.gltf", text(data.size(), points + 1)), "");
  }
}

#endif

}  // namespace
}  // namespace lightwell
