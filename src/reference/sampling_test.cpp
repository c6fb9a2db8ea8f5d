// Samplers against the densities they claim, by Pearson's chi-square test. Each test's seed is printed; a correct
// sampler fails one with a probability of 1e-4.
#include "reference/sampling.h"

#include <cmath>
#include <functional>
#include <iostream>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "reference/environment.h"
#include "reference/random.h"

namespace lightwell {
namespace {

constexpr unsigned kSeed = 20261122;
constexpr int kSamples = 400000;

// One-sided normal quantile of 1 - 1e-4: chi-square is compared with it after the cube-root transformation to a
// normal variable (Wilson and Hilferty 1931).
constexpr double kQuantile = 3.719;

void expect_distribution(const std::vector<double>& observed, const std::vector<double>& expected) {
  double chi_square = 0.0, rest_observed = 0.0, rest_expected = 0.0;
  int bins = 0;
  const auto add = [&](double o, double e) {
    chi_square += (o - e) * (o - e) / e;
    ++bins;
  };
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] >= 5.0) {
      add(observed[i], expected[i]);
    } else {  // too rare for the approximation: together they are one bin
      rest_observed += observed[i];
      rest_expected += expected[i];
    }
  }
  if (rest_expected >= 5.0) {
    add(rest_observed, rest_expected);
  } else {
    EXPECT_LT(rest_observed, 25.0) << "samples where none are expected";
  }
  const double degrees = bins - 1;
  const double normal =
      (std::cbrt(chi_square / degrees) - (1.0 - 2.0 / (9.0 * degrees))) / std::sqrt(2.0 / (9.0 * degrees));
  std::cout << "seed " << kSeed << ": chi-square " << chi_square << " with " << degrees
            << " degrees of freedom, z = " << normal << "\n";
  EXPECT_LT(normal, kQuantile);
}

// Uniform numbers that owe nothing to the code under test.
class Uniform {
 public:
  float next() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
  glm::vec2 next_2d() {
    const float x = next();
    return {x, next()};
  }

 private:
  std::mt19937 engine_{kSeed};
};

std::size_t bin(double x, std::size_t bins) {
  return std::min(bins - 1, static_cast<std::size_t>(std::max(0.0, x) * static_cast<double>(bins)));
}

// 16 x 16 bins of equal probability in coordinates that are uniform on the unit square if the sampler is right.
void expect_uniform_square(const std::function<std::pair<double, double>(Uniform&)>& sample) {
  constexpr std::size_t kSide = 16;
  Uniform uniform;
  std::vector<double> observed(kSide * kSide);
  for (int i = 0; i < kSamples; ++i) {
    const auto [x, y] = sample(uniform);
    observed[bin(x, kSide) * kSide + bin(y, kSide)] += 1.0;
  }
  expect_distribution(observed, std::vector<double>(kSide * kSide, static_cast<double>(kSamples) / (kSide * kSide)));
}

double turn(double y, double x) {
  return std::atan2(y, x) / (2.0 * static_cast<double>(kPi)) + 0.5;
}

TEST(Sampling, DiskIsUniform) {
  expect_uniform_square([](Uniform& uniform) {
    const glm::vec2 p = sample_disk(uniform.next_2d());
    EXPECT_LE(glm::length(p), 1.0f + 1e-6f);
    return std::pair{static_cast<double>(glm::dot(p, p)), turn(static_cast<double>(p.y), static_cast<double>(p.x))};
  });
}

// P(cos < c) = c^2.
TEST(Sampling, HemisphereIsCosine) {
  const glm::mat3 frame = make_frame(glm::normalize(glm::vec3{0.3f, -0.5f, -0.8f}));
  expect_uniform_square([&](Uniform& uniform) {
    const glm::vec3 d = frame * sample_cosine_hemisphere(uniform.next_2d());
    EXPECT_NEAR(glm::length(d), 1.0f, 1e-5f);
    const auto cosine = static_cast<double>(glm::dot(d, frame[2]));
    return std::pair{cosine * cosine,
                     turn(static_cast<double>(glm::dot(d, frame[1])), static_cast<double>(glm::dot(d, frame[0])))};
  });
}

// Weights (u, v): P(u < x) = 1 - (1 - x)^2, and v is uniform on [0, 1 - u].
TEST(Sampling, TriangleIsUniform) {
  expect_uniform_square([](Uniform& uniform) {
    const glm::vec2 weights = sample_triangle(uniform.next_2d());
    EXPECT_LE(weights.x + weights.y, 1.0f + 1e-6f);
    const double rest = 1.0 - static_cast<double>(weights.x);
    return std::pair{1.0 - rest * rest, rest > 0.0 ? static_cast<double>(weights.y) / rest : 0.0};
  });
}

TEST(Sampling, FramesAreOrthonormalAndRightHanded) {
  Uniform uniform;
  for (int i = 0; i < 1000; ++i) {
    const glm::vec3 z = i == 0   ? glm::vec3{0, 0, -1}
                        : i == 1 ? glm::vec3{0, 0, 1}
                                 : glm::normalize(glm::vec3{uniform.next(), uniform.next(), uniform.next()} - 0.5f);
    const glm::mat3 frame = make_frame(z);
    EXPECT_LT(glm::length(glm::cross(frame[0], frame[1]) - frame[2]), 1e-5f);
    EXPECT_LT(std::abs(glm::dot(frame[0], frame[1])), 1e-5f);
    EXPECT_LT(glm::length(frame[2] - z), 1e-6f);
  }
}

