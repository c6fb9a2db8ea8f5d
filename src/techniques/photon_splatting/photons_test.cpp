// Photons and their splats: no light is lost, they lie where they should, their width is that of as many neighbours as
// asked for, and memory follows their number.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iostream>
#include <limits>
#include <numbers>

#include "core/log.h"
#include "graph/testing/device_test.h"
#include "scene/builtin.h"
#include "techniques/photon_splatting/photon_test_frames.h"

namespace lightwell {
namespace {

constexpr double kPi = std::numbers::pi;
const glm::vec3 kAlbedo{0.5f, 0.25f, 0.75f};

class PhotonsTest : public DeviceTest {
 protected:
  static Scene box() { return make_box({1, 1.5f, 2}, make_material(kAlbedo)); }
  static std::vector<WorldLight> lamp() { return {make_point_light({0.1f, 0.2f, 0.3f}, {1, 2, 3})}; }
};

bool same_bytes(const PhotonFrame& a, const PhotonFrame& b) {
  const auto same = [](const auto& x, const auto& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
  };
  return same(a.counts, b.counts) && same(a.splats, b.splats);
}

// In a closed box every photon arrives, with the flux of its light point.
TEST_F(PhotonsTest, SplatsHaveTheFluxOfTheLightPoints) {
  for (const int bounces : {1, 4}) {
    for (const bool receiver_test : {false, true}) {
      PhotonFrames frames(device(), box(), lamp(),
                          {.photons = 4096, .bounces = bounces, .receiver_test = receiver_test});
      const PhotonFrame frame = frames.next();
      const glm::dvec3 points = sum_flux(frame.points, 0, frame.points.size());
      const glm::dvec3 splats = sum_flux(frame.splats);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(splats[c] / points[c], 1.0, 2e-4) << bounces << " bounces";
      const auto lit = std::count_if(frame.points.begin(), frame.points.end(),
                                     [](const glsl::LightPoint& point) { return point.flux != glm::vec3(0.0f); });
      EXPECT_EQ(frame.splats.size(), static_cast<std::size_t>(lit));
    }
  }
}

// Rounds of paths share the light: surface number k of a sphere of albedo 1/2 round pi W/sr reflects 4 pi^2 / 2^k W.
TEST_F(PhotonsTest, RoundsOfPathsAddUp) {
  for (const int stratify : {0, 3}) {
    PhotonFrames frames(device(), load_scene(resolve_scene("sphere")),
                        {.photons = 70000, .bounces = 2, .stratify = stratify, .receiver_test = false});
    const PhotonFrame frame = frames.next();
    const double expected = 4.0 * kPi * kPi * (0.5 + 0.25);
    EXPECT_NEAR(sum_flux(frame.splats).g / expected, 1.0, 0.01) << stratify;
    double photons = 0.0;
    for (const glsl::Splat& splat : frame.splats) photons += splat.photons;
    EXPECT_NEAR(photons / (70000 * 1.5), 1.0, 0.01) << stratify;
  }
}

// What a sphere reflects once arrives everywhere alike: in zones of equal area round each axis.
TEST_F(PhotonsTest, SplatsAreSpreadAsLightIs) {
  PhotonFrames frames(device(), load_scene(resolve_scene("sphere")),
                      {.photons = 16384, .bounces = 1, .receiver_test = false});
  const PhotonFrame frame = frames.next();
  const double all = sum_flux(frame.splats).g;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<double, 10> zones{};
    for (const glsl::Splat& splat : frame.splats) {
      const double place = 0.5 * static_cast<double>(splat.center[axis]) + 0.5;
      zones[static_cast<std::size_t>(std::clamp(10.0 * place, 0.0, 9.0))] += static_cast<double>(splat.flux.g);
    }
    for (const double zone : zones) EXPECT_NEAR(10.0 * zone / all, 1.0, 0.05) << axis;
  }
}

TEST_F(PhotonsTest, SplatsEndOnSurfacesAlongTheirRay) {
  const glm::vec3 half{1, 1.5f, 2};
  PhotonFrames frames(device(), box(), lamp(), {.photons = 4096, .bounces = 3});
  const PhotonFrame frame = frames.next();
  ASSERT_GT(frame.splats.size(), 4096u);
  for (std::size_t i = 0; i < frame.splats.size(); ++i) {
    const glsl::Splat& splat = frame.splats[i];
    ASSERT_EQ(splat.map, i);
    if (splat.flux == glm::vec3(0.0f)) continue;
    const glm::vec3 inside = half - glm::abs(splat.center);
    ASSERT_NEAR(std::min({inside.x, inside.y, inside.z}), 0.0f, 1e-5f);
    ASSERT_GT(std::min({inside.x, inside.y, inside.z}), -1e-5f);
    ASSERT_NEAR(glm::length(splat.direction), 1.0f, 1e-5f);
    ASSERT_LT(glm::dot(unpack_unit_vector(splat.normal), splat.direction), 0.0f);
    ASSERT_GT(splat.half_width, 0.0f);
    ASSERT_GT(splat.reach, 0.0f);
    ASSERT_GT(splat.accepted, 0.0f);
    ASSERT_LE(splat.accepted, 1.0f);
    ASSERT_EQ(splat.photons, 1.0f);
  }
}

// Points of the walls lie in about as many kernels as asked for, counted by brute force.
TEST_F(PhotonsTest, AdaptiveKernelsHoldAsManyPhotonsAsAskedFor) {
  for (const float wanted : {16.0f, 64.0f}) {
    PhotonFrames frames(device(), box(), lamp(),
                        {.photons = 16384,
                         .bounces = 1,
                         .kernel_photons = wanted,
                         .least_width = 1e-4f,
                         .most_width = 1.0f,
                         .receiver_test = false});
    const std::vector<glsl::Splat> splats = frames.next().splats;
    double held = 0.0;
    constexpr std::size_t kStep = 64;
    for (std::size_t i = 0; i < splats.size(); i += kStep) {
      const glm::vec3 normal = unpack_unit_vector(splats[i].normal);
      for (const glsl::Splat& other : splats) {
        const glm::vec3 offset = splats[i].center - other.center;
        if (glm::dot(unpack_unit_vector(other.normal), normal) < 0.9f || std::abs(glm::dot(offset, normal)) > 1e-3f)
          continue;
        const glm::vec3 across = offset - glm::dot(offset, other.direction) * other.direction;
        // In the disc of the kernel's area.
        if (kPi * glm::dot(across, across) < 4.0 * other.half_width * other.half_width) held += 1.0;
      }
    }
    held /= static_cast<double>(splats.size() / kStep);
    std::cout << "kernels that hold " << wanted << " photons: " << held << " at a point\n";
    EXPECT_GT(held, 0.4 * wanted);
    EXPECT_LT(held, 3.0 * wanted);
  }
}

TEST_F(PhotonsTest, WidthsStayWithinTheirBounds) {
  constexpr float kLess = 0.998f, kMore = 1.004f;  // as lengths are stored
  const PhotonOptions options{
      .photons = 1024, .bounces = 2, .kernel_photons = 50.0f, .least_width = 0.05f, .most_width = 0.06f};
  PhotonFrames frames(device(), box(), lamp(), options);
  const float diagonal = glm::length(frames.world.bounds.maximum - frames.world.bounds.minimum);
  int narrow = 0;  // whose maps did not meet their surface
  for (const glsl::Splat& splat : frames.next().splats) {
    narrow += splat.half_width < 0.5f * 0.05f * diagonal * kLess ? 1 : 0;
    ASSERT_GE(splat.half_width, 0.25f * 0.5f * 0.05f * diagonal * kLess);
    ASSERT_LE(splat.half_width, 0.5f * 0.06f * diagonal * kMore);
  }
  EXPECT_LT(narrow, 10);
  PhotonFrames alike(device(), box(), lamp(),
                     {.photons = 1024,
                      .bounces = 2,
                      .width_mode = SplatWidth::kFixed,
                      .width = 0.02f,
                      .step_back = 0.03f,
                      .receiver_test = false});
  for (const glsl::Splat& splat : alike.next().splats) {
    ASSERT_NEAR(splat.half_width / (0.01f * diagonal), 1.0f, 0.002f);
    ASSERT_LE(splat.reach, 0.03f * diagonal * kMore);
  }
}

// Kernels' areas shrink by (i + 2/3) / (i + 1) from frame i to the next, until something changes.
TEST_F(PhotonsTest, ProgressiveKernelsShrinkWhileNothingChanges) {
  for (const SplatWidth mode : {SplatWidth::kFixed, SplatWidth::kAdaptive}) {
    PhotonFrames frames(device(), box(), lamp(),
                        {.photons = 1024,
                         .bounces = 1,
                         .same_photons = true,
                         .width_mode = mode,
                         .width = 0.02f,
                         .receiver_test = false,
                         .progressive = true});
    const std::vector<glsl::Splat> first = frames.next().splats;
    double area = 1.0;
    for (int i = 1; i <= 5; ++i) {
      area *= (i + 2.0 / 3.0) / (i + 1.0);
      const std::vector<glsl::Splat> splats = frames.next().splats;
      double ratio = 0.0;
      for (std::size_t k = 0; k < first.size(); ++k)
        ratio += double{splats[k].half_width} / double{first[k].half_width} / static_cast<double>(first.size());
      EXPECT_NEAR(ratio, std::sqrt(area), 0.01) << i;  // but where the flight is shorter than the kernel is wide
    }
    frames.world.lights[0].position.x += 0.01f;
    frames.next();
    frames.world.lights = lamp();
    const std::vector<glsl::Splat> again = frames.next().splats;
    for (std::size_t k = 0; k < first.size(); ++k) ASSERT_EQ(again[k].half_width, first[k].half_width);
  }
}

// ---- limits ----

TEST_F(PhotonsTest, WithoutLightThereAreNoSplats) {
  const std::vector<std::vector<WorldLight>> none{
      {},
      {make_point_light({0, 0, 0}, {0, 0, 0})},
      {make_spot_light({0, 5, 0}, {0, 1, 0}, 10, 20, {1, 1, 1})}};  // shines past the box
  for (const std::vector<WorldLight>& lights : none) {
    for (const int stratify : {0, 2}) {
      PhotonFrames frames(device(), box(), lights, {.photons = 256, .stratify = stratify});
      const PhotonFrame frame = frames.next();
      EXPECT_EQ(frame.splats.size(), 0u);
      for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(frame.counts[glsl::kSplatGroups + i], 1u);
    }
  }
}

// Half of what a floor reflects flies away: the light points' splats are there, without flux.
TEST_F(PhotonsTest, PhotonsThatMeetNothingLightNothing) {
  Scene floor;
  add_quad(floor, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, make_material(kAlbedo));
  for (const int stratify : {0, 2}) {
    PhotonFrames frames(device(), floor, {make_sun({0, -1, 0}, {1, 1, 1})}, {.photons = 256, .stratify = stratify});
    const PhotonFrame frame = frames.next();
    EXPECT_GT(frame.splats.size(), 10u);
    for (const glsl::Splat& splat : frame.splats) ASSERT_EQ(splat.flux, glm::vec3(0.0f));
  }
}

TEST_F(PhotonsTest, BrokenTrianglesLeaveTheOthersTheirLight) {
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Scene scene = box();
    add_quad(scene, {-0.5f, 0, 0}, {0.1f, 0, 0}, {0, 0, 0.1f}, make_material({1, 1, 1}));
    scene.meshes.back().primitives[0].positions[2].x = value;
    for (const int stratify : {0, 2}) {
      PhotonFrames frames(device(), scene, lamp(), {.photons = 1024, .bounces = 3, .stratify = stratify});
      const PhotonFrame frame = frames.next();
      EXPECT_GT(sum_flux(frame.splats).g, 1.0);
      for (const glsl::Splat& splat : frame.splats) {
        for (int i = 0; i < 3; ++i) {
          ASSERT_TRUE(std::isfinite(splat.center[i]) && std::isfinite(splat.direction[i]));
          ASSERT_TRUE(std::isfinite(splat.flux[i]) && splat.flux[i] >= 0.0f);
        }
        ASSERT_TRUE(std::isfinite(splat.half_width) && std::isfinite(splat.reach) && std::isfinite(splat.accepted));
      }
    }
  }
}

