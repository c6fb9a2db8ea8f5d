// The lights and cameras that figures and tests of all techniques share.
#include <gtest/gtest.h>

#include <cctype>

#include <glm/geometric.hpp>

#include "gi_scenes.h"
#include "lightwell/path_tracer.h"

namespace lightwell {
namespace {

class GiScenes : public testing::TestWithParam<std::string> {};

double sum(const Image& image) {
  double total = 0.0;
  for (const float value : image.pixels) total += value;
  return total;
}

// But for the one in the sealed room, which is black.
TEST_P(GiScenes, CamerasSeeIndirectLight) {
  const std::optional<GiScene> lit = load_gi_scene(GetParam());
  if (!lit) GTEST_SKIP() << GetParam() << "'s file is not here";
  EXPECT_TRUE(lit->cameras.contains("own"));
  EXPECT_GE(lit->cameras.size(), 3u);
  EXPECT_GT(lit->exposure, 0.0f);
  const PathTracer tracer(lit->scene, lit->world);
  for (const auto& [name, camera] : lit->cameras) {
    SCOPED_TRACE(name);
    EXPECT_NEAR(glm::length(camera.forward), 1.0f, 1e-5f);
    PathTracerOptions options;
    options.width = options.height = 12;
    options.samples = 16;
    const Picture picture = tracer.render(camera, options);
    if (name == "sealed")
      EXPECT_EQ(sum(picture.indirect), 0.0);
    else
      EXPECT_GT(sum(picture.indirect), 0.02 * sum(picture.combined));
  }
}

INSTANTIATE_TEST_SUITE_P(All, GiScenes, testing::ValuesIn(gi_scene_names()), [](const auto& scene) {
  std::string name = scene.param;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

}  // namespace
}  // namespace lightwell
