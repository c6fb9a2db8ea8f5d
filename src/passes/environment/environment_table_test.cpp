// Directions drawn from an environment's table, on the GPU, against the light of the map, by Pearson's chi-square test.
#include "passes/environment/environment_table.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <random>
#include <vector>

#include "graph/linear_dispatch.h"
#include "graph/testing/graph_test.h"
#include "kernels/passes/environment/testing/sample_environment.comp.h"
#include "passes/environment/gpu_environment.h"
#include "passes/environment/testing/sample_environment.h"

namespace lightwell {
namespace {

constexpr unsigned kSeed = 20261122;
constexpr std::uint32_t kCount = 200000;
constexpr int kWidth = 24;
constexpr int kHeight = 12;

// Every texel of another brightness, one row black, and a sun.
Environment uneven_environment() {
  Environment environment;
  environment.radiance = glm::vec3(2.0f);
  environment.map = Image(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool sun = x == 5 && y == 3;
      const float value = y == 8 ? 0.0f : sun ? 40.0f : 0.1f + static_cast<float>((7 * x + 5 * y) % 11);
      for (int c = 0; c < 3; ++c) environment.map.at(x, y)[c] = value;
    }
  }
  return environment;
}

// Light of the bilinear map, integrated over the square [x, x + 1] x [y, y + 1] of texels.
double integrate_texel(const Image& map, int x, int y) {
  constexpr int kSteps = 32;
  const auto texel = [&](int i, int j) {
    return static_cast<double>(map.at((i + map.width) % map.width, std::clamp(j, 0, map.height - 1))[0]);
  };
  double sum = 0.0;
  for (int j = 0; j < kSteps; ++j) {
    const double v = y + (j + 0.5) / kSteps - 0.5;
    const int y0 = static_cast<int>(std::floor(v));
    for (int i = 0; i < kSteps; ++i) {
      const double u = x + (i + 0.5) / kSteps - 0.5;
      const int x0 = static_cast<int>(std::floor(u));
      const double upper = std::lerp(texel(x0, y0), texel(x0 + 1, y0), u - x0);
      const double lower = std::lerp(texel(x0, y0 + 1), texel(x0 + 1, y0 + 1), u - x0);
      sum += std::lerp(upper, lower, v - y0);
    }
  }
  return sum / (kSteps * kSteps) * std::sin(std::numbers::pi * (y + 0.5) / map.height);
}

class EnvironmentTableTest : public GraphTest {
 protected:
  std::vector<glsl::TableTestSample> draw(const Environment& environment, const std::vector<glm::vec2>& numbers) {
    GpuEnvironment gpu_environment(device(), environment);
    FrameGraph graph(executor().context());
    const BufferHandle table = gpu_environment.record_table(graph);
    const auto count = static_cast<std::uint32_t>(numbers.size());
    BufferHandle samples = graph.create_buffer("samples", count, sizeof(glsl::TableTestSample));
    dispatch_linear(graph.compute("sample environment", kernels::environment_testing_sample_environment_comp)
                        .read("numbers", graph.upload<glm::vec2>("numbers", numbers))
                        .read("environment_table", table)
                        .write("samples", samples)
                        .push(glsl::TableTestParams{gpu_environment.table_size(), count}),
                    count);
    const ReadbackTicket ticket = graph.read_back(samples);
    run(graph);
    return fetch<glsl::TableTestSample>(ticket);
  }
};

std::vector<glm::vec2> random_numbers() {
  std::mt19937 engine(kSeed);
  std::vector<glm::vec2> numbers(kCount);
  for (glm::vec2& number : numbers) {
    const auto x = static_cast<float>(engine() >> 8);
    number = glm::vec2(x, static_cast<float>(engine() >> 8)) * 0x1p-24f;
  }
  return numbers;
}

TEST_F(EnvironmentTableTest, DirectionsComeAsTheLightDoes) {
  const Environment environment = uneven_environment();
  std::vector<double> observed(kWidth * kHeight), expected(kWidth * kHeight);
  for (const glsl::TableTestSample& sample : draw(environment, random_numbers())) {
    const glm::vec3& d = sample.direction;
    const double u = std::atan2(d.x, -d.z) / (2.0 * std::numbers::pi) + 0.5;
    const double v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) / std::numbers::pi;
    observed[static_cast<std::size_t>(std::min(static_cast<int>(v * kHeight), kHeight - 1) * kWidth +
                                      std::min(static_cast<int>(u * kWidth), kWidth - 1))] += 1.0;
  }
  double total = 0.0;
  for (int i = 0; i < kWidth * kHeight; ++i)
    total += expected[static_cast<std::size_t>(i)] = integrate_texel(environment.map, i % kWidth, i / kWidth);
  double chi_square = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double count = expected[i] / total * kCount;
    ASSERT_GT(count, 5.0);
    chi_square += (observed[i] - count) * (observed[i] - count) / count;
  }
  // Passes with a probability of 1 - 1e-4 (Wilson and Hilferty 1931).
  const double degrees = kWidth * kHeight - 1;
  const double normal =
      (std::cbrt(chi_square / degrees) - (1.0 - 2.0 / (9.0 * degrees))) / std::sqrt(2.0 / (9.0 * degrees));
  std::cout << "seed " << kSeed << ": chi-square " << chi_square << " with " << degrees
            << " degrees of freedom, z = " << normal << "\n";
  EXPECT_LT(normal, 3.719);
}

