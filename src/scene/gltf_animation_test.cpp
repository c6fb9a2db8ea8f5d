// Animations of glTF files against closed forms in double precision that share nothing with the code under test.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include "core/log.h"
#include "scene/test_files.h"

namespace lightwell {
namespace {

using namespace test;

constexpr double kTolerance = 1e-5;
constexpr std::size_t kTargets = 3;

struct Path {
  const char* name;
  const char* type;
  std::size_t components;  // of the accessor's type
  std::size_t width;       // numbers a key
};
constexpr Path kTranslation{"translation", "VEC3", 3, 3};
constexpr Path kRotation{"rotation", "VEC4", 4, 4};
constexpr Path kScale{"scale", "VEC3", 3, 3};
constexpr Path kWeights{"weights", "SCALAR", 1, kTargets};

// What one channel's sampler holds. Splines: tangent, value, tangent a key.
struct Keys {
  std::vector<float> times;
  std::vector<float> values;
  std::string interpolation;
};

std::vector<double> key(const Keys& keys, std::size_t width, std::size_t index) {
  const auto begin = keys.values.begin() + static_cast<std::ptrdiff_t>(index * width);
  return {begin, begin + static_cast<std::ptrdiff_t>(width)};
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

std::vector<double> weighted(double wa, const std::vector<double>& a, double wb, const std::vector<double>& b) {
  std::vector<double> sum(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) sum[i] = wa * a[i] + wb * b[i];
  return sum;
}

std::vector<double> unit(const std::vector<double>& v) {
  return weighted(1.0 / std::sqrt(dot(v, v)), v, 0.0, v);
}

// Shoemake 1985, along the shorter arc.
std::vector<double> slerp(const std::vector<double>& a, std::vector<double> b, double t) {
  if (dot(a, b) < 0.0) b = weighted(-1.0, b, 0.0, b);
  const double angle = std::acos(std::min(dot(a, b), 1.0));
  if (angle < 1e-9) return a;
  return weighted(std::sin((1.0 - t) * angle) / std::sin(angle), a, std::sin(t * angle) / std::sin(angle), b);
}

// glTF 2.0, appendix C, term by term.
std::vector<double> expected_at(const Path& path, const Keys& keys, double seconds) {
  const bool spline = keys.interpolation == "CUBICSPLINE";
  const std::size_t stride = spline ? 3 : 1;
  const auto value = [&](std::size_t k) { return key(keys, path.width, stride * k + (spline ? 1 : 0)); };
  const std::size_t last = keys.times.size() - 1;
  std::size_t k = 0;
  while (k < last && keys.times[k + 1] <= seconds) ++k;
  std::vector<double> result = value(k);
  if (k < last && seconds > keys.times[k] && keys.interpolation != "STEP") {
    const double duration = static_cast<double>(keys.times[k + 1]) - keys.times[k];
    const double t = (seconds - keys.times[k]) / duration;
    if (spline) {
      const std::vector<double> out = key(keys, path.width, 3 * k + 2), in = key(keys, path.width, 3 * k + 3);
      const double t2 = t * t, t3 = t * t * t;
      result = weighted(1.0, weighted(2 * t3 - 3 * t2 + 1, value(k), duration * (t3 - 2 * t2 + t), out), 1.0,
                        weighted(-2 * t3 + 3 * t2, value(k + 1), duration * (t3 - t2), in));
    } else if (path.width == kRotation.width) {
      result = slerp(unit(value(k)), unit(value(k + 1)), t);
    } else {
      result = weighted(1.0 - t, value(k), t, value(k + 1));
    }
  }
  return path.width == kRotation.width ? unit(result) : result;
}

// As the file orders them.
std::vector<double> state_of(const Node& node, const Path& path) {
  if (path.width == kRotation.width) return {node.rotation.x, node.rotation.y, node.rotation.z, node.rotation.w};
  if (path.name == kWeights.name) return {node.morph_weights.begin(), node.morph_weights.end()};
  const glm::dvec3 v = path.name == kScale.name ? glm::dvec3(node.scale) : node.translation;
  return {v.x, v.y, v.z};
}

// Rotations are the same with the opposite sign.
void expect_near(const std::vector<double>& actual, std::vector<double> expected, bool rotation,
                 const std::string& what) {
  ASSERT_EQ(actual.size(), expected.size()) << what;
  if (rotation && dot(actual, expected) < 0.0) expected = weighted(-1.0, expected, 0.0, expected);
  for (std::size_t i = 0; i < actual.size(); ++i) EXPECT_NEAR(actual[i], expected[i], kTolerance) << what << " " << i;
}

class GltfAnimation : public testing::Test {
 protected:
  std::string number(int value) { return std::to_string(value); }

  std::string sampler(const std::string& input, const std::string& output, const std::string& interpolation) {
    return R"({"input":)" + input + R"(,"output":)" + output + R"(,"interpolation":")" + interpolation + "\"}";
  }
  std::string sampler(const Path& path, const Keys& keys) {
    return sampler(number(builder_.floats("SCALAR", 1, keys.times)),
                   number(builder_.floats(path.type, path.components, keys.values)), keys.interpolation);
  }
  static std::string channel(int sampler, const std::string& target) {
    return R"({"sampler":)" + std::to_string(sampler) + R"(,"target":{)" + target + "}}";
  }
  static std::string on_node(const Path& path) { return std::string(R"("node":0,"path":")") + path.name + "\""; }

  // A node with a mesh of three morph targets, and these animations.
  Scene load(const std::string& animations) {
    const std::string position = number(builder_.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0}));
    return folder_.load(
        "a.gltf",
        builder_.text(R"("nodes":[{"mesh":0,"scale":[1,2,3]}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" +
                      position + R"(},"targets":[{},{},{}]}]}],"animations":[)" + animations + "]"));
  }
  Scene load_channel(const Path& path, const std::string& sampler) {
    return load(R"({"channels":[)" + channel(0, on_node(path)) + R"(],"samplers":[)" + sampler + "]}");
  }

