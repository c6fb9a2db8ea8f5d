#include "lightwell/metrics.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <ostream>

#include "core/color_space.h"
#include "core/flip.h"
#include "core/plane.h"
#include "core/test_folder.h"
#include "lightwell/error.h"

namespace lightwell {
namespace {

namespace fs = std::filesystem;

Image constant_image(int width, int height, float r, float g, float b) {
  Image image(width, height, 3);
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    image.pixels[i] = r;
    image.pixels[i + 1] = g;
    image.pixels[i + 2] = b;
  }
  return image;
}

// Smooth shading with noise, the kind of image a renderer makes.
Image rendered_image(int width, int height, unsigned seed, float noise) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        const auto phase = static_cast<float>(x * (c + 1)) * 0.07f + static_cast<float>(y) * 0.11f;
        const float value = 0.6f + 0.5f * std::sin(phase) + (x > width / 2 && y > height / 3 ? 0.8f : 0.0f);
        image.at(x, y)[c] = value * (1.0f + noise * uniform(random));
      }
  return image;
}

Image checkered_mask(int width, int height) {
  Image mask(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) mask.at(x, y)[0] = (x / 5 + y / 3) % 3 == 0 ? 0.0f : 1.0f;
  return mask;
}

// ---- a reference with noise of known variance ----

struct NoisyReference {
  Image truth = constant_image(64, 48, 0.5f, 0.5f, 0.5f);
  Image reference = truth;
  Image variance = truth;
};

NoisyReference noisy_reference(unsigned seed) {
  std::mt19937 random(seed);
  NoisyReference result;
  for (std::size_t i = 0; i < result.truth.pixels.size(); ++i) {
    const float sigma = i % 7 == 0 ? 0.2f : 0.05f;
    std::normal_distribution<float> normal(0.0f, sigma);
    result.reference.pixels[i] += normal(random);
    result.variance.pixels[i] = sigma * sigma;
  }
  return result;
}

TEST(NoiseMetrics, NoiseOfTheReferenceExplainsAPerfectPicture) {
  int significant = 0;
  constexpr int kSeeds = 40;
  double part = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const NoisyReference noisy = noisy_reference(seed);
    for (const int block : {1, 4}) {
      MetricOptions options;
      options.variance = &noisy.variance;
      options.block = block;
      const NoiseMetrics noise = compute_metrics(noisy.truth, noisy.reference, options).noise;
      EXPECT_LT(std::abs(noise.energy_sigmas), 5.0);
      significant += noise.significant ? 1 : 0;
      part += noise.part / (2 * kSeeds);
    }
  }
  EXPECT_LE(significant, 4);
  EXPECT_NEAR(part, 1.0, 0.05) << significant;
}

TEST(NoiseMetrics, WhatIsWrongIsSignificant) {
  const NoisyReference noisy = noisy_reference(1);
  MetricOptions options;
  options.variance = &noisy.variance;
  Image brighter = noisy.truth;
  for (float& value : brighter.pixels) value *= 1.02f;
  const NoiseMetrics energy = compute_metrics(brighter, noisy.reference, options).noise;
  EXPECT_TRUE(energy.significant);
  EXPECT_GT(energy.energy_sigmas, 3.0);
  Image patterned = noisy.truth;  // of the same energy
  for (std::size_t i = 0; i < patterned.pixels.size(); ++i) patterned.pixels[i] += i / 3 % 2 == 0 ? 0.05f : -0.05f;
  const Metrics metrics = compute_metrics(patterned, noisy.reference, options);
  EXPECT_TRUE(metrics.noise.significant);
  EXPECT_GT(metrics.noise.rest_sigmas, 3.0);
  EXPECT_NEAR(metrics.noise.part, metrics.noise.rel_mse / (metrics.noise.rel_mse + metrics.noise.rest), 1e-12);
  EXPECT_LT(metrics.noise.part, 0.9);
}

TEST(NoiseMetrics, WithoutNoiseAnyDifferenceIsSignificant) {
  const Image truth = constant_image(8, 8, 1, 1, 1), none = constant_image(8, 8, 0, 0, 0);
  MetricOptions options;
  options.variance = &none;
  EXPECT_FALSE(compute_metrics(truth, truth, options).noise.significant);
  EXPECT_TRUE(compute_metrics(constant_image(8, 8, 1, 1, 1.001f), truth, options).noise.significant);
}

