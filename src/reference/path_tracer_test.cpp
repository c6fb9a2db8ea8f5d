// What the path tracer promises beside its mean: determinism, materials, the camera, errors.
#include "lightwell/path_tracer.h"

#include <cstring>
#include <iostream>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "lightwell/error.h"
#include "reference/test_scenes.h"

namespace lightwell {
namespace {

bool same_bytes(const Image& a, const Image& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)) == 0;
}

// A room with every kind of light in it.
TestScene make_busy_scene() {
  TestScene busy;
  busy.add_quad({-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, busy.add_material({0.8f, 0.7f, 0.6f}));
  busy.add_sphere({0, 1, 0}, 1.0f, 12, false, busy.add_material({0.2f, 0.7f, 0.4f}));
  busy.add_quad({2, 3, -1}, {0, 0, 1}, {-1, 0, 0}, busy.add_material(glm::vec3{0.0f}, {4, 3, 2}));
  busy.snapshot.lights.push_back({LightType::kPoint, {-2, 2, 1}, {0, 0, -1}, {3, 2, 1}, 1.0f, 0.0f});
  busy.snapshot.lights.push_back({LightType::kDirectional, {0, 0, 0}, {0, -1, 0}, {1, 1, 2}, 1.0f, 0.0f});
  busy.scene.environment.radiance = {0.3f, 0.4f, 0.5f};
  busy.scene.environment.map = Image(4, 2, 3);
  for (std::size_t i = 0; i < busy.scene.environment.map.pixels.size(); ++i) {
    busy.scene.environment.map.pixels[i] = static_cast<float>(i % 5);
  }
  return busy;
}

const WorldCamera kBusyCamera = camera_at({3, 3, 5}, {0, 0.5f, 0}, {0, 1, 0}, 0.8f);

TEST(PathTracer, SameBytesWhateverTheNumberOfThreads) {
  const TestScene busy = make_busy_scene();
  PathTracerOptions options = test_options(50, 8, 6);
  options.height = 37;
  options.threads = 1;
  options.variance = true;
  const Picture one = busy.render(kBusyCamera, options);
  options.threads = 2;
  const Picture two = busy.render(kBusyCamera, options);
  EXPECT_TRUE(same_bytes(one.combined, two.combined));
  EXPECT_TRUE(same_bytes(one.direct, two.direct));
  EXPECT_TRUE(same_bytes(one.indirect, two.indirect));
  EXPECT_TRUE(same_bytes(one.normal, two.normal));
  EXPECT_TRUE(same_bytes(one.depth, two.depth));
  EXPECT_TRUE(same_bytes(one.variance, two.variance));
  options.seed = 2;
  EXPECT_FALSE(same_bytes(one.combined, busy.render(kBusyCamera, options).combined));
}

// The variance that a picture gives itself against how its mean differs between seeds, which share nothing.
TEST(PathTracer, VarianceIsThatOfTheMean) {
  const TestScene busy = make_busy_scene();
  const PathTracer tracer(busy.scene, busy.snapshot);
  constexpr int kSeeds = 128;
  for (const int samples : {5, 40}) {
    PathTracerOptions options = test_options(12, samples, 4);
    options.variance = true;
    glm::dvec3 told{0.0}, seen{0.0};
    std::vector<Picture> pictures;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      options.seed = seed;
      pictures.push_back(tracer.render(kBusyCamera, options));
      told += mean_of(pictures.back().variance) / double{kSeeds};
    }
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 12; ++x) {
        glm::dvec3 sum{0.0}, squares{0.0};
        for (const Picture& picture : pictures) {
          const float* rgb = picture.combined.at(x, y);
          const glm::dvec3 value{rgb[0], rgb[1], rgb[2]};
          sum += value;
          squares += value * value;
        }
        seen += (squares - sum * sum / double{kSeeds}) / (kSeeds - 1.0) / 144.0;
      }
    }
    for (int c = 0; c < 3; ++c) {
      EXPECT_GT(told[c] / seen[c], 0.87) << samples << " samples";
      EXPECT_LT(told[c] / seen[c], 1.15) << samples << " samples";
    }
    std::cout << samples << " samples: told over seen " << told.g / seen.g << "\n";
  }
  PathTracerOptions single = test_options(8, 1, 1);
  single.variance = true;
  EXPECT_TRUE(tracer.render(kBusyCamera, single).variance.pixels.empty());
  EXPECT_TRUE(tracer.render(kBusyCamera, test_options(8, 2, 1)).variance.pixels.empty());
}

