// Light paths: closed forms of their flux, distributions of what they choose, and what stays the same. Against the path
// tracer: tests/light_paths_test.cpp.
#include "passes/light_paths/light_paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "core/luminance.h"
#include "graph/testing/device_test.h"
#include "passes/light_paths/testing/light_path_frames.h"
#include "passes/shadow_maps/shadow_views.h"
#include "scene/builtin.h"

namespace lightwell {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::array kSequences{PathSequence::kHalton, PathSequence::kSobol};
const glm::vec3 kAlbedo{0.5f, 0.25f, 0.75f};

std::string name_of(PathSequence sequence) {
  return sequence == PathSequence::kHalton ? "Halton" : "Sobol";
}

// As shaders/light_point.glsl unpacks it.
glm::vec3 unpack_normal(std::uint32_t packed) {
  const auto word = [](std::uint32_t bits) {
    return std::max(static_cast<float>(static_cast<std::int16_t>(bits & 0xffffu)) / 32767.0f, -1.0f);
  };
  const glm::vec2 p(word(packed), word(packed >> 16));
  glm::vec3 v(p, 1.0f - std::abs(p.x) - std::abs(p.y));
  if (v.z < 0.0f) {
    v.x = (1.0f - std::abs(p.y)) * (p.x < 0.0f ? -1.0f : 1.0f);
    v.y = (1.0f - std::abs(p.x)) * (p.y < 0.0f ? -1.0f : 1.0f);
  }
  return glm::normalize(v);
}

bool same_bytes(const LightPoints& a, const LightPoints& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(glsl::LightPoint)) == 0;
}

// That chi square exceeds this with `cells` - 1 degrees of freedom has a probability of 1e-4 (Wilson and Hilferty
// 1931). Points that are spread evenly stay far below.
double chi_square_limit(std::size_t cells) {
  const double freedom = static_cast<double>(cells) - 1.0;
  return freedom * std::pow(1.0 - 2.0 / (9.0 * freedom) + 3.719 * std::sqrt(2.0 / (9.0 * freedom)), 3.0);
}

double chi_square(const std::vector<double>& counts, const std::vector<double>& expected) {
  double sum = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    sum += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
  return sum;
}

class LightPathsTest : public DeviceTest {
 protected:
  static LightPathFrames frames_of(const Scene& scene, const std::vector<WorldLight>& lights,
                                   const LightPathSettings& settings) {
    return LightPathFrames(device(), scene, lights, settings);
  }

  static void expect_finite(const LightPoints& points) {
    for (const glsl::LightPoint& point : points)
      for (int i = 0; i < 3; ++i)
        ASSERT_TRUE(std::isfinite(point.position[i]) && std::isfinite(point.flux[i]) && point.flux[i] >= 0.0f);
  }
};

// ---- flux ----

// Light of pi W/sr in a closed sphere of albedo 1/2: surface number k reflects 4 pi^2 / 2^k W. (The Halton sequence's
// bases of the sixth surface are 59 and more: too large for the few paths that come so far.)
TEST_F(LightPathsTest, InAClosedSphereFluxIsAGeometricSeries) {
  LightPathFrames frames(device(), load_scene(resolve_scene("sphere")));
  for (const PathSequence sequence : kSequences) {
    for (const std::uint32_t maps : {0u, 16u}) {
      SCOPED_TRACE(name_of(sequence) + (maps > 0 ? ", from maps" : ", as rays"));
      const std::uint32_t bounces = sequence == PathSequence::kHalton ? 4 : 8;
      frames.settings = {.paths = 16384, .bounces = bounces, .rsm_lights = maps, .sequence = sequence};
      const LightPoints points = frames.next();
      for (std::size_t bounce = 1; bounce <= bounces; ++bounce) {
        const glm::dvec3 flux = sum_bounce(points, 16384, bounce);
        const double expected = 4.0 * kPi * kPi / std::exp2(bounce);
        // Of 16384 paths 2^(1 - bounce) are left; their number's error is at most that of independent ones.
        const double tolerance = bounce == 1 ? 0.003 : 0.003 + 3.0 * std::sqrt((std::exp2(bounce - 1) - 1.0) / 16384.0);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(flux[c] / expected, 1.0, tolerance) << "bounce " << bounce;
      }
    }
  }
}