TEST(NoiseMetrics, RefusesWhatIsNoVariance) {
  const Image truth = constant_image(8, 8, 1, 1, 1), negative = constant_image(8, 8, 1, -1, 1);
  const Image small = constant_image(4, 8, 1, 1, 1);
  MetricOptions options;
  for (const Image* variance : {&negative, &small}) {
    options.variance = variance;
    EXPECT_THROW(compute_metrics(truth, truth, options), InputError);
  }
}

// ---- values computed by hand ----

TEST(Metrics, EqualImages) {
  const Image image = rendered_image(20, 15, 1, 0.3f);
  const Metrics metrics = compute_metrics(image, image);
  EXPECT_EQ(metrics.pixels, 300);
  EXPECT_EQ(metrics.rel_mse, 0);
  EXPECT_EQ(metrics.rmse8, 0);
  EXPECT_EQ(metrics.max_abs, 0);
  EXPECT_EQ(metrics.flip, 0);
  EXPECT_DOUBLE_EQ(metrics.ssim, 1);
  EXPECT_EQ(metrics.energy, 1);
}

TEST(Metrics, ConstantImages) {
  const Image test = constant_image(16, 16, 1.5f, 1.0f, 0.25f);
  const Image reference = constant_image(16, 16, 1.0f, 1.0f, 0.5f);
  MetricOptions options;
  options.epsilon = 0.25;
  const Metrics metrics = compute_metrics(test, reference, options);
  // 0.25 / 1.25 and 0.0625 / 0.5, and a third channel without error
  EXPECT_NEAR(metrics.rel_mse, (0.2 + 0.125) / 3, 1e-12);
  EXPECT_NEAR(metrics.energy, 2.75 / 2.5, 1e-12);
  EXPECT_NEAR(metrics.energy_rgb[0], 1.5, 1e-12);
  EXPECT_NEAR(metrics.energy_rgb[2], 0.5, 1e-12);
  EXPECT_EQ(metrics.max_abs, 0.5);
  // 8-bit codes: sRGB(0.25) = 0.537099 -> 137, sRGB(0.5) = 0.735357 -> 188; both reds clip to 255
  EXPECT_EQ(metrics.rmse8, 188 - 137);
  // Reinhard: 0.6, 0.5, 0.2 against 0.5, 0.5, 1/3 -> 203, 188, 124 against 188, 188, 156
  EXPECT_EQ(metrics.rmse8_tone_mapped, 15 + 32);
}

TEST(Metrics, PercentileIsInterpolated) {
  Image test(4, 1, 3), reference(4, 1, 3);
  for (std::size_t i = 0; i < 12; ++i) test.pixels[i] = static_cast<float>(i);
  // 12 differences 0..11: the 99th percentile lies at position 10.89
  EXPECT_NEAR(compute_metrics(test, reference).p99_abs, 10.89, 1e-9);
}

TEST(Metrics, SsimOfConstantImagesIsItsLuminanceTerm) {
  const double a = srgb_encode(0.5f), b = srgb_encode(0.75f);  // Reinhard of 1 and 3
  const Metrics metrics = compute_metrics(constant_image(30, 20, 1, 1, 1), constant_image(30, 20, 3, 3, 3));
  EXPECT_NEAR(metrics.ssim, (2 * a * b + 1e-4) / (a * a + b * b + 1e-4), 1e-6);
}

TEST(Metrics, BadPixelsCountAsBlack) {
  Image test = constant_image(3, 1, 1, 1, 1);
  test.at(1, 0)[1] = std::numeric_limits<float>::quiet_NaN();
  test.at(2, 0)[0] = std::numeric_limits<float>::infinity();
  const Metrics metrics = compute_metrics(test, constant_image(3, 1, 1, 1, 1));
  EXPECT_EQ(metrics.bad_pixels, 2);
  EXPECT_NEAR(metrics.energy, 7.0 / 9.0, 1e-12);
}

