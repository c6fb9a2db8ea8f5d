// Bundles against a slow oracle: which light points they hold, what they add up to, whose place they take.
#include "techniques/photon_splatting/stratify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "graph/testing/device_test.h"
#include "passes/voxel_grid/voxel_grid.h"
#include "scene/builtin.h"
#include "techniques/photon_splatting/photon_test_frames.h"

namespace lightwell {
namespace {

using Cell = std::array<std::uint32_t, 3>;
using Bundle = std::vector<std::size_t>;  // light points

Cell cell_of(const glsl::LightPoint& point, const VoxelGrid& grid) {
  Cell cell{};
  for (int axis = 0; axis < 3; ++axis) {
    const float place = (point.position[axis] - grid.origin[axis]) / grid.cell_size;
    const auto last = static_cast<float>(grid.resolution[axis] - 1);
    cell[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(std::clamp(std::floor(place), 0.0f, last));
  }
  return cell;
}

// The number of a cell along Morton's curve.
std::uint32_t curve_place(const Cell& cell) {
  std::uint32_t place = 0;
  for (std::uint32_t bit = 0; bit < 8; ++bit)
    for (std::uint32_t axis = 0; axis < 3; ++axis) place |= (cell[axis] >> bit & 1u) << (3 * bit + axis);
  return place;
}

struct Block {
  std::vector<Bundle> bundles;
  std::size_t photons = 0;
};

// In the order of their first cells. Level by level, blocks of 2 x 2 x 2 parts become one bundle where a part holds
// fewer photons than the threshold.
std::vector<Bundle> bundle_slowly(const LightPoints& points, const VoxelGrid& grid, const PhotonOptions& options) {
  std::map<Cell, Block> blocks;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].flux == glm::vec3(0.0f)) continue;
    Block& block = blocks[cell_of(points[i], grid)];
    if (block.bundles.empty()) block.bundles.emplace_back();
    block.bundles[0].push_back(i);
    ++block.photons;
  }
  for (int level = 0; level < options.merge_levels; ++level) {
    std::map<Cell, std::vector<Block>> parts;
    for (auto& [cell, block] : blocks) parts[{cell[0] / 2, cell[1] / 2, cell[2] / 2}].push_back(std::move(block));
    blocks.clear();
    for (auto& [cell, siblings] : parts) {
      Block& block = blocks[cell];
      bool merges = false;
      for (Block& part : siblings) {
        merges |= part.photons < static_cast<std::size_t>(options.threshold);
        block.photons += part.photons;
        for (Bundle& bundle : part.bundles) block.bundles.push_back(std::move(bundle));
      }
      if (!merges) continue;
      Bundle all;
      for (const Bundle& bundle : block.bundles) all.insert(all.end(), bundle.begin(), bundle.end());
      block.bundles = {all};
    }
  }
  std::vector<Bundle> bundles;
  for (auto& [cell, block] : blocks)
    for (Bundle& bundle : block.bundles) bundles.push_back(std::move(bundle));
  const auto first_place = [&](const Bundle& bundle) {
    std::uint32_t first = UINT32_MAX;
    for (const std::size_t i : bundle) first = std::min(first, curve_place(cell_of(points[i], grid)));
    return first;
  };
  std::sort(bundles.begin(), bundles.end(),
            [&](const Bundle& x, const Bundle& y) { return first_place(x) < first_place(y); });
  return bundles;
}

bool lies_on_ray(const glsl::Splat& splat, const glsl::LightPoint& from) {
  const glm::vec3 offset = splat.center - from.position;
  const float along = glm::dot(offset, splat.direction);
  return along > 0.0f && glm::length(offset - along * splat.direction) < 1e-4f;
}

class StratifyTest : public DeviceTest {
 protected:
  static PhotonFrames frames_of(const PhotonOptions& options) {
    return {device(),
            make_box({1, 1.5f, 2}, make_material({0.5f, 0.25f, 0.75f})),
            {make_point_light({0.1f, 0.2f, 0.3f}, {1, 2, 3}), make_point_light({0.5f, -1.2f, 1.3f}, {3, 1, 1})},
            options};
  }
};

TEST_F(StratifyTest, BundlesAreThoseOfASlowOracle) {
  struct Case {
    int stratify, threshold, levels, photons;
  };
  for (const Case& c : {Case{1, 2, 1, 4096}, Case{1, 40, 4, 4096}, Case{2, 4, 2, 4096}, Case{3, 3, 0, 4096},
                        Case{4, 2, 1, 4096}, Case{5, 2, 8, 4096}, Case{5, 5, 3, 2000}, Case{1, 1000, 8, 300}}) {
    SCOPED_TRACE("grid " + std::to_string(8 << c.stratify) + ", threshold " + std::to_string(c.threshold) +
                 ", levels " + std::to_string(c.levels));
    const PhotonOptions options{.photons = c.photons,
                                .bounces = 2,
                                .stratify = c.stratify,
                                .threshold = c.threshold,
                                .merge_levels = c.levels,
                                .receiver_test = false};
    PhotonFrames frames = frames_of(options);
    const PhotonFrame frame = frames.next();
    const VoxelGrid grid = fit_voxel_grid(frames.world.bounds, 8u << c.stratify);
    const std::vector<Bundle> bundles = bundle_slowly(frame.points, grid, options);
    ASSERT_EQ(frame.splats.size(), bundles.size());
    for (std::size_t i = 0; i < bundles.size(); ++i) {
      const double photons = static_cast<double>(bundles[i].size());  // counts up to 511 are stored exactly
      ASSERT_NEAR(static_cast<double>(frame.splats[i].photons), photons, photons > 511.0 ? photons / 500.0 : 0.0) << i;
      glm::dvec3 flux(0.0);
      for (const std::size_t p : bundles[i]) flux += glm::dvec3(frame.points[p].flux);
      for (int channel = 0; channel < 3; ++channel)
        ASSERT_NEAR(double{frame.splats[i].flux[channel]}, flux[channel], std::max({flux.r, flux.g, flux.b}) / 500.0)
            << i;
    }
    const glm::dvec3 all = sum_flux(frame.points, 0, frame.points.size());
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(sum_flux(frame.splats)[channel] / all[channel], 1.0, 3e-3);
  }
}