// Walls that emit 1 W/(sr m^2) inwards: pi W/m^2 times the albedo, once more for every bounce.
TEST_F(LightPathsTest, InAFurnaceFluxIsAGeometricSeries) {
  const Scene box = make_box({1, 1.5f, 2}, make_material(kAlbedo, glm::vec3(1.0f)));
  LightPathFrames frames = frames_of(box, {}, {.paths = 16384, .bounces = 3});
  const double area = 2.0 * (2.0 * 3.0 + 3.0 * 4.0 + 4.0 * 2.0);
  const LightPoints points = frames.next();
  for (std::size_t bounce = 1; bounce <= 3; ++bounce) {
    const glm::dvec3 flux = sum_bounce(points, 16384, bounce);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(flux[c] / (kPi * area * std::pow(kAlbedo[c], bounce)), 1.0, bounce == 1 ? 0.002 : 0.02)
          << "bounce " << bounce << ", channel " << c;
  }
}

// Under a constant sky of radiance 1 every point outside a convex body receives pi W/m^2.
TEST_F(LightPathsTest, AConvexBodyUnderASkyReflectsPiTimesItsSurface) {
  Scene box = make_box({1, 1.5f, 2}, make_material(kAlbedo));
  box.environment.radiance = {1, 2, 3};
  LightPathFrames frames = frames_of(box, {}, {.paths = 16384, .bounces = 2});
  const double area = 2.0 * (2.0 * 3.0 + 3.0 * 4.0 + 4.0 * 2.0);
  const LightPoints points = frames.next();
  const glm::dvec3 first = sum_bounce(points, 16384, 1);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(first[c] / (kPi * area * kAlbedo[c] * (c + 1.0)), 1.0, 0.002);
  EXPECT_EQ(sum_bounce(points, 16384, 2), glm::dvec3(0.0));
}

// A plate under a sun and a sky, alone and with balls to aim at: the same light everywhere, from more paths near the
// focus.
TEST_F(LightPathsTest, AimsChangeNoiseAlone) {
  constexpr std::uint32_t kPaths = 65536;
  const glm::vec3 focus(20, 0.5f, -30);
  Scene plate;
  add_quad(plate, {-100, 0, 100}, {200, 0, 0}, {0, 0, -200}, make_material(kAlbedo));
  const WorldLight sun = make_sun({1, -1, 0.3f}, {3, 3, 3});
  const std::vector<FocusBall> balls{{focus, 1.0f}, {focus, 4.0f}, {focus, 16.0f}};
  for (const bool is_sun : {true, false}) {
    plate.environment.radiance = glm::vec3(is_sun ? 0.0f : 1.0f);
    const double irradiance = is_sun ? -3.0 * sun.direction.y : 2.0 * kPi;  // of both sides
    const std::vector<WorldLight> lights(is_sun ? 1 : 0, sun);
    std::vector<int> near_paths;
    for (const bool aims : {false, true}) {
      LightPathFrames frames = frames_of(plate, lights, {.paths = kPaths, .bounces = 1, .rsm_lights = 0});
      frames.settings.aims = aims ? balls : std::vector<FocusBall>();
      const LightPoints points = frames.next();
      expect_finite(points);
      near_paths.push_back(0);
      for (const float half : {0.5f, 5.0f, 100.0f}) {
        double flux = 0.0;
        for (const glsl::LightPoint& point : points) {
          const glm::vec2 beside = glm::abs(glm::vec2(point.position.x - focus.x, point.position.z - focus.z));
          const bool inside = half == 100.0f || std::max(beside.x, beside.y) < half;
          if (inside) flux += point.flux.x;
          if (half == 5.0f && inside && point.flux.x > 0.0f) ++near_paths.back();
        }
        const double expected = 4.0 * half * half * irradiance * kAlbedo.x;
        if (half == 100.0f || aims) {
          EXPECT_NEAR(flux / expected, 1.0, half == 0.5f ? 0.06 : 0.03) << half << (is_sun ? ", sun" : ", sky");
        }
      }
    }
    EXPECT_GT(near_paths[1], 20 * near_paths[0]);
  }
}