TEST_F(PhotonsTest, EveryKindOfLightSendsPhotons) {
  Scene scene = load_scene(resolve_scene("cornell-box"));
  scene.environment.radiance = {0.5f, 0.7f, 0.9f};
  for (const int rsm_lights : {0, 16}) {
    PhotonFrames frames(device(), scene,
                        {make_point_light({0.2f, 0.3f, 0.1f}, {1, 2, 3}), make_sun({0.2f, -1, -0.9f}, {1, 1, 1})},
                        {.photons = 4096, .bounces = 2, .rsm_lights = rsm_lights, .receiver_test = false});
    const PhotonFrame frame = frames.next();
    EXPECT_GT(frame.splats.size(), 1000u);
    EXPECT_GT(sum_flux(frame.splats).g, 1.0);
  }
}

// ---- bytes ----

TEST_F(PhotonsTest, TheSameFrameIsTheSameBytes) {
  for (const int stratify : {0, 3}) {
    for (const bool same_photons : {false, true}) {
      const PhotonOptions options{
          .photons = 4096, .bounces = 3, .same_photons = same_photons, .stratify = stratify, .threshold = 4};
      PhotonFrames first(device(), box(), lamp(), options);
      PhotonFrames second(device(), box(), lamp(), options);
      const PhotonFrame frame = first.next();
      EXPECT_TRUE(same_bytes(frame, second.next()));
      EXPECT_EQ(same_bytes(frame, first.next()), same_photons);
    }
  }
}