TEST(PathTracer, CombinedIsTheSumOfItsParts) {
  const Picture picture = make_busy_scene().render(kBusyCamera, test_options(24, 4, 3));
  for (std::size_t i = 0; i < picture.combined.pixels.size(); ++i) {
    const float sum = picture.direct.pixels[i] + picture.indirect.pixels[i] + picture.emission.pixels[i];
    EXPECT_NEAR(picture.combined.pixels[i], sum, 1e-5f * (1.0f + sum));
  }
}

TEST(PathTracer, ProgressRisesToOneAndMayEndTheRendering) {
  const TestScene busy = make_busy_scene();
  const PathTracer tracer(busy.scene, busy.snapshot);
  float last = 0.0f;
  tracer.render(kBusyCamera, test_options(40, 1, 1), [&](float done) {
    EXPECT_GT(done, last);
    last = done;
  });
  EXPECT_EQ(last, 1.0f);
  const auto give_up = [](float) { throw InputError("test", "enough"); };
  EXPECT_THROW(tracer.render(kBusyCamera, test_options(40, 1, 1), give_up), InputError);
}

TEST(PathTracer, OptionsOutOfRangeAreNamed) {
  const TestScene empty;
  for (const auto& [member, value, name] :
       {std::tuple{&PathTracerOptions::width, 0, "width"}, std::tuple{&PathTracerOptions::height, 100000, "height"},
        std::tuple{&PathTracerOptions::samples, 0, "samples"},
        std::tuple{&PathTracerOptions::max_bounces, -1, "max-bounces"}}) {
    PathTracerOptions options;
    options.*member = value;
    try {
      empty.render(WorldCamera{}, options);
      FAIL() << name;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

TEST(PathTracer, AnEmptySceneIsBlack) {
  const Picture picture = TestScene{}.render(WorldCamera{}, test_options(8, 1, 4));
  EXPECT_EQ(mean_of(picture.combined), glm::dvec3(0.0));
}

// Pixels are square, x goes right, y down; depth is along the forward axis.
TEST(Camera, FramesWhatItShould) {
  TestScene wall;
  wall.add_quad({0, 0, -2}, {1, 0, 0}, {0, 1, 0}, wall.add_material({0, 1, 0}));    // right, above the axis
  wall.add_quad({-4, -1, -2}, {2, 0, 0}, {0, 1, 0}, wall.add_material({1, 0, 0}));  // far left, below it
  WorldCamera camera = camera_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.5707964f);
  PathTracerOptions options = test_options(40, 4, 0);
  options.width = 80;  // shows [-4, 4] x [-2, 2] of the plane z = -2
  const Picture picture = wall.render(camera, options);
  const auto albedo = [&](int x, int y) {
    return glm::vec3(picture.albedo.at(x, y)[0], picture.albedo.at(x, y)[1], 0);
  };
  EXPECT_EQ(albedo(41, 18), glm::vec3(0, 1, 0));
  EXPECT_EQ(albedo(49, 10), glm::vec3(0, 1, 0));
  EXPECT_EQ(albedo(51, 18), glm::vec3(0, 0, 0));
  EXPECT_EQ(albedo(1, 28), glm::vec3(1, 0, 0));
  EXPECT_EQ(albedo(19, 21), glm::vec3(1, 0, 0));
  EXPECT_EQ(albedo(1, 18), glm::vec3(0, 0, 0));
  EXPECT_NEAR(*picture.depth.at(1, 28), 2.0f, 1e-4f);
  EXPECT_NEAR(picture.normal.at(1, 28)[2], 1.0f, 1e-6f);
  camera.znear = 3.0f;
  EXPECT_EQ(mean_of(wall.render(camera, options).albedo), glm::dvec3(0.0)) << "nearer than znear";
}

// Parallel rays: what is behind looks no smaller.
TEST(Camera, OrthographicFramesWhatItShould) {
  for (const float distance : {2.0f, 20.0f, 2000.0f}) {
    TestScene wall;
    wall.add_quad({0, 0, -distance}, {1, 0, 0}, {0, 1, 0}, wall.add_material({0, 1, 0}));
    WorldCamera camera = camera_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.0f);
    camera.half_height = 2.0f;
    PathTracerOptions options = test_options(40, 4, 0);
    options.width = 80;  // shows [-4, 4] x [-2, 2]
    const Picture picture = wall.render(camera, options);
    EXPECT_EQ(picture.albedo.at(41, 18)[1], 1.0f);
    EXPECT_EQ(picture.albedo.at(49, 10)[1], 1.0f);
    EXPECT_EQ(picture.albedo.at(51, 18)[1], 0.0f);
    EXPECT_EQ(picture.albedo.at(45, 8)[1], 0.0f);
    EXPECT_NEAR(*picture.depth.at(45, 15), distance, 1e-4f * distance);
  }
}

// A white floor under a horizontal screen of the given alpha, lit from above by the sun or by a constant environment,
// which only rays of bounces find.
double floor_radiance(AlphaMode mode, float alpha, bool environment, bool camera_above) {
  TestScene scene;
  scene.add_quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, scene.add_material(glm::vec3{1.0f}));
  const int screen = scene.add_material(glm::vec3{0.0f});
  scene.scene.materials.back().base_color.a = alpha;
  scene.scene.materials.back().alpha_mode = mode;
  scene.scene.materials.back().alpha_cutoff = 0.3f;
  scene.add_quad({-500, 1, -500}, {0, 0, 1000}, {1000, 0, 0}, screen);
  if (environment) {
    scene.scene.environment.radiance = glm::vec3{1.0f};
  } else {
    scene.snapshot.lights.push_back({LightType::kDirectional, {0, 0, 0}, {0, -1, 0}, glm::vec3{kPi}, 1.0f, 0.0f});
  }
  const WorldCamera camera = camera_at({0, camera_above ? 2.0f : 0.5f, 0}, {0, 0, 0}, {0, 0, -1}, 0.01f);
  return mean_of(scene.render(camera, test_options(4, 64, 0)).direct).g;
}