// ---- distributions ----

// Texels are chosen in proportion to the luminance of their flux: cells of 8 x 8 texels of every face.
TEST_F(LightPathsTest, TexelsAreChosenByTheirFlux) {
  const Scene scene = load_scene(resolve_scene("textured"));
  constexpr std::uint32_t kPaths = 65536;
  for (const WorldLight& light : {make_point_light({0, 2, 0.5f}, {1, 2, 3}), make_sun({-0.3f, -1, -0.4f}, {1, 1, 1}),
                                  make_spot_light({2, 3, 1}, {-1, -1, -0.5f}, 10, 35, {5, 5, 5})}) {
    for (const PathSequence sequence : kSequences) {
      SCOPED_TRACE(name_of(sequence) + ", type " + std::to_string(static_cast<int>(light.type)));
      LightPathFrames frames = frames_of(
          scene, {light}, {.paths = kPaths, .bounces = 1, .kinds = LightKinds::kLights, .sequence = sequence});
      frames.map_settings.tile_side = 128;
      const LightPathFrames::Maps maps = frames.next_maps();
      const LightPoints points = frames.next();
      const glsl::ShadowView& view = maps.views.at(0);
      const std::uint32_t columns = maps.width / 8;
      std::vector<double> counts(columns * maps.height / 8), expected(counts.size());
      std::uint32_t lost = 0;
      for (const glsl::LightPoint& point : points) {
        // The face whose view holds the point nearest to its middle.
        float best = 2.0f;
        glm::uvec2 cell(0);
        for (std::uint32_t face = 0; face < count_views(view); ++face) {
          const glm::vec4 clip = clip_from_world(view, face) * glm::vec4(point.position, 1.0f);
          const glm::vec2 ndc = glm::vec2(clip) / clip.w;
          const float off = std::max(std::abs(ndc.x), std::abs(ndc.y));
          if (clip.w <= 0.0f || off >= best) continue;
          best = off;
          const glm::vec2 texel = glm::min((0.5f * ndc + 0.5f) * 128.0f, glm::vec2(127.5f));
          cell = (view.tile + 128u * glm::uvec2(face % 3, face / 3) + glm::uvec2(texel)) / 8u;
        }
        if (best > 1.001f)
          ++lost;
        else
          counts[cell.y * columns + cell.x] += 1.0;
      }
      EXPECT_EQ(lost, 0u);
      for (std::uint32_t y = 0; y < maps.height; ++y)
        for (std::uint32_t x = 0; x < maps.width; ++x)
          expected[y / 8 * columns + x / 8] +=
              luminance(glm::dvec3(maps.flux[y * maps.width + x])) / double{maps.powers[0]} * kPaths;
      // Cells with few points count as one.
      std::vector<double> many{0.0}, many_expected{0.0};
      for (std::size_t i = 0; i < counts.size(); ++i) {
        if (expected[i] >= 16.0) {
          many.push_back(counts[i]);
          many_expected.push_back(expected[i]);
        } else {
          many[0] += counts[i];
          many_expected[0] += expected[i];
        }
      }
      ASSERT_GT(many.size(), 50u);
      EXPECT_LT(chi_square(many, many_expected), chi_square_limit(many.size()));
    }
  }
}