// Splats, and the light points of several rounds, may be longer than one descriptor reaches.
TEST_F(PhotonsTest, PagesChangeNothing) {
  for (const int stratify : {0, 5}) {
    const PhotonOptions options{.photons = 70000, .bounces = 1, .stratify = stratify, .threshold = 1};
    PhotonFrames whole(device(), box(), lamp(), options);
    PhotonFrames paged(device(), box(), lamp(), options);
    paged.limit_descriptor_range(3 << 19);
    const PhotonFrame frame = whole.next();
    EXPECT_GT(frame.splats.size() * sizeof(glsl::StoredSplat), std::size_t{3 << 19});
    EXPECT_TRUE(same_bytes(frame, paged.next())) << stratify;
  }
}

// At most 64 bytes a photon beside the maps, whatever the bounces; what lists of splats need of each lies where its
// start was. Stratified photons, which are sorted all at once, need more, and whatever the grid no more than that.
TEST_F(PhotonsTest, MemoryFollowsThePhotons) {
  constexpr std::uint64_t kOnce = 1 << 15;  // counts, sums of blocks, numbers of the sequence, a guide
  for (const int photons : {16384, 65536}) {
    for (const int stratify : {0, 1, 5}) {
      for (const SplatWidth width : {SplatWidth::kFixed, SplatWidth::kAdaptive}) {
        const int bounces = photons == 16384 ? 4 : 1;
        PhotonFrames frames(device(), box(), lamp(),
                            {.photons = photons,
                             .bounces = bounces,
                             .guide = width == SplatWidth::kAdaptive,
                             .stratify = stratify,
                             .width_mode = width});
        const PhotonFrame frame = frames.next();
        const std::uint64_t per_photon = stratify == 0 ? 64u : 118u;
        EXPECT_LE(frame.photon_bytes + frame.splat_bytes, per_photon * 65536u + kOnce)
            << photons << " photons, stratify " << stratify;
        std::cout << photons << " photons, " << bounces << " bounces, " << (stratify > 0 ? 8 << stratify : 0)
                  << " cells: bytes a photon: " << static_cast<double>(frame.photon_bytes) / 65536 << ", splats "
                  << static_cast<double>(frame.splat_bytes) / 65536 << ", maps "
                  << static_cast<double>(4 * frame.atlas.size()) / 65536 << "\n";
      }
    }
  }
}