// 1 / density, averaged over directions drawn with that density, is the sphere's solid angle.
TEST_F(EnvironmentTableTest, DensitiesIntegrateToOne) {
  double sum = 0.0;
  int different = 0;
  for (const glsl::TableTestSample& sample : draw(uneven_environment(), random_numbers())) {
    sum += 1.0 / sample.density;
    if (std::abs(sample.density_again / sample.density - 1.0f) > 0.001f) ++different;
  }
  EXPECT_NEAR(sum / kCount / (4.0 * std::numbers::pi), 1.0, 0.02);
  // On borders of texels the two may round apart. Sine and cosine may be wrong by 2^-11 (Vulkan 1.3, Precision and
  // Operation of SPIR-V Instructions), which moves as many directions over a border as 24 * 2^-11 / (2 pi) + 12 * 2^-11
  // / pi = 1 / 270 of them; measured: Mesa under 1 / 10000, SwiftShader 1 / 6450.
  EXPECT_LT(different, static_cast<int>(kCount / 2000));
}

TEST_F(EnvironmentTableTest, WithoutAMapOrLightThereIsNoTable) {
  Environment environment = uneven_environment();
  EXPECT_EQ(make_environment_table(environment).width, static_cast<std::uint32_t>(kWidth));
  environment.radiance = glm::vec3(0.0f);
  EXPECT_EQ(make_environment_table(environment).width, 0u);
  EXPECT_TRUE(GpuEnvironment(device(), environment).is_black());
  environment.radiance = glm::vec3(1.0f);
  environment.map = {};
  EXPECT_EQ(make_environment_table(environment).width, 0u);
  EXPECT_FALSE(GpuEnvironment(device(), environment).is_black());
}

// Larger maps share cells, and still every cell is as likely as its light.
TEST_F(EnvironmentTableTest, LargeMapsGetASmallerTable) {
  Environment environment;
  environment.radiance = glm::vec3(1.0f);
  environment.map = Image(kMaxTableWidth + 100, 8);
  for (float& value : environment.map.pixels) value = 1.0f;
  const EnvironmentTable table = make_environment_table(environment);
  EXPECT_LE(table.width, static_cast<std::uint32_t>(kMaxTableWidth));
  EXPECT_EQ(table.height, 4u);
  ASSERT_EQ(table.cumulative.size(), table.height + std::size_t{table.height} * table.width);
  EXPECT_NEAR(table.cumulative[table.height + table.width / 2 - 1], 0.5f, 1e-4f);
}

}  // namespace
}  // namespace lightwell