// Three suns of one channel each over a white floor, from above: their luminances are in proportion to how often they
// are chosen, in all paths and in every sixteenth.
TEST_F(LightPathsTest, SourcesAreChosenByTheirPower) {
  Scene scene;
  add_quad(scene, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, make_material({1, 1, 1}));
  const std::vector<WorldLight> lights{make_sun({0, -1, 0}, {9, 0, 0}), make_sun({0, -1, 0}, {0, 1, 0}),
                                       make_sun({0, -1, 0}, {0, 0, 20})};
  const glm::dvec3 powers =
      glm::dvec3(9, 1, 20) *
      glm::dvec3(luminance(glm::dvec3(1, 0, 0)), luminance(glm::dvec3(0, 1, 0)), luminance(glm::dvec3(0, 0, 1)));
  const glm::dvec3 parts = powers / (powers.x + powers.y + powers.z);
  constexpr std::size_t kPaths = 4096;
  for (const PathSequence sequence : kSequences) {
    for (const std::uint32_t maps : {0u, 16u}) {
      SCOPED_TRACE(name_of(sequence) + (maps > 0 ? ", from maps" : ", as rays"));
      LightPathFrames frames =
          frames_of(scene, lights, {.paths = kPaths, .bounces = 1, .rsm_lights = maps, .sequence = sequence});
      const LightPoints points = frames.next(3);
      for (std::size_t block = 0; block < 16; ++block) {
        glm::dvec3 counts(0.0);
        for (std::size_t i = block * kPaths / 16; i < (block + 1) * kPaths / 16; ++i)
          counts += glm::dvec3(glm::greaterThan(points[i].flux, glm::vec3(0.0f)));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(counts[c], parts[c] * kPaths / 16.0, 4.0) << "block " << block;
      }
    }
  }
}

// From one surface to the next: cos^2 of the angle to the normal is uniform, and so is the angle about it. In a large
// box nothing is lost; white surfaces end no path.
TEST_F(LightPathsTest, BouncesAreCosineDistributed) {
  constexpr std::size_t kPaths = 65536;
  const Scene box = make_box({1, 1, 1}, make_material({1, 1, 1}));
  for (const PathSequence sequence : kSequences) {
    LightPathFrames frames = frames_of(box, {make_point_light({0.3f, 0.2f, 0.1f}, {1, 1, 1})},
                                       {.paths = kPaths, .bounces = 4, .sequence = sequence});
    const LightPoints points = frames.next();
    for (std::size_t bounce = 2; bounce <= 4; ++bounce) {
      std::vector<double> counts(16 * 16);
      for (std::size_t i = 0; i < kPaths; ++i) {
        const glsl::LightPoint& from = points[(bounce - 2) * kPaths + i];
        const glsl::LightPoint& to = points[(bounce - 1) * kPaths + i];
        ASSERT_GT(to.flux.r, 0.0f);
        ASSERT_EQ(to.bounces, bounce);
        const glm::vec3 normal = unpack_normal(from.normal);
        const glm::vec3 direction = glm::normalize(to.position - from.position);
        const float cosine = glm::dot(normal, direction);
        const glm::vec3 tangent = std::abs(normal.x) > 0.5f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
        const double angle = std::atan2(glm::dot(glm::cross(normal, tangent), direction), glm::dot(tangent, direction));
        const auto column = std::min(static_cast<std::size_t>(16.0f * cosine * cosine), std::size_t{15});
        const auto row = static_cast<std::size_t>(16.0 * (angle / (2.0 * kPi) + 0.5)) % 16;
        counts[row * 16 + column] += 1.0;
      }
      EXPECT_LT(chi_square(counts, std::vector<double>(256, kPaths / 256.0)), chi_square_limit(256))
          << name_of(sequence) << ", bounce " << bounce;
    }
  }
}