TEST(AlphaMask, LetsCameraShadowAndBounceRaysThrough) {
  for (const bool environment : {false, true}) {
    for (const bool camera_above : {false, true}) {
      EXPECT_NEAR(floor_radiance(AlphaMode::kMask, 0.29f, environment, camera_above), 1.0, 0.01);
      EXPECT_NEAR(floor_radiance(AlphaMode::kBlend, 0.49f, environment, camera_above), 1.0, 0.01);
      EXPECT_NEAR(floor_radiance(AlphaMode::kMask, 0.31f, environment, camera_above), 0.0, 0.01);
      EXPECT_NEAR(floor_radiance(AlphaMode::kBlend, 0.51f, environment, camera_above), 0.0, 0.01);
      EXPECT_NEAR(floor_radiance(AlphaMode::kOpaque, 0.0f, environment, camera_above), 0.0, 0.01);
    }
  }
}

TEST(AlphaMask, TextureCutsHoles) {
  TestScene scene;
  scene.add_quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, scene.add_material(glm::vec3{1.0f}));
  const int screen = scene.add_material(glm::vec3{0.0f});
  scene.scene.materials.back().alpha_mode = AlphaMode::kMask;
  scene.scene.materials.back().base_color_texture.texture =
      scene.add_texture({255, 255, 255, 0, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255}, true);
  scene.add_quad({-1, 1, -1}, {0, 0, 2}, {2, 0, 0}, screen);
  scene.snapshot.lights.push_back({LightType::kDirectional, {0, 0, 0}, {0, -1, 0}, glm::vec3{kPi}, 1.0f, 0.0f});
  // From just under the screen, which would be in the way from above.
  const WorldCamera camera = camera_at({0, 0.9f, 0}, {0, 0, 0}, {0, 0, -1}, 2.0f * std::atan(1.0f / 0.9f));
  EXPECT_NEAR(mean_of(scene.render(camera, test_options(16, 64, 0)).direct).g, 0.25, 0.0025);
}