  TempFolder folder_;
  GltfBuilder builder_;
};

std::vector<double> play(const Scene& scene, const Path& path, double seconds) {
  return state_of(animate_nodes(scene, scene.animations.at(0), static_cast<float>(seconds)).at(0), path);
}

Keys random_keys(std::mt19937& random, const Path& path, const std::string& interpolation, std::size_t count) {
  std::uniform_real_distribution<float> number(-2.0f, 2.0f), gap(0.05f, 1.0f);
  Keys keys{{}, {}, interpolation};
  for (std::size_t k = 0; k < count; ++k) keys.times.push_back((k == 0 ? 0.0f : keys.times.back()) + gap(random));
  keys.values.resize(count * path.width * (interpolation == "CUBICSPLINE" ? 3 : 1));
  for (float& value : keys.values) value = number(random);
  return keys;
}

TEST_F(GltfAnimation, EveryPathAndInterpolationFollowsItsFormula) {
  constexpr unsigned kSeed = 7;
  std::cout << "seed " << kSeed << std::endl;
  std::mt19937 random(kSeed);
  for (const Path& path : {kTranslation, kRotation, kScale, kWeights})
    for (const char* interpolation : {"STEP", "LINEAR", "CUBICSPLINE"})
      for (const std::size_t count : {1u, 2u, 6u}) {
        const Keys keys = random_keys(random, path, interpolation, count);
        const Scene scene = load_channel(path, sampler(path, keys));
        EXPECT_EQ(animation_end(scene.animations.at(0)), keys.times.back());
        std::vector<double> moments(keys.times.begin(), keys.times.end());
        for (double t = -0.5; t < keys.times.back() + 1.0; t += 0.0625) moments.push_back(t);
        for (const double t : moments)
          expect_near(play(scene, path, t), expected_at(path, keys, t), path.width == kRotation.width,
                      std::string(path.name) + " " + interpolation + " at " + std::to_string(t));
      }
}