// A pixel may see one sixteenth of the paths only.
TEST_F(LightPathsTest, EverySixteenthIsAFairSample) {
  const Scene scene = load_scene(resolve_scene("cornell-spot"));
  constexpr std::size_t kPaths = 1024;
  for (const PathSequence sequence : kSequences) {
    for (const std::uint32_t maps : {0u, 16u}) {
      SCOPED_TRACE(name_of(sequence) + (maps > 0 ? ", from maps" : ", as rays"));
      LightPathFrames frames(device(), scene);
      frames.settings = {.paths = kPaths, .bounces = 2, .rsm_lights = maps, .sequence = sequence};
      for (std::uint32_t round = 0; round < 4; ++round) {
        const LightPoints points = frames.next(round);
        const glm::dvec3 first = sum_bounce(points, kPaths, 1);
        const glm::dvec3 second = sum_bounce(points, kPaths, 2);
        for (std::size_t block = 0; block < 16; ++block) {
          const std::size_t begin = block * kPaths / 16;
          const glm::dvec3 first_here = 16.0 * sum_flux(points, begin, begin + kPaths / 16);
          const glm::dvec3 second_here = 16.0 * sum_flux(points, kPaths + begin, kPaths + begin + kPaths / 16);
          EXPECT_NEAR(luminance(first_here) / luminance(first), 1.0, 0.08) << "block " << block;
          EXPECT_NEAR(luminance(second_here) / luminance(second), 1.0, 0.4) << "block " << block;
        }
      }
    }
  }
}

// ---- areas ----

// The areas that points stand for add up to all that is lit: a box from within, a plate under a slanting sun.
TEST_F(LightPathsTest, AreasOfFirstSurfacesAddUpToWhatIsLit) {
  constexpr std::uint32_t kPaths = 16384;
  const Scene box = make_box({1, 1.5f, 2}, make_material(kAlbedo));
  const double all = 2.0 * (2.0 * 3.0 + 3.0 * 4.0 + 4.0 * 2.0);
  const WorldLight lamp = make_point_light({0.1f, 0.2f, 0.3f}, {1, 1, 1});
  Scene plate;
  add_quad(plate, {-1, 0, 1.5f}, {2, 0, 0}, {0, 0, -3}, make_material(kAlbedo));
  const WorldLight sun = make_sun({1, -1, 0.3f}, {3, 3, 3});
  const auto sum = [](const std::vector<float>& areas) {
    double total = 0.0;
    for (const float area : areas) total += double{area};
    return total;
  };
  for (const std::uint32_t maps : {0u, 16u}) {
    const LightPathSettings settings{.paths = kPaths, .bounces = 1, .rsm_lights = maps};
    LightPathFrames one_lamp = frames_of(box, {lamp}, settings);
    EXPECT_NEAR(sum(one_lamp.next_areas()) / all, 1.0, 0.02) << maps;
    LightPathFrames one_sun = frames_of(plate, {sun}, settings);
    EXPECT_NEAR(sum(one_sun.next_areas()) / 6.0, 1.0, 0.02) << maps;
    // Each of two lamps alike lights everything with half of the paths.
    LightPathFrames two_lamps = frames_of(box, {lamp, lamp}, settings);
    EXPECT_NEAR(sum(two_lamps.next_areas()) / (2.0 * all), 1.0, 0.02) << maps;
  }
}

// Of a white box's second surfaces: about the box's area, as every path goes on.
TEST_F(LightPathsTest, AreasOfLaterSurfacesAreOfTheRightSize) {
  constexpr std::uint32_t kPaths = 16384;
  LightPathFrames frames = frames_of(make_box({1, 1, 1}, make_material({1, 1, 1})),
                                     {make_point_light({0, 0, 0}, {1, 1, 1})}, {.paths = kPaths, .bounces = 2});
  const std::vector<float> areas = frames.next_areas();
  double second = 0.0;
  for (std::size_t i = kPaths; i < 2 * kPaths; ++i) second += double{areas[i]};
  EXPECT_GT(second, 0.5 * 24.0);
  EXPECT_LT(second, 4.0 * 24.0);
}

