// Shadow maps of splats against a brute-force tracer, a closed form, and how the atlas is divided.
#include "techniques/photon_splatting/shadow_atlas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>

#include "graph/testing/device_test.h"
#include "techniques/photon_splatting/photon_test_frames.h"

namespace lightwell {
namespace {

// The frame of shaders/hemisphere.glsl.
std::array<glm::vec3, 2> across_ray(const glm::vec3& n) {
  const float side = n.z < 0.0f ? -1.0f : 1.0f;
  const float a = -1.0f / (side + n.z);
  const float b = n.x * n.y * a;
  return {glm::vec3(1.0f + side * n.x * n.x * a, side * b, -side * n.x), glm::vec3(b, side + n.y * n.y * a, -n.y)};
}

struct Hit {
  double distance = HUGE_VAL;
  glm::dvec3 normal{0.0};  // towards the ray
};

// Axis-aligned rectangles: one coordinate is fixed.
struct Rectangle {
  int axis;
  double place;
  glm::dvec3 low, high;
};

// The first of them on a ray from `begin` on.
Hit first_hit(const std::vector<Rectangle>& rectangles, const glm::dvec3& origin, const glm::dvec3& direction,
              double begin) {
  Hit hit;
  for (const Rectangle& rectangle : rectangles) {
    if (direction[rectangle.axis] == 0.0) continue;
    const double t = (rectangle.place - origin[rectangle.axis]) / direction[rectangle.axis];
    if (t < begin || t >= hit.distance) continue;
    const glm::dvec3 point = origin + t * direction;
    bool inside = true;
    for (int i = 0; i < 3; ++i)
      inside &= i == rectangle.axis || (point[i] >= rectangle.low[i] && point[i] <= rectangle.high[i]);
    if (!inside) continue;
    hit.distance = t;
    hit.normal = glm::dvec3(0.0);
    hit.normal[rectangle.axis] = direction[rectangle.axis] > 0.0 ? -1.0 : 1.0;
  }
  return hit;
}

// The sides of a box; `outwards`: its fronts face outwards.
void add_box(Scene& scene, std::vector<Rectangle>& rectangles, const glm::vec3& low, const glm::vec3& high,
             bool outwards) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      glm::vec3 corner = low;
      glm::vec3 a(0.0f), b(0.0f);
      corner[axis] = upper ? high[axis] : low[axis];
      a[(axis + 1) % 3] = high[(axis + 1) % 3] - low[(axis + 1) % 3];
      b[(axis + 2) % 3] = high[(axis + 2) % 3] - low[(axis + 2) % 3];
      if (upper != outwards) std::swap(a, b);
      add_quad(scene, corner, a, b, make_material({0.5f, 0.5f, 0.5f}));
      rectangles.push_back({axis, double{corner[axis]}, glm::dvec3(low), glm::dvec3(high)});
    }
  }
}

class SplatMapsTest : public DeviceTest {
 protected:
  SplatMapsTest() {
    add_box(scene_, rectangles_, {-1, -1, -1}, {1, 1, 1}, false);
    add_box(scene_, rectangles_, {-0.4f, -1, -0.5f}, {0.1f, 0.2f, 0.3f}, true);
  }
  PhotonFrames frames_of(const PhotonOptions& options) const {
    return {device(), scene_, {make_point_light({0.5f, 0.8f, 0.4f}, {1, 1, 1})}, options};
  }
  static glm::dvec3 texel_middle(const glsl::Splat& splat, std::uint32_t x, std::uint32_t y, std::uint32_t side) {
    const std::array<glm::vec3, 2> across = across_ray(splat.direction);
    const float u = (2.0f * static_cast<float>(x) + 1.0f) / static_cast<float>(side) - 1.0f;
    const float v = (2.0f * static_cast<float>(y) + 1.0f) / static_cast<float>(side) - 1.0f;
    return glm::dvec3(splat.center + splat.half_width * (u * across[0] + v * across[1]));
  }

  Scene scene_;  // a box on the floor of a closed room
  std::vector<Rectangle> rectangles_;
};

// Each texel is the distance to the first surface from the map's plane on, front or back.
TEST_F(SplatMapsTest, TexelsAreTheFirstSurfaceOnTheirRay) {
  for (const int map_size : {0, 1, 3}) {
    PhotonFrames frames = frames_of({.photons = 256,
                                     .bounces = 2,
                                     .width_mode = SplatWidth::kFixed,
                                     .width = 0.05f,
                                     .step_back = 0.06f,
                                     .map_size = map_size,
                                     .receiver_test = false});
    const PhotonFrame frame = frames.next();
    ASSERT_EQ(frame.map_side, 4u << map_size);
    std::size_t texels = 0, wrong = 0, empty = 0;
    for (std::uint32_t map = 0; map < frame.splats.size(); ++map) {
      const glsl::Splat& splat = frame.splats[map];
      ASSERT_EQ(splat.accepted, 1.0f);
      for (std::uint32_t y = 0; y < frame.map_side; ++y) {
        for (std::uint32_t x = 0; x < frame.map_side; ++x) {
          const glm::dvec3 direction(splat.direction);
          const glm::dvec3 origin =
              texel_middle(splat, x, y, frame.map_side) - static_cast<double>(splat.reach) * direction;
          const Hit hit = first_hit(rectangles_, origin, direction, 0.0);
          const double expected = std::min(hit.distance, 2.0 * static_cast<double>(splat.reach));
          ++texels;
          empty += expected == 2.0 * static_cast<double>(splat.reach) ? 1 : 0;
          wrong += std::abs(static_cast<double>(frame.texel(map, x, y)) - expected) > 1e-4 ? 1 : 0;
        }
      }
    }
    ASSERT_GT(texels, 256u * 16u);
    EXPECT_GT(texels, 4 * empty);
    EXPECT_LT(static_cast<double>(wrong), 1e-3 * static_cast<double>(texels)) << "rounding at edges only";
  }
}