TEST(Metrics, RefusesWhatCannotBeCompared) {
  const Image image = constant_image(8, 8, 1, 1, 1);
  Image hole = image;
  hole.at(0, 0)[0] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(compute_metrics(image, constant_image(8, 9, 1, 1, 1)), InputError);
  EXPECT_THROW(compute_metrics(image, hole), InputError);
  MetricOptions options;
  options.block = 9;
  EXPECT_THROW(compute_metrics(image, image, options), InputError);
  options.block = 1;
  const Image nothing(8, 8, 1);
  options.mask = &nothing;
  EXPECT_THROW(compute_metrics(image, image, options), InputError);
  const Image too_small(7, 8, 1);
  options.mask = &too_small;
  EXPECT_THROW(compute_metrics(image, image, options), InputError);
}

// ---- FLIP ----

Planes display_planes(int width, int height, unsigned seed) {
  const Image display = tone_map(rendered_image(width, height, seed, 0.4f), 1.0f);
  Planes planes;
  for (std::size_t c = 0; c < 3; ++c) {
    planes[c] = Plane(width, height);
    for (std::size_t i = 0; i < planes[c].values.size(); ++i) planes[c].values[i] = display.pixels[i * 3 + c];
  }
  return planes;
}

Planes uniform_planes(double r, double g, double b) {
  Planes planes;
  const double values[3] = {r, g, b};
  for (std::size_t c = 0; c < 3; ++c) {
    planes[c] = Plane(8, 8);
    planes[c].values.assign(64, values[c]);
  }
  return planes;
}

// Without features, FLIP is the colour difference. Green against blue is the largest, and grays differ in L* only.
TEST(Flip, UniformImages) {
  EXPECT_NEAR(flip_map(uniform_planes(0, 1, 0), uniform_planes(0, 0, 1)).at(4, 4), 1.0, 1e-9);
  const double green_l = lab_from_rgb({0, 1, 0}).x;
  EXPECT_NEAR(green_l, 87.7347, 1e-3);
  // cmax = 41.2760, knee = 16.5104; black to white: 100^0.7 = 25.1189
  EXPECT_NEAR(flip_map(uniform_planes(0, 0, 0), uniform_planes(1, 1, 1)).at(0, 0),
              0.95 + 0.05 * (25.1189 - 16.5104) / (41.2760 - 16.5104), 1e-4);
}

bool python_has(const std::string& modules) {
  return std::system(("/usr/bin/python3 -c 'import " + modules + "' >/dev/null 2>&1").c_str()) == 0;
}

std::string run(const std::string& command) {
  std::string output;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output.push_back(static_cast<char>(c));
  EXPECT_EQ(::pclose(pipe), 0) << command;
  return output;
}

TEST(Flip, EqualsAnIndependentImplementation) {
  if (!python_has("numpy")) GTEST_SKIP() << "needs python3-numpy";
  constexpr int kWidth = 61, kHeight = 43;
  const TestFolder folder;
  const Planes test = display_planes(kWidth, kHeight, 11), reference = display_planes(kWidth, kHeight, 12);
  const auto save = [&](const Planes& planes, const std::string& name) {
    std::ofstream file(folder.path(name), std::ios::binary);
    for (std::size_t i = 0; i < planes[0].values.size(); ++i)
      for (const Plane& plane : planes) file.write(reinterpret_cast<const char*>(&plane.values[i]), sizeof(double));
  };
  save(test, "test.raw");
  save(reference, "reference.raw");
  const std::string output =
      run("/usr/bin/python3 " LIGHTWELL_SOURCE_DIR "/src/core/flip_oracle.py " + folder.path("test.raw") + " " +
          folder.path("reference.raw") + " " + std::to_string(kWidth) + " " + std::to_string(kHeight));
  std::istringstream values(output);
  const Plane map = flip_map(test, reference);
  double value = 0, sum = 0;
  for (const double ours : map.values) {
    ASSERT_TRUE(values >> value);
    ASSERT_NEAR(ours, value, 1e-9);
    sum += value;
  }
  EXPECT_GT(sum / static_cast<double>(map.values.size()), 0.05);  // the images do differ
}

// ---- against the reference implementation of the definitions ----