// ---- what stays the same ----

TEST_F(LightPathsTest, TheSameRoundOfTheSameSceneIsTheSameBytes) {
  LightPathFrames frames(device(), load_scene(resolve_scene("cornell-spot")));
  for (const PathSequence sequence : kSequences) {
    frames.settings.sequence = sequence;
    const LightPoints first = frames.next(7);
    const LightPoints other = frames.next(8);
    EXPECT_FALSE(same_bytes(first, other));
    EXPECT_TRUE(same_bytes(first, frames.next(7)));
  }
}

// Nothing is left of where a light was.
TEST_F(LightPathsTest, AMovedLightsPathsAreThoseOfALightThatWasAlwaysThere) {
  const Scene scene = load_scene(resolve_scene("cornell-spot"));
  LightPathFrames frames(device(), scene);
  const LightPoints before = frames.next();
  frames.world.lights[0].position.x += 0.1f;
  frames.world.lights[0].direction = glm::normalize(frames.world.lights[0].direction + glm::vec3(0.2f, 0, 0));
  const LightPoints after = frames.next();
  EXPECT_FALSE(same_bytes(before, after));
  LightPathFrames fresh(device(), scene, frames.world);
  EXPECT_TRUE(same_bytes(after, fresh.next()));
}

// ---- limits ----

TEST_F(LightPathsTest, WithoutLightThereIsNoFlux) {
  const Scene box = make_box({1, 1, 1}, make_material(kAlbedo));
  for (const std::vector<WorldLight>& lights :
       {std::vector<WorldLight>{}, {make_point_light({0, 0, 0}, {0, 0, 0}), make_sun({0, -1, 0}, {0, 0, 0})}}) {
    for (const std::uint32_t maps : {0u, 16u}) {
      LightPathFrames frames = frames_of(box, lights, {.rsm_lights = maps});
      const LightPoints points = frames.next();
      EXPECT_EQ(points.size(), 3 * 1024u);
      for (const glsl::LightPoint& point : points) ASSERT_EQ(point.flux, glm::vec3(0.0f));
    }
  }
}

TEST_F(LightPathsTest, BlackSurfacesReflectNothing) {
  Scene box = make_box({1, 1, 1}, make_material({0, 0, 0}, {1, 1, 1}));
  box.environment.radiance = {1, 1, 1};
  for (const std::uint32_t maps : {0u, 16u}) {
    LightPathFrames frames =
        frames_of(box, {make_point_light({0, 0, 0}, {1, 1, 1}), make_sun({0, -1, 0}, {1, 1, 1})}, {.rsm_lights = maps});
    for (const glsl::LightPoint& point : frames.next()) ASSERT_EQ(point.flux, glm::vec3(0.0f));
  }
}

// Sources that are not asked for send nothing.
TEST_F(LightPathsTest, KindsOfSourcesAddUp) {
  Scene scene = load_scene(resolve_scene("cornell-box"));
  scene.environment.radiance = {0.5f, 0.7f, 0.9f};
  constexpr std::uint32_t kPaths = 16384;
  LightPathFrames frames =
      frames_of(scene, {make_point_light({0.2f, 0.3f, 0.1f}, {1, 2, 3})}, {.paths = kPaths, .bounces = 1});
  const glm::dvec3 all = sum_bounce(frames.next(), kPaths, 1);
  glm::dvec3 sum(0.0);
  for (const LightKinds kind : {LightKinds::kLights, LightKinds::kEmitters, LightKinds::kEnvironment}) {
    frames.settings.kinds = kind;
    const glm::dvec3 flux = sum_bounce(frames.next(), kPaths, 1);
    EXPECT_GT(flux.g, 0.0);
    sum += flux;
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / all[c], 1.0, 0.01);
  frames.settings.kinds = LightKinds::kNone;
  EXPECT_EQ(sum_bounce(frames.next(), kPaths, 1), glm::dvec3(0.0));
}