// With the receiver test: rays begin where the photon's surface is, and only the surface of the center counts.
TEST_F(SplatMapsTest, TheReceiverTestKeepsTheSurfaceOfTheCenter) {
  for (const SplatKernel kernel : {SplatKernel::kBox, SplatKernel::kTent, SplatKernel::kGaussian}) {
    PhotonFrames frames = frames_of(
        {.photons = 1024, .bounces = 1, .kernel_photons = 40.0f, .most_width = 0.3f, .kernel = kernel, .map_size = 1});
    const PhotonFrame frame = frames.next();
    std::size_t texels = 0, wrong = 0, refused = 0;
    for (std::uint32_t map = 0; map < frame.splats.size(); ++map) {
      const glsl::Splat& splat = frame.splats[map];
      if (splat.flux == glm::vec3(0.0f)) continue;
      float accepted = 0.0f;
      float all = 0.0f;
      const glm::dvec3 normal(unpack_unit_vector(splat.normal));
      for (std::uint32_t y = 0; y < frame.map_side; ++y) {
        for (std::uint32_t x = 0; x < frame.map_side; ++x) {
          // All rays come from the light point's surface: the nearest axis-aligned one behind the center.
          const glm::dvec3 direction(splat.direction);
          const double reach = splat.reach;
          const glm::dvec3 middle = texel_middle(splat, x, y, frame.map_side);
          const Hit behind = first_hit(rectangles_, glm::dvec3(splat.center), -direction, 1e-4);
          const glm::dvec3 leaving = -behind.normal;  // the photon's surface, towards the photon: against -direction
          const double begin = reach - behind.distance +
                               glm::dot(middle - glm::dvec3(splat.center), leaving) / glm::dot(-leaving, direction);
          const Hit hit =
              first_hit(rectangles_, middle - reach * direction, direction, std::clamp(begin, 0.0, 2.0 * reach) + 1e-5);
          const glm::dvec3 place = middle + (hit.distance - reach) * direction;
          const bool lit = hit.distance <= 2.0 * reach && glm::dot(hit.normal, normal) > 0.6 &&
                           std::abs(glm::dot(place - glm::dvec3(splat.center), normal)) < 0.5 * splat.half_width;
          const double expected = lit ? hit.distance : 0.0;
          const double texel = frame.texel(map, x, y);
          all += texel_weight(kernel, x, y, frame.map_side);
          accepted += texel > 0.0 ? texel_weight(kernel, x, y, frame.map_side) : 0.0f;
          ++texels;
          refused += texel == 0.0 ? 1 : 0;
          wrong += std::abs(texel - expected) > 1e-3 ? 1 : 0;
        }
      }
      ASSERT_NEAR(splat.accepted, accepted / all, 1e-3f);
    }
    EXPECT_GT(refused, texels / 20);
    EXPECT_LT(refused, texels / 2);
    std::cout << "texels: " << texels << ", refused: " << refused << ", unlike the oracle's: " << wrong << "\n";
    EXPECT_LT(static_cast<double>(wrong), 0.01 * static_cast<double>(texels));
  }
}

TEST(SplatMapLayout, HoldsAllMapsOrSmallerOrFewer) {
  for (const std::uint32_t largest : {4096u, 8192u, 16384u}) {
    for (const std::uint32_t maps : {1u, 7u, 25000u, 1048576u, 8388608u}) {
      for (const std::uint32_t side : {4u, 8u, 16u, 32u}) {
        const SplatMapLayout layout = fit_splat_maps(maps, side, largest);
        EXPECT_LE(layout.maps_per_row * layout.map_side, std::min(largest, 8192u));
        EXPECT_LE(layout.rows * layout.map_side, std::min(largest, 8192u));
        EXPECT_GE(layout.maps_per_row * layout.rows, layout.capacity);
        EXPECT_LE(layout.maps_per_row * layout.rows, layout.capacity + layout.maps_per_row);
        EXPECT_LE(layout.map_side, side);
        EXPECT_LE(layout.capacity, maps);
        if (layout.capacity < maps) {
          EXPECT_EQ(layout.map_side, 4u);
        }
      }
    }
  }
  EXPECT_EQ(fit_splat_maps(2500, 32, 4096).map_side, 32u);
  EXPECT_EQ(fit_splat_maps(65536, 32, 4096).map_side, 16u);
  EXPECT_EQ(fit_splat_maps(8388608, 4, 8192).capacity, 4194304u);
}

}  // namespace
}  // namespace lightwell
