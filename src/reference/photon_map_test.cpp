// Look-ups against all photons one by one, and estimates against the irradiance that the photons were made from.
#include "reference/photon_map.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "reference/sampling.h"

namespace lightwell {
namespace {

constexpr unsigned kSeed = 7;

class Photons : public testing::Test {
 protected:
  void SetUp() override { std::cout << "seed " << kSeed << "\n"; }

  float next() { return std::uniform_real_distribution<float>()(random_); }

  // Of 1 W in all, spread evenly over a square of the plane through the origin.
  std::vector<Photon> on_square(int count, float side, const glm::vec3& normal) {
    const glm::mat3 frame = make_frame(normal);
    std::vector<Photon> photons;
    for (int i = 0; i < count; ++i) {
      const glm::vec3 place{side * (next() - 0.5f), side * (next() - 0.5f), 0.0f};
      photons.push_back({frame * place, glm::vec3{1.0f / static_cast<float>(count)}, normal});
    }
    return photons;
  }

  // Evenly over the unit sphere, which they met from outside.
  std::vector<Photon> on_sphere(int count) {
    std::vector<Photon> photons;
    for (int i = 0; i < count; ++i) {
      const float z = 2.0f * next() - 1.0f, phi = 2.0f * kPi * next();
      const float r = std::sqrt(1.0f - z * z);
      const glm::vec3 place{r * std::cos(phi), r * std::sin(phi), z};
      photons.push_back({place, glm::vec3{1.0f / static_cast<float>(count)}, place});
    }
    return photons;
  }