// A spot that shines past everything, a point light far away, a light on a surface.
TEST_F(LightPathsTest, LightsOutsideTheSceneAreHarmless) {
  const Scene box = make_box({1, 1, 1}, make_material(kAlbedo));
  for (const std::uint32_t maps : {0u, 16u}) {
    LightPathFrames away =
        frames_of(box, {make_spot_light({0, 5, 0}, {0, 1, 0}, 10, 20, {1, 1, 1})}, {.rsm_lights = maps});
    for (const glsl::LightPoint& point : away.next()) ASSERT_EQ(point.flux, glm::vec3(0.0f));
    LightPathFrames far =
        frames_of(box, {make_point_light({0, 1e6f, 0}, {1e12f, 1e12f, 1e12f}), make_point_light({1, 0, 0}, {1, 1, 1})},
                  {.paths = 16384, .bounces = 1, .rsm_lights = maps});
    const LightPoints points = far.next();
    expect_finite(points);
    const glm::dvec3 flux = sum_bounce(points, 16384, 1);
    // 1 W/m^2 on the box's 4 m^2 from above, and half to all of the other light.
    for (int c = 0; c < 3; ++c) {
      EXPECT_GT(flux[c], 0.99 * kAlbedo[c] * (4.0 + 2.0 * kPi));
      EXPECT_LT(flux[c], 1.01 * kAlbedo[c] * (4.0 + 4.0 * kPi));
    }
  }
}

TEST_F(LightPathsTest, BrokenTrianglesLeaveTheOthersTheirLight) {
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Scene scene = make_box({1, 1, 1}, make_material(kAlbedo, {0.1f, 0.1f, 0.1f}));
    scene.environment.radiance = {1, 1, 1};
    add_quad(scene, {-0.5f, 0, 0}, {0.1f, 0, 0}, {0, 0, 0.1f}, make_material({1, 1, 1}));
    scene.meshes.back().primitives[0].positions[2].x = value;
    for (const std::uint32_t maps : {0u, 16u}) {
      LightPathFrames frames =
          frames_of(scene, {make_point_light({0, 0.5f, 0}, {1, 1, 1}), make_sun({0.3f, -1, 0.2f}, {1, 1, 1})},
                    {.rsm_lights = maps});
      const LightPoints points = frames.next();
      expect_finite(points);
      for (std::size_t bounce = 1; bounce <= 3; ++bounce) EXPECT_GT(sum_bounce(points, 1024, bounce).g, 0.0);
    }
  }
}

// The floor under a screen without opaque texels, and under one without holes.
TEST_F(LightPathsTest, AnAlphaMaskLetsLightThrough) {
  for (const float alpha : {0.2f, 0.9f}) {
    Scene scene;
    Material screen = make_material({0, 1, 0});
    screen.base_color.a = alpha;
    screen.alpha_mode = AlphaMode::kMask;
    add_quad(scene, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, make_material({1, 0, 0}));
    add_quad(scene, {-5, 1, 5}, {10, 0, 0}, {0, 0, -10}, screen);
    for (const std::uint32_t maps : {0u, 16u}) {
      LightPathFrames frames = frames_of(scene, {make_sun({0, -1, 0}, {1, 1, 1})}, {.rsm_lights = maps});
      const glm::dvec3 flux = sum_bounce(frames.next(), 1024, 1);
      EXPECT_NEAR(alpha < 0.5f ? flux.r : flux.g, 100.0, 1.0);
      EXPECT_EQ(alpha < 0.5f ? flux.g : flux.r, 0.0);
    }
  }
}

