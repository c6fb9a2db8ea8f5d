// Compressed geometry is that of the same file without compression.
#include <gtest/gtest.h>

#include "scene/compressed_files.h"

namespace lightwell {
namespace {

using namespace test;

void expect_grid(const Scene& scene, int side) {
  EXPECT_EQ(triangle_count(scene), 2L * (side - 1) * (side - 1));
  EXPECT_VEC3_NEAR(area_vector(first_primitive(scene)), glm::vec3(0, 0, (side - 1) * (side - 1)), 0.01f);
}

#if LIGHTWELL_MESHOPT

TEST(GltfCompressed, MeshoptBuffersAreTheGrid) {
  const TempFolder folder;
  for (const int side : {2, 9, 40})
    for (const char* mode : {"TRIANGLES", "INDICES"}) {
      const MeshoptGrid grid(side, mode);
      expect_grid(folder.load("a.gltf", grid.text(embedded(grid.data))), side);
    }
}

TEST(GltfCompressed, DamagedMeshoptBuffersAreErrors) {
  const TempFolder folder;
  const MeshoptGrid grid(9, "TRIANGLES");
  const std::string uri = embedded(grid.data), good = grid.text(uri);
  EXPECT_NE(folder.error("a.gltf", grid.text(uri, 40)), "");
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
    EXPECT_NE(folder.error("a.gltf", bad), "");
}

#endif

#if LIGHTWELL_DRACO

TEST(GltfCompressed, DracoMeshesAreTheGrid) {
  const TempFolder folder;
  for (const int side : {2, 9, 20}) {
    const DracoGrid grid(side);
    const std::string uri = embedded(grid.data);
    expect_grid(folder.load("a.gltf", grid.text(uri, grid.data.size(), grid.count)), side);
    EXPECT_NE(folder.error("a.gltf", grid.text(uri, grid.data.size() / 2, grid.count)), "");
    EXPECT_NE(folder.error("a.gltf", grid.text(uri, grid.data.size(), grid.count + 1)), "");
  }
}

#endif

}  // namespace
}  // namespace lightwell