TEST(Sampling, DiscreteChoiceFollowsItsWeights) {
  Uniform uniform;
  std::vector<float> weights{0.0f, 3.0f, 0.0f, 0.001f};
  for (int i = 0; i < 100; ++i) weights.push_back(uniform.next() * uniform.next());
  weights.push_back(0.0f);
  const DiscreteDistribution distribution(weights);
  std::vector<double> observed(weights.size()), expected, remainders(32);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    expected.push_back(kSamples * static_cast<double>(weights[i]) / distribution.total());
    EXPECT_NEAR(distribution.probability(i), static_cast<double>(weights[i]) / distribution.total(), 1e-6);
  }
  for (int i = 0; i < kSamples; ++i) {
    const DiscreteDistribution::Choice choice = distribution.sample(uniform.next());
    EXPECT_GT(weights[choice.index], 0.0f);
    observed[choice.index] += 1.0;
    remainders[bin(static_cast<double>(choice.remainder), remainders.size())] += 1.0;
  }
  expect_distribution(observed, expected);
  expect_distribution(remainders, std::vector<double>(remainders.size(), static_cast<double>(kSamples) / 32.0));
}

// Directions from a map with a small sun against the density it claims, integrated numerically over bins that do not
// coincide with texels; and the density's integral is 1.
TEST(Sampling, EnvironmentFollowsItsDensity) {
  Environment environment;
  environment.radiance = {1.0f, 0.5f, 2.0f};
  environment.map = Image(16, 8, 3);
  Uniform uniform;
  for (float& value : environment.map.pixels) value = uniform.next();
  environment.map.at(5, 2)[1] = 200.0f;
  const EnvironmentLight light(environment);

  constexpr std::size_t kBinsV = 20, kBinsU = 30, kFine = 24;
  std::vector<double> observed(kBinsU * kBinsV), expected(kBinsU * kBinsV);
  int other_texel = 0;
  for (int i = 0; i < kSamples; ++i) {
    const EnvironmentLight::Sample sample = light.sample(uniform.next_2d());
    if (std::abs(sample.density - light.density(sample.direction)) > 1e-3f * sample.density) ++other_texel;
    const double u = turn(static_cast<double>(sample.direction.x), -static_cast<double>(sample.direction.z));
    const double v = std::acos(static_cast<double>(sample.direction.y)) / static_cast<double>(kPi);
    observed[bin(v, kBinsV) * kBinsU + bin(u, kBinsU)] += 1.0;
  }
  EXPECT_LT(other_texel, kSamples / 10000) << "density() disagrees with sample(), beyond rounding at texel borders";
  double integral = 0.0;
  for (std::size_t y = 0; y < kBinsV * kFine; ++y) {
    for (std::size_t x = 0; x < kBinsU * kFine; ++x) {
      const double theta = static_cast<double>(kPi) * (static_cast<double>(y) + 0.5) / (kBinsV * kFine);
      const double phi = 2.0 * static_cast<double>(kPi) * ((static_cast<double>(x) + 0.5) / (kBinsU * kFine) - 0.5);
      const glm::vec3 d{std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
      const double solid_angle =
          2.0 * static_cast<double>(kPi * kPi) * std::sin(theta) / (kBinsU * kBinsV * kFine * kFine);
      const double probability = static_cast<double>(light.density(d)) * solid_angle;
      expected[y / kFine * kBinsU + x / kFine] += kSamples * probability;
      integral += probability;
    }
  }
  EXPECT_NEAR(integral, 1.0, 1e-3);
  expect_distribution(observed, expected);
}

// Over the samples of one pixel: 256 points have one in each of 16 x 16 cells and in each elementary interval.
TEST(Sampler, PairsAreStratified) {
  for (std::uint32_t pixel = 0; pixel < 50; ++pixel) {
    std::vector<int> square(256), rows(256), columns(256);
    for (std::uint32_t i = 0; i < 256; ++i) {
      Sampler sampler(1, pixel, i);
      for (std::uint32_t skipped = 0; skipped < pixel % 5; ++skipped) sampler.next_1d();
      const glm::vec2 p = sampler.next_2d();
      ++square[bin(static_cast<double>(p.x), 16) * 16 + bin(static_cast<double>(p.y), 16)];
      ++columns[bin(static_cast<double>(p.x), 256)];
      ++rows[bin(static_cast<double>(p.y), 256)];
    }
    EXPECT_EQ(square, std::vector<int>(256, 1));
    EXPECT_EQ(rows, std::vector<int>(256, 1));
    EXPECT_EQ(columns, std::vector<int>(256, 1));
  }
}

// Different dimensions, pixels and seeds are independent: one sample of each fills the square evenly.
TEST(Sampler, DimensionsAndPixelsAreIndependent) {
  constexpr std::size_t kSide = 16;
  for (int kind = 0; kind < 3; ++kind) {
    std::vector<double> observed(kSide * kSide);
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      // Two dimensions of one sample, the same dimension of two pixels, and of two seeds.
      Sampler a(7, i, i % 64);
      Sampler b(kind == 2 ? 8 : 7, kind == 1 ? i + 1 : i, i % 64);
      const float x = a.next_1d();
      if (kind == 0) b.next_1d();
      observed[bin(static_cast<double>(x), kSide) * kSide + bin(static_cast<double>(b.next_1d()), kSide)] += 1.0;
    }
    expect_distribution(observed, std::vector<double>(kSide * kSide, static_cast<double>(kSamples) / (kSide * kSide)));
  }
}

}  // namespace
}  // namespace lightwell