struct Case {
  int width, height;
  float exposure;
  int block;
  bool mask;
  const char* name;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class CompareScript : public ::testing::TestWithParam<Case> {};

TEST_P(CompareScript, Agrees) {
  const std::string script = std::string(LIGHTWELL_SHARED_DIR) + "/references/compare.py";
  if (!fs::exists(script)) GTEST_SKIP() << "no " << script;
  if (!python_has("numpy, OpenImageIO")) GTEST_SKIP() << "needs python3-numpy and python3-openimageio";
  const Case& c = GetParam();
  const TestFolder folder;
  Image test = rendered_image(c.width, c.height, 3, 0.5f);
  const Image reference = rendered_image(c.width, c.height, 4, 0.1f);
  const Image mask = checkered_mask(c.width, c.height);
  test.at(1, 0)[2] = -0.4f;  // a negative value, a very bright one, and one that is none
  test.at(2, 0)[0] = 1e6f;
  test.at(0, 1)[1] = std::numeric_limits<float>::quiet_NaN();
  save_exr(folder.path("t.exr"), test);
  save_exr(folder.path("r.exr"), reference);
  save_exr(folder.path("m.exr"), mask);

  std::string command = "/usr/bin/python3 " + script + " " + folder.path("t.exr") + " " + folder.path("r.exr") +
                        " --json --exposure " + std::to_string(c.exposure) + " --block " + std::to_string(c.block);
  if (c.mask) command += " --mask " + folder.path("m.exr");
  const nlohmann::json expected = nlohmann::json::parse(run(command));

  MetricOptions options;
  options.exposure = c.exposure;
  options.block = c.block;
  if (c.mask) options.mask = &mask;
  const Metrics ours = compute_metrics(test, reference, options);
  const auto expect_equal = [&](double value, const nlohmann::json& wanted, const char* name) {
    const double number = wanted.get<double>();
    EXPECT_NEAR(value, number, 1e-9 * std::max(1.0, std::abs(number))) << name;
  };
  EXPECT_EQ(ours.pixels, expected["pixels"].get<long>());
  EXPECT_EQ(ours.bad_pixels, expected["bad_pixels"].get<long>());
  expect_equal(ours.rel_mse, expected["relMSE"], "relMSE");
  expect_equal(ours.rmse8, expected["rmse8"], "rmse8");
  expect_equal(ours.rmse8_tone_mapped, expected["rmse8_tm"], "rmse8_tm");
  expect_equal(ours.ssim, expected["ssim"], "ssim");
  expect_equal(ours.energy, expected["energy"], "energy");
  for (std::size_t i = 0; i < 3; ++i) expect_equal(ours.energy_rgb[i], expected["energy_rgb"][i], "energy_rgb");
  expect_equal(ours.max_abs, expected["max_abs"], "max_abs");
  expect_equal(ours.p99_abs, expected["p99_abs"], "p99_abs");
  expect_equal(ours.mean_test, expected["mean_test"], "mean_test");
  expect_equal(ours.mean_reference, expected["mean_ref"], "mean_ref");
}

INSTANTIATE_TEST_SUITE_P(Metrics, CompareScript,
                         ::testing::Values(Case{64, 48, 1.0f, 1, false, "plain"},
                                           Case{53, 41, 0.75f, 1, true, "masked"},
                                           Case{53, 41, 1.5f, 4, true, "masked_blocks"},
                                           Case{50, 47, 1.0f, 8, false, "blocks_smaller_than_the_ssim_window"},
                                           Case{30, 4, 1.0f, 1, false, "flat"}),
                         [](const auto& info) { return std::string(info.param.name); });

// ---- heat map ----

TEST(HeatMap, LightnessRisesEvenlyWithTheDifference) {
  const Image black(64, 1, 3);
  Image gray(64, 1, 3);
  for (int x = 0; x < 64; ++x) {
    // display value d of one channel, so that 4 d covers [0,1]
    const float display = static_cast<float>(x) / 63.0f / 4.0f;
    const float linear = srgb_decode(display);
    gray.at(x, 0)[1] = linear / (1.0f - linear);
  }
  const Image map = difference_heat_map(gray, black, 1.0f);
  double previous = -1;
  for (int x = 0; x < 64; ++x) {
    const float* p = map.at(x, 0);
    const double lightness = lab_from_rgb({srgb_decode(p[0]), srgb_decode(p[1]), srgb_decode(p[2])}).x;
    EXPECT_GT(lightness, previous) << x;
    EXPECT_NEAR(lightness, 97.0 * x / 63, 6.0) << x;
    previous = lightness;
  }
}

}  // namespace
}  // namespace lightwell
