// Properties of the published propagation: energy, bounds, symmetry.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "techniques/light_volume/paper_test_sh.h"
#include "techniques/light_volume/paper_test_volume.h"

namespace lightwell {
namespace {

ShaderSh sh;

using PaperPropagationTest = PaperVolumeTest;

// Integral of the light over directions, summed over cells.
double flux(const TestVolume& volume, std::uint32_t channel) {
  double sum = 0.0;
  volume.for_each_cell(
      [&](glm::ivec3, std::size_t i) { sum += double{sh.sh_integral(volume.coefficients(volume.light, i, channel))}; });
  return sum;
}

double largest(const std::vector<float>& values) {
  double result = 0.0;
  for (const float value : values) {
    if (!std::isfinite(value)) return INFINITY;
    result = std::max(result, std::abs(double{value}));
  }
  return result;
}

// Irradiance on an occupied cell from what it has received.
double irradiance(const TestVolume& volume, const std::vector<float>& received, std::size_t cell) {
  const glm::vec3 normal(volume.cells[cell]);
  return double{glm::dot(volume.coefficients(received, cell), sh.sh_cosine_lobe(-normal))};
}

TEST_F(PaperPropagationTest, VoidConservesFlux) {
  TestVolume volume(16);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  volume.for_each_cell([&](glm::ivec3 c, std::size_t i) {
    if (glm::any(glm::lessThan(c, glm::ivec3(6))) || glm::any(glm::greaterThan(c, glm::ivec3(9)))) return;
    for (std::uint32_t plane = 0; plane < glsl::kPaperLightPlanes; ++plane) {
      const float constant = plane % 4 == 0 ? 2.0f : 0.0f;
      volume.light[std::size_t{plane} * glsl::paper_plane_stride(volume.grid.cell_count) + i] =
          constant + uniform(random);
    }
  });
  for (int step = 0; step < 6; ++step) {  // the light has not reached the grid's edge yet
    const double before[3] = {flux(volume, 0), flux(volume, 1), flux(volume, 2)};
    const std::vector<float> received = propagate(volume, {.steps = 1});
    for (std::uint32_t channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(flux(volume, channel) / before[channel], 1.0, 1e-5) << "step " << step << " channel " << channel;
    }
    EXPECT_EQ(largest(received), 0.0);  // no cell is occupied
  }
}

// What a step loses is what goes through the outer faces.
TEST_F(PaperPropagationTest, LightLeavesThroughTheEdgeOfTheGrid) {
  TestVolume volume(8);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  double leaving = 0.0;
  volume.for_each_cell([&](glm::ivec3 c, std::size_t i) {
    volume.set_light(i, glm::vec4(4.0f * uniform(random), uniform(random), uniform(random), uniform(random)));
    for (int axis = 0; axis < 3; ++axis) {
      glm::vec3 out(0.0f);
      out[axis] = c[axis] == 0 ? -1.0f : c[axis] == 7 ? 1.0f : 0.0f;
      if (out[axis] != 0.0f) leaving += double{glm::dot(volume.coefficients(volume.light, i), sh.sh_cube_face(out))};
    }
  });
  const double before = flux(volume, 0);
  propagate(volume, {.steps = 1});
  EXPECT_NEAR(flux(volume, 0), before - leaving, 1e-5 * before);
}

TEST_F(PaperPropagationTest, ClosedBoxStaysBoundedFor1000Steps) {
  TestVolume volume(12);
  volume.close();
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  volume.for_each_cell([&](glm::ivec3, std::size_t cell) {
    volume.set_light(cell, {uniform(random), uniform(random), uniform(random), uniform(random)});
  });
  double before = largest(volume.light);
  for (int hundred = 0; hundred < 10; ++hundred) {
    const double total = largest(propagate(volume, {.steps = 100}));
    EXPECT_LT(total, 100.0);
    EXPECT_LT(largest(volume.light), before);  // every surface takes half: the light dies away
    before = largest(volume.light);
  }
  EXPECT_LT(before, 1e-6);
}

// Walls of albedo 1/2 that emit radiance 1. In truth 2 pi arrives everywhere.
TEST_F(PaperPropagationTest, FurnaceSettles) {
  TestVolume volume(12);
  volume.close();
  const std::size_t wall = volume.index({0, 6, 6});
  volume.for_each_cell([&](glm::ivec3, std::size_t i) {
    if (volume.cells[i].w != 0.0f) volume.set_light(i, sh.sh_hemisphere(glm::vec3(volume.cells[i])));
  });
  TestVolume longer = volume;
  const double after_500 = irradiance(volume, propagate(volume, {.steps = 500}), wall);
  const double after_1000 = irradiance(longer, propagate(longer, {.steps = 1000}), wall);
  EXPECT_NEAR(after_1000 / after_500, 1.0, 1e-5);
  EXPECT_GT(after_1000, 0.0);
  EXPECT_LT(after_1000, 2.0 * std::numbers::pi * 1.05);
  RecordProperty("irradiance_over_truth", std::to_string(after_1000 / (2.0 * std::numbers::pi)));
}

// Light that nothing sends back is not received: direct light stays out of the result.
TEST_F(PaperPropagationTest, ALoneCellReceivesNothingOfItsOwn) {
  TestVolume volume(9);
  const std::size_t lamp = volume.index({4, 4, 4});
  volume.cells[lamp] = glm::vec4(0.0f, 1.0f, 0.0f, 1.0f);
  volume.set_light(lamp, sh.sh_hemisphere(glm::vec3(0.0f, 1.0f, 0.0f)));
  EXPECT_EQ(largest(propagate(volume, {.steps = 1})), 0.0);
}

// A wall cell takes what its neighbour sends through their common face and returns half of the irradiance.
TEST_F(PaperPropagationTest, OccupiedCellAccumulatesAndReflects) {
  TestVolume volume(8);
  const std::size_t wall = volume.index({4, 3, 3});
  const glm::vec3 normal = glm::normalize(glm::vec3(-1.0f, 0.5f, 0.0f));
  volume.cells[wall] = glm::vec4(normal, 1.0f);
  const glm::vec3 towards_wall(1.0f, 0.0f, 0.0f);
  volume.set_light(volume.index({3, 3, 3}), sh.sh_hemisphere(towards_wall));
  const std::vector<float> received = propagate(volume, {.steps = 1, .reflectance = 0.5f});

  const glm::vec4 face = sh.sh_cube_face(towards_wall);
  const glm::vec4 arrived = face * (glm::dot(sh.sh_hemisphere(towards_wall), face) / sh.kShFaceSolidAngle);
  const float radiosity = 0.5f * glm::dot(arrived, sh.sh_cosine_lobe(-normal));
  for (std::uint32_t channel = 0; channel < 3; ++channel) {
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR(volume.coefficients(received, wall, channel)[k], arrived[k], 1e-5f);
      EXPECT_NEAR(volume.coefficients(volume.light, wall, channel)[k], radiosity / sh.kPi * sh.sh_hemisphere(normal)[k],
                  1e-5f);
    }
  }
}

// A box that is its own mirror image in the plane x = z, and light that is too.
TEST_F(PaperPropagationTest, SymmetricSceneGivesSymmetricResult) {
  TestVolume volume(12);
  volume.close();
  for (const glm::ivec3 c : {glm::ivec3(3, 0, 3), glm::ivec3(4, 0, 7), glm::ivec3(7, 0, 4), glm::ivec3(6, 5, 6)}) {
    volume.set_light(volume.index(c), sh.sh_hemisphere({0.0f, 1.0f, 0.0f}));
  }
  const std::vector<float> received = propagate(volume, {.steps = 64});
  const double scale = largest(received);
  ASSERT_GT(scale, 0.0);
  volume.for_each_cell([&](glm::ivec3 c, std::size_t i) {
    const glm::vec4 here = volume.coefficients(received, i);
    const glm::vec4 mirrored = volume.coefficients(received, volume.index({c.z, c.y, c.x}));
    EXPECT_NEAR(here.x, mirrored.x, 1e-5 * scale);
    EXPECT_NEAR(here.y, mirrored.w, 1e-5 * scale);
    EXPECT_NEAR(here.z, mirrored.z, 1e-5 * scale);
  });
}

// Light propagation volumes: walls are no obstacle and reflect nothing, and every cell accumulates what passes.
TEST_F(PaperPropagationTest, WithoutOcclusionWallsChangeNothing) {
  TestVolume empty(12);
  empty.set_light(empty.index({3, 6, 6}), sh.sh_hemisphere({1.0f, 0.0f, 0.0f}));
  TestVolume walled = empty;
  walled.for_each_cell([&](glm::ivec3 c, std::size_t i) {
    if (c.x == 5) walled.cells[i] = glm::vec4(-1.0f, 0.0f, 0.0f, 1.0f);
  });
  const std::vector<float> without = propagate(empty, {.steps = 6, .occlusion = false});
  const std::vector<float> with = propagate(walled, {.steps = 6, .occlusion = false});
  EXPECT_EQ(without, with);
  EXPECT_GT(with[walled.index({7, 6, 6})], 0.0f);
}

}  // namespace
}  // namespace lightwell