// The atlas has an end: maps shrink first, then there are fewer photons; one warning says so.
TEST_F(PhotonsTest, WithoutRoomForMapsThereAreFewerPhotons) {
  const WarningCapture capture;
  PhotonFrames many(device(), box(), lamp(), {.photons = 1 << 20, .bounces = 8, .map_size = 3});
  many.declare();
  many.declare();
  EXPECT_EQ(many.photons().map_side(), 4u);
  EXPECT_LE(many.photons().capacity(), 4194304u);
  EXPECT_GT(many.photons().capacity(), 1000000u);
  EXPECT_EQ(capture.warnings().size(), 1u);
  PhotonFrames few(device(), box(), lamp(), {.photons = 2500, .bounces = 1, .map_size = 3});
  few.declare();
  EXPECT_EQ(few.photons().map_side(), 32u);
  EXPECT_EQ(few.photons().capacity(), 2500u);
  EXPECT_EQ(capture.warnings().size(), 1u);
}

// A sun on a floor with a wall at one edge: between equal squares at a right angle the form factor is 0.20004.
TEST_F(PhotonsTest, AMillionPhotonsWork) {
  Scene corner;
  add_quad(corner, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, make_material(kAlbedo));
  add_quad(corner, {1, 0, -1}, {0, 0, 2}, {0, 2, 0}, make_material({0, 0, 0}));
  for (const int stratify : {0, 5}) {
    PhotonFrames frames(device(), corner, {make_sun({0, -1, 0}, {1, 1, 1})},
                        {.photons = 1 << 20, .bounces = 1, .stratify = stratify, .receiver_test = false});
    const PhotonFrame frame = frames.next();
    double photons = 0.0;
    for (const glsl::Splat& splat : frame.splats) photons += static_cast<double>(splat.photons);
    EXPECT_GT(photons, 0.99 * 1048576.0);  // some start beside the floor
    EXPECT_LE(photons, 1048576.0);
    EXPECT_NEAR(sum_flux(frame.splats).b / (4.0 * static_cast<double>(kAlbedo.b) * 0.20004), 1.0, 0.01) << stratify;
  }
}

}  // namespace
}  // namespace lightwell