// A quarter turn about an axis, whose angle grows evenly, seen through the snapshot.
TEST_F(GltfAnimation, TurnsCarryTheirChildren) {
  const float h = std::sqrt(0.5f);
  const Keys keys{{0.5f, 2.5f}, {0, 0, 0, 1, 0, 0, h, h}, "LINEAR"};
  const std::string turn = sampler(kRotation, keys);
  const Scene scene = folder_.load(
      "a.gltf",
      builder_.text(R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}},"nodes":[{"children":[1]},
      {"translation":[2,0,0],"extensions":{"KHR_lights_punctual":{"light":0}}}],"animations":[{"channels":[)" +
                    channel(0, on_node(kRotation)) + R"(],"samplers":[)" + turn + "]}]"));
  for (double t = 0.5; t <= 2.5; t += 0.125) {
    const double angle = (t - 0.5) / 2.0 * std::acos(0.0);
    const SceneSnapshot snapshot =
        take_snapshot(scene, animate_nodes(scene, scene.animations.at(0), static_cast<float>(t)));
    EXPECT_VEC3_NEAR(snapshot.lights.at(0).position, glm::vec3(2 * std::cos(angle), 2 * std::sin(angle), 0), 1e-5f);
  }
}

// Integers stand for numbers between -1 and 1 (glTF 2.0, 3.11): c / 127, c / 255, c / 32767, c / 65535.
TEST_F(GltfAnimation, NormalisedIntegersEqualTheirNumbers) {
  const std::string times = number(builder_.floats("SCALAR", 1, {0, 1}));
  const auto check = [&](const auto& integers, const Path& path, int component_type, double largest) {
    Keys keys{{0, 1}, {}, "LINEAR"};
    for (const auto c : integers)
      keys.values.push_back(static_cast<float>(std::max(static_cast<double>(c) / largest, -1.0)));
    const std::string output =
        number(builder_.accessor(R"("bufferView":)" + number(builder_.view(integers)) +
                                 R"(,"normalized":true,"componentType":)" + number(component_type) + R"(,"type":")" +
                                 path.type + R"(","count":)" + std::to_string(integers.size() / path.components)));
    const Scene scene = load_channel(path, sampler(times, output, "LINEAR"));
    for (const double t : {0.0, 0.3, 1.0})
      expect_near(play(scene, path, t), expected_at(path, keys, t), path.width == kRotation.width,
                  path.name + std::to_string(component_type));
  };
  check(std::vector<std::int8_t>{0, -128, 0, 0, 90, 0, -90, 5}, kRotation, 5120, 127);
  check(std::vector<std::uint8_t>{0, 255, 0, 0, 180, 0, 180, 5}, kRotation, 5121, 255);
  check(std::vector<std::int16_t>{0, -32768, 0, 0, 23170, 0, -23170, 9}, kRotation, 5122, 32767);
  check(std::vector<std::uint16_t>{0, 65535, 0, 0, 46341, 0, 46341, 9}, kRotation, 5123, 65535);
  check(std::vector<std::int8_t>{0, -128, 127, 64, -64, 1}, kWeights, 5120, 127);
  check(std::vector<std::uint8_t>{0, 255, 128, 64, 1, 2}, kWeights, 5121, 255);
  check(std::vector<std::int16_t>{0, -32768, 32767, 64, -64, 1}, kWeights, 5122, 32767);
  check(std::vector<std::uint16_t>{0, 65535, 32768, 64, 1, 2}, kWeights, 5123, 65535);
}

TEST_F(GltfAnimation, SparseOutputsAreFilledIn) {
  const std::string places = number(builder_.view(std::vector<std::uint8_t>{1}));
  const std::string values = number(builder_.view(std::vector<float>{3, 0, 6}));
  const std::string output = number(builder_.accessor(
      R"("componentType":5126,"type":"VEC3","count":3,"sparse":{"count":1,"indices":{"componentType":5121,"bufferView":)" +
      places + R"(},"values":{"bufferView":)" + values + "}}"));
  const std::string times = number(builder_.floats("SCALAR", 1, {0, 1, 2}));
  const Scene scene = load_channel(kTranslation, sampler(times, output, "LINEAR"));
  expect_near(play(scene, kTranslation, 0.5), {1.5, 0, 3}, false, "rising");
  expect_near(play(scene, kTranslation, 1.75), {0.75, 0, 1.5}, false, "falling");
}