// Light points lie off their surface on the side that is lit, so that rays between them meet nothing in an empty box.
TEST_F(LightPathsTest, PointsLieJustInsideTheirBox) {
  const glm::vec3 half{1, 2, 3};
  for (const std::uint32_t maps : {0u, 16u}) {
    LightPathFrames frames = frames_of(make_box(half, make_material({1, 1, 1})),
                                       {make_point_light({0.3f, 0.2f, 0.1f}, {1, 1, 1})}, {.rsm_lights = maps});
    for (const glsl::LightPoint& point : frames.next()) {
      const glm::vec3 inside = half - glm::abs(point.position);
      ASSERT_GT(std::min({inside.x, inside.y, inside.z}), 0.0f);
      ASSERT_LT(std::min({inside.x, inside.y, inside.z}), 1e-4f);
      ASSERT_LT(glm::dot(unpack_normal(point.normal), point.position), 0.0f);
    }
  }
}

// ---- cost ----

// Prints times; run by hand: lightwell_passes_test --gtest_also_run_disabled_tests
// --gtest_filter='*LightPathsTest*Cost'
TEST_F(LightPathsTest, DISABLED_Cost) {
  const std::string sponza = LIGHTWELL_SHARED_DIR "/scenes/sponza-crytek/sponza-crytek.gltf";
  std::vector<std::pair<std::string, Scene>> scenes{{"cornell-spot", load_scene(resolve_scene("cornell-spot"))}};
  if (std::filesystem::exists(sponza)) scenes.emplace_back("sponza-crytek", load_scene(sponza, {.scale = 0.01f}));
  for (const auto& [name, scene] : scenes) {
    std::vector<WorldLight> lights = take_snapshot(scene).lights;
    if (name == "sponza-crytek") lights = {make_spot_light({-8, 8, 0}, {1, -1, 0.1f}, 20, 45, {500, 500, 500})};
    for (const std::uint32_t maps : {0u, 16u}) {
      for (const std::uint32_t paths : {1024u, 4096u}) {
        LightPathFrames frames(device(), scene, lights, {.paths = paths, .bounces = 3, .rsm_lights = maps});
        std::map<std::string, double> times;
        for (int i = 0; i < 6; ++i) {
          frames.world.lights[0].position.y += 0.001f;
          frames.next();
          for (const auto& [pass, time_ms] : frames.times_ms)
            if (i > 0 && (pass.starts_with("rsm: ") || pass.starts_with("light paths: "))) times[pass] += time_ms / 5.0;
        }
        std::cout << name << ", " << paths << " paths x 3 surfaces, " << (maps > 0 ? "from maps" : "as rays")
                  << ", ms:";
        double sum = 0.0;
        for (const auto& [pass, time_ms] : times) {
          std::cout << " " << pass << " " << std::round(100.0 * time_ms) / 100.0 << ";";
          sum += time_ms;
        }
        std::cout << " all " << std::round(100.0 * sum) / 100.0 << "\n";
      }
    }
  }
}

// ---- the picture ----

// Discs are seen where the camera sees the points, and hidden behind what is nearer.
TEST_F(LightPathsTest, ThePictureShowsThePointsThatTheCameraSees) {
  Scene scene;
  add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, make_material({0, 1, 0}));
  WorldCamera camera;
  camera.position = {0, 0, 3};
  const auto count_bright = [&](const Scene& shown) {
    LightPathFrames frames = frames_of(shown, {make_point_light({0, 0, 1}, {1, 1, 1})}, {.paths = 64, .bounces = 2});
    const Image image = frames.picture(128, camera, LightPointColor::kFlux);
    int bright = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) bright += image.pixels[i + 1] > 0.5f;
    return bright;
  };
  EXPECT_GT(count_bright(scene), 200);
  // The light is between the wall and the screen that hides it.
  add_quad(scene, {-1, -1, 2}, {2, 0, 0}, {0, 2, 0}, make_material({0, 0, 0}));
  EXPECT_EQ(count_bright(scene), 0);
}

}  // namespace
}  // namespace lightwell
