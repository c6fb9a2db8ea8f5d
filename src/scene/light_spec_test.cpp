#include "scene/light_spec.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/log.h"
#include "core/test_images.h"
#include "scene/builtin.h"
#include "scene/test_files.h"

namespace lightwell {
namespace {

using namespace test;

WorldLight light_of(const std::string& spec) {
  Scene scene;
  add_light(scene, spec);
  validate(scene, spec);
  return take_snapshot(scene).lights.at(0);
}

template <typename Call>
std::string error_of(Call call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(LightSpec, SpotIsWhereAndAsDescribed) {
  const WorldLight spot = light_of("spot pos=1,2,3 dir=0,-2,0 intensity=4,5,6 inner=30 outer=60");
  EXPECT_EQ(spot.type, LightType::kSpot);
  EXPECT_VEC3_NEAR(spot.position, glm::vec3(1, 2, 3), 0.0f);
  EXPECT_VEC3_NEAR(spot.direction, glm::vec3(0, -1, 0), 1e-6f);
  EXPECT_VEC3_NEAR(spot.intensity, glm::vec3(4, 5, 6), 0.0f);
  EXPECT_NEAR(spot.cos_inner, std::sqrt(0.75f), 1e-6f);
  EXPECT_NEAR(spot.cos_outer, 0.5f, 1e-6f);
}

TEST(LightSpec, EveryDirectionIsReached) {
  const auto direction = [](const std::string& d) { return light_of("sun irradiance=3 dir=" + d).direction; };
  EXPECT_VEC3_NEAR(direction("0,0,1"), glm::vec3(0, 0, 1), 1e-6f);
  EXPECT_VEC3_NEAR(direction("0,0,-1"), glm::vec3(0, 0, -1), 1e-6f);
  EXPECT_VEC3_NEAR(direction("1e-30,0,0"), glm::vec3(1, 0, 0), 1e-6f);
  EXPECT_VEC3_NEAR(direction("1e-4,0,1"), glm::vec3(1e-4f, 0, 1), 1e-6f);
  EXPECT_VEC3_NEAR(direction("1e-3,0,1"), glm::vec3(1e-3f, 0, 1), 2e-6f);
  EXPECT_VEC3_NEAR(direction("-3e30,0,4e30"), glm::vec3(-0.6f, 0, 0.8f), 1e-6f);
}

TEST(LightSpec, ShortSunIsTheSameSun) {
  Scene scene;
  add_sun(scene, "  0.5,-1,0.25  10,9,8 ");
  const WorldLight sun = take_snapshot(scene).lights.at(0);
  const WorldLight in_full = light_of("sun dir=0.5,-1,0.25 irradiance=10,9,8");
  EXPECT_EQ(sun.type, LightType::kDirectional);
  EXPECT_EQ(sun.direction, in_full.direction);
  EXPECT_EQ(sun.intensity, in_full.intensity);
}

TEST(LightSpec, LightsAreAddedOrReplaced) {
  Scene scene;
  add_light(scene, "point pos=0,1,0 intensity=2");
  add_light(scene, "sun dir=0,-1,0 irradiance=1,1,1");
  EXPECT_EQ(take_snapshot(scene).lights.size(), 2u);
  remove_lights(scene);
  EXPECT_TRUE(take_snapshot(scene).lights.empty());
  add_light(scene, "point pos=0,1,0 intensity=2");
  EXPECT_EQ(take_snapshot(scene).lights.size(), 1u);
  validate(scene, "test");
}

TEST(LightSpec, FaultsAreErrorsOnOneLine) {
  for (const char* spec :
       {"", "lamp", "point", "point pos=1,2,3", "point pos=1,2 intensity=1", "point pos=1,2,3,4 intensity=1",
        "point pos=1,2,x intensity=1", "point pos=nan,0,0 intensity=1", "point pos=0,0,0 intensity=-1",
        "point pos=0,0,0 intensity=1,2", "point pos=0,0,0 intensity=1 intensity=2", "point 1",
        "point pos=0,0,0 intensity=1 dir=0,0,1", "spot pos=0,0,0 dir=0,0,0 intensity=1",
        "spot pos=0,0,0 dir=0,0,1 intensity=1 outer=91", "spot pos=0,0,0 dir=0,0,1 intensity=1 inner=50",
        "sun dir=0,-1,0 irradiance="}) {
    const std::string error = error_of([&] {
      Scene scene;
      add_light(scene, spec);
    });
    EXPECT_TRUE(error.starts_with("--light: ")) << spec;
  }
  for (const char* spec : {"", "0,-1,0", "0,-1,0 1 2", "0,-1 1", "0,0,0 1"}) {
    const std::string error = error_of([&] {
      Scene scene;
      add_sun(scene, spec);
    });
    EXPECT_TRUE(error.starts_with("--sun: ")) << spec;
  }
}

TEST(EnvironmentSpec, IsAConstantOrAMap) {
  EXPECT_EQ(parse_environment("1,2,3").radiance, glm::vec3(1, 2, 3));
  EXPECT_EQ(parse_environment("0.5").radiance, glm::vec3(0.5f));
  const TempFolder folder;
  Image map(4, 2);
  map.pixels.assign(map.pixels.size(), 2.0f);
  map.pixels[1] = -0.5f;
  save_exr(folder.path("sky.exr"), map);
  const Environment sky = parse_environment(folder.path("sky.exr"));
  EXPECT_EQ(sky.radiance, glm::vec3(1));
  EXPECT_EQ(sky.map.width, 4);
  EXPECT_EQ(sky.map.pixels[0], 2.0f);
  EXPECT_EQ(sky.map.pixels[1], 0.0f);
  for (const char* spec : {"", "-1,0,0", "1,2", "1,2,3,4", "1e19", "nowhere.hdr"})
    EXPECT_NE(error_of([&] { parse_environment(spec); }), "") << spec;
}

TEST(EnvironmentSpec, NumbersThatAreNoLightAreLimited) {
  const TempFolder folder;
  Image map(4, 2);
  map.pixels.assign(map.pixels.size(), 2.0f);
  map.at(1, 1)[0] = std::numeric_limits<float>::infinity();
  map.at(2, 1)[1] = std::numeric_limits<float>::quiet_NaN();
  map.at(3, 1)[2] = -std::numeric_limits<float>::infinity();
  map.at(3, 1)[0] = 1e20f;
  save_exr(folder.path("sky.exr"), map);
  const WarningCapture capture;
  const Image read = parse_environment(folder.path("sky.exr")).map;
  EXPECT_EQ(read.at(1, 1)[0], 65504.0f);
  EXPECT_EQ(read.at(2, 1)[1], 0.0f);
  EXPECT_EQ(read.at(3, 1)[2], 0.0f);
  EXPECT_EQ(read.at(3, 1)[0], 65504.0f);
  EXPECT_EQ(read.at(0, 0)[0], 2.0f);
  ASSERT_EQ(capture.warnings().size(), 1u);
  EXPECT_NE(capture.warnings()[0].find("4 values"), std::string::npos) << capture.warnings()[0];
  EXPECT_NE(capture.warnings()[0].find("x 1, y 1"), std::string::npos) << capture.warnings()[0];
}

TEST(EnvironmentSpec, FormatsOfLowRangeAreReadWithAWarning) {
  const TempFolder folder;
  Image map(4, 2);
  map.pixels.assign(map.pixels.size(), 1.0f);
  save_png(folder.path("sky.hdr"), map);
  const WarningCapture capture;
  EXPECT_EQ(parse_environment(folder.path("sky.hdr")).map.pixels, map.pixels);
  ASSERT_EQ(capture.warnings().size(), 1u);
}

TEST(EnvironmentSpec, VeryLargeMapsAreBroughtToAUsefulSize) {
  const TempFolder folder;
  Image map(10000, 20);
  map.pixels.assign(map.pixels.size(), 3.0f);
  save_exr(folder.path("sky.exr"), map);
  const WarningCapture capture;
  const Image read = parse_environment(folder.path("sky.exr")).map;
  EXPECT_EQ(read.width, 8192);
  EXPECT_EQ(read.height, 16);
  EXPECT_NEAR(read.at(8191, 15)[2], 3.0f, 1e-5f);
  EXPECT_EQ(capture.warnings().size(), 1u);
}

// A few bytes are no map of gigabytes, whatever their format.
TEST(EnvironmentSpec, SmallFilesThatUnfoldIntoMuchAreRefused) {
  const TempFolder folder;
  const auto error = [&](int side) {
    const std::vector<std::uint8_t> white(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) / 8, 255);
    const File file = encode_png_kind(side, side, white, {PNG_COLOR_TYPE_GRAY, 1, PNG_INTERLACE_NONE, {}});
    folder.write("sky.png", {reinterpret_cast<const char*>(file.data()), file.size()});
    return error_of([&] { parse_environment(folder.path("sky.png")); });
  };
  EXPECT_EQ(error(2048), "");
  EXPECT_NE(error(8192).find("can hardly hold 8192x8192 pixels"), std::string::npos);
}

TEST(BuiltinScenes, AreFoundByName) {
  const TempFolder folder;
  folder.write("zz-test-scene.gltf", "{}");
  folder.write("zz-other.txt", "");
  ::setenv("LIGHTWELL_SCENES", folder.path("").c_str(), 1);
  const std::vector<std::string> names = builtin_scene_names();
  const auto path = builtin_scene_path("zz-test-scene");
  const std::string file = resolve_scene(folder.path("zz-other.txt"));
  const std::string error = error_of([] { resolve_scene("zz-no-such-scene"); });
  ::unsetenv("LIGHTWELL_SCENES");
  EXPECT_EQ(std::count(names.begin(), names.end(), "zz-test-scene"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "zz-other"), 0);
  ASSERT_TRUE(path.has_value());
  EXPECT_TRUE(std::filesystem::exists(*path));
  EXPECT_EQ(file, folder.path("zz-other.txt"));
  EXPECT_NE(error.find("zz-test-scene"), std::string::npos);
}

}  // namespace
}  // namespace lightwell