// glTF wants times to rise strictly. Where they do not, the last of the keys of a time counts from then on.
TEST_F(GltfAnimation, KeysOfOneTimeAreAJump) {
  for (const char* interpolation : {"STEP", "LINEAR"}) {
    const Keys still{{0, 0}, {1, 0, 0, 2, 0, 0}, interpolation};
    const Scene scene = load_channel(kTranslation, sampler(kTranslation, still));
    EXPECT_EQ(animation_end(scene.animations.at(0)), 0.0f);
    expect_near(play(scene, kTranslation, -1), {1, 0, 0}, false, "before");
    expect_near(play(scene, kTranslation, 0), {2, 0, 0}, false, "then");
    const Keys jump{{1, 2, 2, 3}, {0, 0, 0, 4, 0, 0, 8, 0, 0, 8, 0, 0}, interpolation};
    const Scene cut = load_channel(kTranslation, sampler(kTranslation, jump));
    expect_near(play(cut, kTranslation, 2), {8, 0, 0}, false, "at the jump");
    expect_near(play(cut, kTranslation, 2.5), {8, 0, 0}, false, "behind the jump");
  }
}

TEST_F(GltfAnimation, MovesWhatItNamesAndNothingElse) {
  const std::string move = sampler(kTranslation, {{0, 1}, {0, 0, 0, 1, 0, 0}, "LINEAR"});
  const std::string sink = sampler(kTranslation, {{0, 4}, {0, 0, 0, 0, -8, 0}, "LINEAR"});
  set_log_level(LogLevel::kQuiet);
  const Scene scene = load(
      R"({"name":"move","channels":[)" + channel(0, on_node(kTranslation)) + "," + channel(0, R"("path":"scale")") +
      "," + channel(0, R"("node":0,"path":"pointer")") + R"(],"samplers":[)" + move +
      R"(]},{"name":"idle","channels":[)" + channel(0, R"("path":"translation")") + R"(],"samplers":[)" + move +
      R"(]},{"name":"sink","channels":[)" + channel(0, on_node(kTranslation)) + R"(],"samplers":[)" + sink + "]}");
  set_log_level(LogLevel::kWarning);
  ASSERT_EQ(scene.animations.size(), 2u);  // the one that moves nothing is left out
  EXPECT_EQ(scene.animations[0].channels.size(), 1u);
  EXPECT_EQ(scene.animations[1].name, "sink");
  expect_near(play(scene, kTranslation, 0.5), {0.5, 0, 0}, false, "move");
  const Node sunk = animate_nodes(scene, scene.animations[1], 1.0f).at(0);
  expect_near(state_of(sunk, kTranslation), {0, -2, 0}, false, "sink");
  expect_near(state_of(sunk, kScale), {1, 2, 3}, false, "at rest");
  EXPECT_EQ(scene.nodes.at(0).translation, glm::dvec3(0.0));
}

// Nodes outside the shown scene have no mesh here, and so no weights to move; their bones still move.
TEST_F(GltfAnimation, MayMoveWhatIsNotShown) {
  const std::string melt = sampler(kWeights, {{0, 1}, {0, 0, 0, 1, 1, 1}, "LINEAR"});
  const std::string move = sampler(kTranslation, {{0, 1}, {0, 0, 0, 1, 0, 0}, "LINEAR"});
  const std::string position = number(builder_.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0}));
  const Scene scene = folder_.load(
      "a.gltf",
      builder_.text(
          R"("scene":0,"scenes":[{"nodes":[]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" +
          position + R"(},"targets":[{},{},{}]}]}],"animations":[{"channels":[)" + channel(0, on_node(kWeights)) + "," +
          channel(1, on_node(kTranslation)) + R"(],"samplers":[)" + melt + "," + move + "]}]"));
  EXPECT_EQ(scene.animations.at(0).channels.size(), 1u);
  expect_near(play(scene, kTranslation, 1), {1, 0, 0}, false, "bone");
}

}  // namespace
}  // namespace lightwell