// The sun on a quad with a linearly filtered, repeated and scaled texture reflects the texture's mean.
TEST(Texture, ReflectsItsMeanAlbedo) {
  TestScene scene;
  const int material = scene.add_material(glm::vec3{0.5f});
  scene.scene.materials.back().base_color_texture.texture =
      scene.add_texture({255, 0, 128, 255, 0, 0, 128, 255, 0, 255, 128, 255}, false);
  scene.scene.materials.back().base_color_texture.transform = {3.0f, 0.0f, 0.0f, 3.0f, 0.25f, 0.0f};
  scene.add_quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, material);
  scene.snapshot.lights.push_back({LightType::kDirectional, {0, 0, 0}, {0, -1, 0}, glm::vec3{kPi}, 1.0f, 0.0f});
  const WorldCamera camera = camera_at({0, 1, 0}, {0, 0, 0}, {0, 0, -1}, 1.5707964f);
  const Picture picture = scene.render(camera, test_options(32, 64, 0));
  const glm::dvec3 expected{0.5 / 3.0, 0.5 / 3.0, 0.5 * 0.2158605};  // 128 / 255 decoded from sRGB
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(mean_of(picture.direct)[c], expected[c], 0.005 * expected[c]);
    EXPECT_NEAR(mean_of(picture.albedo)[c], expected[c], 0.005 * expected[c]);
  }
}

// A light of which half is black sends as much as a light of half its size, however it is sampled.
TEST(Texture, EmissionIsSampledWhereItIs) {
  glm::dvec3 means[2];
  for (const bool textured : {false, true}) {
    TestScene scene;
    scene.add_quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, scene.add_material(glm::vec3{1.0f}));
    const int light = scene.add_material(glm::vec3{0.0f}, glm::vec3{5.0f, 2.0f, 1.0f});
    if (textured) {
      scene.scene.materials.back().emission_texture.texture =
          scene.add_texture({255, 255, 255, 255, 0, 0, 0, 255}, true);
    }
    scene.add_quad({-1, 1.5f, -0.5f}, {textured ? 2.0f : 1.0f, 0, 0}, {0, 0, 1}, light);
    const WorldCamera camera = camera_at({0, 1, 0}, {0, 0, 0}, {0, 0, -1}, 0.5f);
    means[textured] = mean_of(scene.render(camera, test_options(16, 256, 0)).direct);
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(means[1][c], means[0][c], 0.01 * means[0][c]);
}

// A map that is black but for one small sun of known irradiance.
TEST(Environment, SmallSunInAMap) {
  TestScene scene;
  scene.add_quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, scene.add_material(glm::vec3{1.0f}));
  scene.scene.environment.radiance = glm::vec3{1.0f};
  Image& map = scene.scene.environment.map = Image(128, 64, 3);
  for (int c = 0; c < 3; ++c) map.at(40, 12)[c] = 1000.0f;
  // The bilinear texel is a tent, integrated numerically: E = integral L cos(theta) sin(theta) dtheta dphi.
  double expected = 0.0;
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i) {
    const double offset = 2.0 * (i + 0.5) / kSteps - 1.0;
    const double theta = static_cast<double>(kPi) * (12.5 + offset) / 64.0;
    expected += 1000.0 * (1.0 - std::abs(offset)) * std::cos(theta) * std::sin(theta) * 2.0 / kSteps;
  }
  expected *= static_cast<double>(kPi * kPi) / 64.0 * 2.0 / 128.0;
  const WorldCamera camera = camera_at({0, 1, 0}, {0, 0, 0}, {0, 0, -1}, 0.5f);
  const double irradiance = static_cast<double>(kPi) * mean_of(scene.render(camera, test_options(16, 256, 0)).direct).g;
  EXPECT_NEAR(irradiance, expected, 0.01 * expected);
}

class ListNames : public OptionVisitor {
 public:
  void visit(const OptionInfo& info, int& value, int minimum, int maximum) override {
    names += std::string(info.name) + " ";
    EXPECT_GE(value, minimum);
    EXPECT_LE(value, maximum);
    EXPECT_FALSE(info.help.empty());
  }
  void visit(const OptionInfo&, float&, float, float) override { FAIL(); }
  void visit(const OptionInfo&, bool&) override { FAIL(); }
  void visit(const OptionInfo&, int&, std::span<const std::string_view>) override { FAIL(); }
  std::string names;
};

TEST(PathTracerOptions, AreDescribed) {
  PathTracerOptions options;
  ListNames visitor;
  options.describe(visitor);
  EXPECT_EQ(visitor.names, "samples max-bounces seed threads ");
}

}  // namespace
}  // namespace lightwell