// A splat's ray comes from a light point of its bundle: any, each about as often; or the one nearest to their mean.
TEST_F(StratifyTest, ABundleTakesThePlaceOfOneOfItsPhotons) {
  for (const Representative representative : {Representative::kRandom, Representative::kNearestToMean}) {
    const PhotonOptions options{.photons = 2048,
                                .bounces = 1,
                                .stratify = 1,
                                .threshold = 2,
                                .representative = representative,
                                .receiver_test = false};
    PhotonFrames frames = frames_of(options);
    double ranks = 0.0;
    double ranked = 0.0;
    for (int i = 0; i < 4; ++i) {
      const PhotonFrame frame = frames.next();
      const VoxelGrid grid = fit_voxel_grid(frames.world.bounds, 8u << options.stratify);
      const std::vector<Bundle> bundles = bundle_slowly(frame.points, grid, options);
      ASSERT_EQ(frame.splats.size(), bundles.size());
      for (std::size_t b = 0; b < bundles.size(); ++b) {
        const Bundle& bundle = bundles[b];
        glm::dvec3 mean(0.0);
        for (const std::size_t p : bundle)
          mean += glm::dvec3(frame.points[p].position) / static_cast<double>(bundle.size());
        const auto distance_of = [&](std::size_t p) {
          return glm::distance(glm::dvec3(frame.points[bundle[p]].position), mean);
        };
        std::vector<std::size_t> sources;
        for (std::size_t p = 0; p < bundle.size(); ++p)
          if (lies_on_ray(frame.splats[b], frame.points[bundle[p]])) sources.push_back(p);
        ASSERT_FALSE(sources.empty());
        if (representative == Representative::kNearestToMean) {
          double least = HUGE_VAL;
          double chosen = HUGE_VAL;
          for (std::size_t p = 0; p < bundle.size(); ++p) least = std::min(least, distance_of(p));
          for (const std::size_t p : sources) chosen = std::min(chosen, distance_of(p));
          EXPECT_NEAR(chosen, least, 1e-5);
        }
        if (sources.size() == 1 && bundle.size() > 3) {
          ranks += (static_cast<double>(sources[0]) + 0.5) / static_cast<double>(bundle.size());
          ranked += 1.0;
        }
      }
    }
    ASSERT_GT(ranked, 100.0);
    // The mean of numbers that are even in [0, 1] has the deviation 1 / sqrt(12 n).
    if (representative == Representative::kRandom) {
      EXPECT_NEAR(ranks / ranked, 0.5, 4.0 / std::sqrt(12.0 * ranked));
    }
  }
}

// A bundle of m photons takes m times the area of one.
TEST_F(StratifyTest, WidthsGrowWithTheNumberOfPhotons) {
  PhotonFrames frames = frames_of({.photons = 4096,
                                   .bounces = 1,
                                   .stratify = 2,
                                   .width_mode = SplatWidth::kFixed,
                                   .width = 0.01f,
                                   .most_width = 1.0f,
                                   .receiver_test = false});
  const float diagonal = glm::length(frames.world.bounds.maximum - frames.world.bounds.minimum);
  const PhotonFrame frame = frames.next();
  float most = 0.0f;
  for (const glsl::Splat& splat : frame.splats) {
    ASSERT_NEAR(splat.half_width / (0.005f * diagonal * std::sqrt(splat.photons)), 1.0f, 2e-3f);
    most = std::max(most, splat.photons);
  }
  EXPECT_GT(most, 4.0f);
}

// Also where the light points come in several rounds.
TEST_F(StratifyTest, RoundsAreSortedTogether) {
  const PhotonOptions options{.photons = 80000, .bounces = 1, .stratify = 2, .receiver_test = false};
  PhotonFrames frames = frames_of(options);
  const PhotonFrame frame = frames.next();
  ASSERT_EQ(frame.points.size(), 80000u);
  const VoxelGrid grid = fit_voxel_grid(frames.world.bounds, 8u << options.stratify);
  EXPECT_EQ(frame.splats.size(), bundle_slowly(frame.points, grid, options).size());
  std::size_t traced = 0;
  for (const glsl::Splat& splat : frame.splats) {
    traced += std::any_of(frame.points.begin(), frame.points.end(),
                          [&](const glsl::LightPoint& point) { return lies_on_ray(splat, point); })
                  ? 1
                  : 0;
  }
  EXPECT_EQ(traced, frame.splats.size());
}

}  // namespace
}  // namespace lightwell