  std::mt19937 random_{kSeed};
  PhotonMap::Scratch scratch_;
};

void append(std::vector<Photon>& to, const std::vector<Photon>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

// Distances as photon_map.h defines them.
std::vector<std::pair<float, float>> distances_and_fluxes(const std::vector<Photon>& photons, const glm::vec3& point,
                                                          const glm::vec3& normal) {
  std::vector<std::pair<float, float>> found;
  for (const Photon& photon : photons) {
    const float cosine = glm::dot(photon.normal, normal);
    if (cosine < PhotonMap::kLeastNormalCosine) continue;
    const float height = glm::dot(photon.position - point, normal);
    const float along = glm::length(photon.position - point - height * normal);
    found.emplace_back(std::max(along, std::abs(height) / PhotonMap::kDiscThickness), photon.flux.r * cosine);
  }
  std::sort(found.begin(), found.end());
  return found;
}

TEST_F(Photons, AreFoundAsOneByOne) {
  std::vector<Photon> photons = on_sphere(3000);
  append(photons, on_square(1000, 2.0f, {0, 0, 1}));
  append(photons, on_square(1000, 2.0f, {0, 0, -1}));
  append(photons, on_square(500, 2.0f, {1, 0, 0}));
  const PhotonMap map(photons);
  ASSERT_EQ(map.size(), photons.size());
  for (int i = 0; i < 200; ++i) {
    const Photon& at = photons[static_cast<std::size_t>(next() * static_cast<float>(photons.size()))];
    const glm::vec3 point = at.position + 0.01f * glm::vec3{next(), next(), next()};
    const int k = 2 + static_cast<int>(60.0f * next());
    const float max_radius = i % 4 == 0 ? 0.05f : 1.0f;
    const auto all = distances_and_fluxes(photons, point, at.normal);
    const PhotonMap::Estimate nearest = map.nearest(point, at.normal, k, max_radius, scratch_);
    const bool full =
        all.size() >= static_cast<std::size_t>(k) && all[static_cast<std::size_t>(k - 1)].first < max_radius;
    const float radius = full ? all[static_cast<std::size_t>(k - 1)].first : max_radius;
    float flux = 0.0f;
    int count = 0;
    for (; all[static_cast<std::size_t>(count)].first < radius; ++count)
      flux += all[static_cast<std::size_t>(count)].second;
    EXPECT_NEAR(nearest.radius, radius, 1e-4f * radius);
    EXPECT_EQ(nearest.photons, count);
    EXPECT_NEAR(nearest.irradiance.g, flux / (kPi * radius * radius), 1e-3f * nearest.irradiance.g + 1e-6f);
    // Between two of them, so that rounding decides nothing.
    const auto inside = static_cast<std::size_t>(k);
    const float between = 0.5f * (all[inside - 1].first + all[inside].first);
    if (all[inside].first - all[inside - 1].first < 1e-4f * between) continue;
    EXPECT_EQ(map.within(point, at.normal, between).photons, k);
  }
}

// The mean over many maps is right for small k, too.
TEST_F(Photons, OnAPlaneMeanTheirDensity) {
  for (const int k : {2, 5, 50}) {
    double sum = 0.0;
    constexpr int kMaps = 400;
    constexpr int kPoints = 10;
    for (int i = 0; i < kMaps; ++i) {
      const PhotonMap map(on_square(1500, 2.0f, {0, 1, 0}));
      for (int j = 0; j < kPoints; ++j) {
        const glm::vec3 point{next() - 0.5f, 0.0f, next() - 0.5f};
        sum += double{map.nearest(point, {0, 1, 0}, k, 0.5f, scratch_).irradiance.g} / (kMaps * kPoints);
      }
    }
    // Relative deviation of one estimate: 1 / sqrt(k - 2); of the mean with overlap of discs still 2 % for k = 2.
    EXPECT_NEAR(sum, 0.25, k == 2 ? 0.02 : 0.005) << "k = " << k;
  }
}

TEST_F(Photons, OnASphereMeanTheirDensity) {
  const PhotonMap map(on_sphere(200000));
  const float expected = 1.0f / (4.0f * kPi);
  for (const glm::vec3& direction :
       {glm::vec3{0, 0, 1}, glm::vec3{0.6f, 0.8f, 0}, glm::normalize(glm::vec3{-1, 2, 3})}) {
    EXPECT_NEAR(map.within(direction, direction, 0.3f).irradiance.g, expected, 0.03f * expected);
    EXPECT_NEAR(map.nearest(direction, direction, 2000, 1.0f, scratch_).irradiance.g, expected, 0.06f * expected);
  }
}

TEST_F(Photons, OfTheOtherSideOrOfAWallDoNotCount) {
  const PhotonMap map(on_square(10000, 2.0f, {0, 1, 0}));
  for (const glm::vec3& normal : {glm::vec3{0, -1, 0}, glm::vec3{1, 0, 0}, glm::vec3{0, 0, -1}}) {
    const PhotonMap::Estimate estimate = map.nearest({0, 0, 0}, normal, 50, 0.5f, scratch_);
    EXPECT_EQ(estimate.irradiance, glm::vec3{0.0f});
    EXPECT_EQ(estimate.radius, 0.5f);
    EXPECT_EQ(estimate.photons, 0);
  }
}

// A step of 0.1 m is higher than a quarter of any disc with 50 of the photons.
TEST_F(Photons, BehindAStepDoNotCount) {
  std::vector<Photon> photons = on_square(10000, 2.0f, {0, 1, 0});
  for (Photon& photon : photons) {
    if (photon.position.x > 0.0f) photon.position.y = 0.1f;
  }
  const PhotonMap map(photons);
  const float at_edge = map.nearest({-0.001f, 0, 0}, {0, 1, 0}, 50, 0.5f, scratch_).irradiance.g;
  EXPECT_NEAR(at_edge, 0.125f, 0.05f);
}

TEST_F(Photons, NoneAndOneAndMany) {
  const PhotonMap none({});
  EXPECT_EQ(none.nearest({0, 0, 0}, {0, 1, 0}, 5, 1.0f, scratch_).irradiance, glm::vec3{0.0f});
  EXPECT_EQ(none.within({0, 0, 0}, {0, 1, 0}, 1.0f).irradiance, glm::vec3{0.0f});
  EXPECT_EQ(none.photon_bytes(), 0u);
  const PhotonMap one({{{0, 0, 0}, glm::vec3{kPi}, {0, 1, 0}}});
  EXPECT_FLOAT_EQ(one.nearest({0, 0, 0}, {0, 1, 0}, 5, 2.0f, scratch_).irradiance.g, 0.25f);
  // Photons in one place: the disc has no area, and nothing that is not a number comes out.
  const PhotonMap heap(std::vector<Photon>(1000, {{1, 1, 1}, glm::vec3{1.0f}, {0, 1, 0}}));
  EXPECT_EQ(heap.nearest({1, 1, 1}, {0, 1, 0}, 5, 2.0f, scratch_).irradiance, glm::vec3{0.0f});
  EXPECT_EQ(heap.within({1, 1, 1}, {0, 1, 0}, 1.0f).photons, 1000);
}

}  // namespace
}  // namespace lightwell
