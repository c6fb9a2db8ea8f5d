// The research scenes: every file loads and holds as many triangles as its source says.
#include <filesystem>
#include <ostream>

#include <gtest/gtest.h>

#include "scene/test_files.h"

namespace lightwell {
namespace {

using namespace test;

struct SharedScene {
  const char* file;
  long triangles;
  std::size_t materials;
  std::size_t textures;
};

// The test's name.
void PrintTo(const SharedScene& scene, std::ostream* out) {
  *out << scene.file;
}

class SharedScenes : public testing::TestWithParam<SharedScene> {};

TEST_P(SharedScenes, HoldsItsTriangles) {
  const SharedScene& expected = GetParam();
  const std::string path = std::string(LIGHTWELL_SHARED_DIR "/scenes/") + expected.file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "missing " << path;
  const Scene scene = load_scene(path);
  EXPECT_EQ(triangle_count(scene), expected.triangles);
  EXPECT_EQ(scene.materials.size(), expected.materials);
  EXPECT_EQ(scene.textures.size(), expected.textures);
  EXPECT_FALSE(take_snapshot(scene).instances.empty());
}

INSTANTIATE_TEST_SUITE_P(Gltf, SharedScenes,
                         testing::Values(SharedScene{"sponza-crytek/sponza-crytek.gltf", 262267, 25, 24},
                                         SharedScene{"sponza-dabrovic/sponza-dabrovic.gltf", 66445, 19, 10},
                                         SharedScene{"sibenik/sibenik.gltf", 73564, 14, 3},
                                         SharedScene{"conference/conference.gltf", 331179, 35, 0},
                                         SharedScene{"breakfast-room-wig42/breakfast-room-wig42.gltf", 269538, 15, 3},
                                         SharedScene{"living-room-wig42/living-room-wig42.gltf", 143163, 19, 4},
                                         SharedScene{"classroom/classroom.gltf", 103832, 44, 3},
                                         SharedScene{"arena-zdm2/zdm2.glb", 58772, 0, 0},
                                         SharedScene{"cornell-box/cornell-original.gltf", 36, 8, 0},
                                         SharedScene{"cornell-box/cornell-sphere.gltf", 2188, 8, 0}));

INSTANTIATE_TEST_SUITE_P(Obj, SharedScenes,
                         testing::Values(SharedScene{"cornell-box/CornellBox-Original.obj", 36, 8, 0},
                                         SharedScene{"cornell-box/CornellBox-Mirror.obj", 36, 8, 0},
                                         SharedScene{"cornell-box/CornellBox-Glass.obj", 36, 8, 0},
                                         SharedScene{"cornell-box/CornellBox-Empty-RG.obj", 12, 6, 0},
                                         SharedScene{"cornell-box/CornellBox-Sphere.obj", 2188, 8, 0},
                                         SharedScene{"cornell-box/CornellBox-Glossy.obj", 1112, 8, 0},
                                         SharedScene{"cornell-box/CornellBox-Water.obj", 7088, 9, 0}));

INSTANTIATE_TEST_SUITE_P(Ply, SharedScenes,
                         testing::Values(SharedScene{"models/stanford-bunny.ply", 69666, 1, 0},
                                         SharedScene{"models/stanford-dragon-100k.ply", 100000, 1, 0},
                                         SharedScene{"models/stanford-dragon-res3.ply", 47794, 1, 0},
                                         SharedScene{"models/stanford-dragon-res4.ply", 11102, 1, 0},
                                         SharedScene{"models/stanford-buddha.ply", 100000, 1, 0}));

// The same box from OBJ and glTF: bounds, total area and emitted power per solid angle agree.
TEST(SharedCornellBox, IsTheSameFromObjAndGltf) {
  const std::string folder = LIGHTWELL_SHARED_DIR "/scenes/cornell-box/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "missing " << folder;
  struct Totals {
    double area = 0;
    glm::dvec3 emission{0.0};  // times area
    Bounds bounds;
  };
  const auto measure = [](const Scene& scene) {
    Totals totals;
    for (const Primitive& p : scene.meshes.at(0).primitives) {
      double area = 0;
      for (std::size_t i = 0; i < p.indices.size(); i += 3) {
        const glm::dvec3 a(p.positions[p.indices[i]]), b(p.positions[p.indices[i + 1]]),
            c(p.positions[p.indices[i + 2]]);
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
      }
      totals.area += area;
      totals.emission += area * glm::dvec3(scene.materials[static_cast<std::size_t>(p.material)].emission);
    }
    totals.bounds = take_snapshot(scene).bounds;
    return totals;
  };
  const Scene gltf = load_scene(folder + "cornell-original.gltf");
  Scene merged = gltf;  // one mesh a material in glTF
  for (std::size_t i = 1; i < gltf.meshes.size(); ++i)
    merged.meshes[0].primitives.insert(merged.meshes[0].primitives.end(), gltf.meshes[i].primitives.begin(),
                                       gltf.meshes[i].primitives.end());
  const Totals a = measure(merged), b = measure(load_scene(folder + "CornellBox-Original.obj"));
  EXPECT_NEAR(a.area, b.area, 1e-4);
  EXPECT_LT(glm::length(a.emission - b.emission), 1e-3);
  EXPECT_GT(b.emission.r, 1.0);
  EXPECT_VEC3_NEAR(a.bounds.minimum, b.bounds.minimum, 1e-5f);
  EXPECT_VEC3_NEAR(a.bounds.maximum, b.bounds.maximum, 1e-5f);
}

}  // namespace
}  // namespace lightwell
