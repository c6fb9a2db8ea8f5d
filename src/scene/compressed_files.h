// glTF geometry compressed for tests by the libraries' own encoders.
#pragma once

#include <string>
#include <vector>

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

namespace lightwell::test {

// A grid of vertices in the plane z = 0, side - 1 squares a side.
inline std::vector<float> grid_positions(int side) {
  std::vector<float> positions;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) positions.insert(positions.end(), {float(x), float(y), 0.0f});
  return positions;
}

inline std::vector<std::uint32_t> grid_indices(int side) {
  std::vector<std::uint32_t> indices;
  for (int y = 0; y + 1 < side; ++y)
    for (int x = 0; x + 1 < side; ++x) {
      const auto v = static_cast<std::uint32_t>(y * side + x);
      const auto above = v + static_cast<std::uint32_t>(side);
      indices.insert(indices.end(), {v, v + 1, above + 1, v, above + 1, above});
    }
  return indices;
}

inline std::string embedded(const std::string& data) {
  return "data:a;base64," + base64(data);
}

// Of a buffer; "" is that of a GLB file.
inline std::string uri_member(const std::string& uri) {
  return uri.empty() ? "" : ",\"uri\":\"" + uri + "\"";
}

#if LIGHTWELL_MESHOPT

// The parts of a grid's two buffer views: `data` is the vertices', then the triangles'.
struct MeshoptGrid {
  MeshoptGrid(int side, const std::string& mode) : mode(mode), count(static_cast<std::size_t>(side * side)) {
    const std::vector<float> positions = grid_positions(side);
    const std::vector<std::uint32_t> indices = grid_indices(side);
    std::vector<unsigned char> vertices(meshopt_encodeVertexBufferBound(count, 12));
    vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), positions.data(), count, 12));
    std::vector<unsigned char> triangles(mode == "TRIANGLES" ? meshopt_encodeIndexBufferBound(indices.size(), count)
                                                             : meshopt_encodeIndexSequenceBound(indices.size(), count));
    triangles.resize(
        mode == "TRIANGLES"
            ? meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), indices.data(), indices.size())
            : meshopt_encodeIndexSequence(triangles.data(), triangles.size(), indices.data(), indices.size()));
    vertex_bytes = vertices.size();
    triangle_bytes = triangles.size();
    index_count = indices.size();
    data = raw_bytes(vertices) + raw_bytes(triangles);
  }

  // `lost_bytes` are missing at the end of the vertices.
  std::string text(const std::string& uri, std::size_t lost_bytes = 0) const {
    const auto n = [](std::size_t value) { return std::to_string(value); };
    const std::size_t fallback = count * 12 + index_count * 4;
    return gltf_of(R"("extensionsRequired":["EXT_meshopt_compression"],"buffers":[{"byteLength":)" + n(data.size()) +
                   uri_member(uri) + R"(},{"byteLength":)" + n(fallback) +
                   R"(,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}],"bufferViews":[
      {"buffer":1,"byteLength":)" +
                   n(count * 12) + R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteLength":)" +
                   n(vertex_bytes - lost_bytes) + R"(,"byteStride":12,"count":)" + n(count) +
                   R"(,"mode":"ATTRIBUTES"}}},{"buffer":1,"byteOffset":)" + n(count * 12) + R"(,"byteLength":)" +
                   n(index_count * 4) + R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteOffset":)" +
                   n(vertex_bytes) + R"(,"byteLength":)" + n(triangle_bytes) + R"(,"byteStride":4,"count":)" +
                   n(index_count) + R"(,"mode":")" + mode + R"("}}}],"accessors":[
      {"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
                   n(count) + R"(},{"bufferView":1,"componentType":5125,"type":"SCALAR","count":)" + n(index_count) +
                   R"(}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])");
  }

  std::string mode;  // of the triangles: "TRIANGLES" or "INDICES"
  std::size_t count;
  std::size_t vertex_bytes, triangle_bytes, index_count;
  std::string data;
};

#endif

#if LIGHTWELL_DRACO

struct DracoGrid {
  explicit DracoGrid(int side) : count(static_cast<std::size_t>(side * side)) {
    const std::vector<float> positions = grid_positions(side);
    const std::vector<std::uint32_t> indices = grid_indices(side);
    index_count = indices.size();
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
    if (encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()) data.assign(buffer.data(), buffer.size());
  }

  // Of the first `size` bytes and so many vertices.
  std::string text(const std::string& uri, std::size_t size, std::size_t vertex_count) const {
    const auto n = [](std::size_t value) { return std::to_string(value); };
    return gltf_of(R"("extensionsRequired":["KHR_draco_mesh_compression"],"buffers":[{"byteLength":)" + n(data.size()) +
                   uri_member(uri) + R"(}],"bufferViews":[{"buffer":0,"byteLength":)" + n(size) +
                   R"(}],"accessors":[{"componentType":5126,"type":"VEC3","count":)" + n(vertex_count) +
                   R"(},{"componentType":5123,"type":"SCALAR","count":)" + n(index_count) +
                   R"(}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,
        "extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}}]}])");
  }

  std::size_t count, index_count;
  std::string data;
};

#endif

}  // namespace lightwell::test
