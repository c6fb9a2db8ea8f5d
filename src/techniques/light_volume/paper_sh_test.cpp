// The shader's own spherical harmonics, compiled as C++, against numerical integration.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "techniques/light_volume/paper_test_sh.h"

namespace lightwell {
namespace {

using glm::dot;
using glm::vec3;
using glm::vec4;
ShaderSh sh;

using Function = std::function<float(vec3)>;

// Midpoint rule, equal areas.
void for_each_direction(const std::function<void(vec3, double)>& visit) {
  constexpr int kRows = 1024;
  constexpr int kColumns = 2048;
  const double weight = 4.0 * std::numbers::pi / (double{kRows} * kColumns);
  for (int row = 0; row < kRows; ++row) {
    const double z = -1.0 + 2.0 * (row + 0.5) / kRows;
    const double r = std::sqrt(1.0 - z * z);
    for (int column = 0; column < kColumns; ++column) {
      const double phi = 2.0 * std::numbers::pi * (column + 0.5) / kColumns;
      visit(vec3(r * std::cos(phi), r * std::sin(phi), z), weight);
    }
  }
}

vec4 project(const Function& function) {
  glm::dvec4 sum(0.0);
  for_each_direction([&](vec3 w, double weight) { sum += weight * double{function(w)} * glm::dvec4(sh.sh_basis(w)); });
  return vec4(sum);
}

void expect_near(vec4 actual, vec4 expected, float tolerance) {
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(actual[k], expected[k], tolerance) << "coefficient " << k;
}

vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<float> normal;
  return glm::normalize(vec3(normal(random), normal(random), normal(random)));
}

TEST(PaperSh, BasisIsOrthonormal) {
  for (int k = 0; k < 4; ++k) {
    vec4 expected(0.0f);
    expected[k] = 1.0f;
    expect_near(project([&](vec3 w) { return sh.sh_basis(w)[k]; }), expected, 1e-4f);
  }
}

TEST(PaperSh, LobesEqualTheirProjections) {
  std::mt19937 random(7);
  for (int i = 0; i < 4; ++i) {
    const vec3 axis = random_direction(random);
    expect_near(sh.sh_hemisphere(axis), project([&](vec3 w) { return dot(w, axis) > 0.0f ? 1.0f : 0.0f; }), 1e-3f);
    expect_near(sh.sh_cosine_lobe(axis), project([&](vec3 w) { return std::max(0.0f, dot(w, axis)); }), 1e-3f);
  }
}

TEST(PaperSh, CubeFacesEqualTheirProjectionsAndSumToOne) {
  vec4 sum(0.0f);
  for (int face = 0; face < 6; ++face) {
    vec3 axis(0.0f);
    axis[face / 2] = face % 2 == 0 ? 1.0f : -1.0f;
    const Function indicator = [&](vec3 w) {
      const vec3 size = glm::abs(w);
      return dot(w, axis) >= std::max({size.x, size.y, size.z}) ? 1.0f : 0.0f;
    };
    expect_near(sh.sh_cube_face(axis), project(indicator), 1e-3f);
    sum += sh.sh_cube_face(axis);
  }
  expect_near(sum, vec4(1.0f / sh.kShY0, 0.0f, 0.0f, 0.0f), 1e-5f);
}

// Eq. 3.3.2 for distributions of two bands, where the dot product is exact: irradiance is the integral of the light
// times the clamped cosine.
TEST(PaperSh, IrradianceIsADotProduct) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  for (int i = 0; i < 4; ++i) {
    const vec4 light(uniform(random), uniform(random), uniform(random), uniform(random));
    const vec3 normal = random_direction(random);
    double integral = 0.0;
    double total = 0.0;
    for_each_direction([&](vec3 w, double weight) {
      integral += weight * double{sh.sh_evaluate(light, w)} * std::max(0.0f, dot(w, normal));
      total += weight * double{sh.sh_evaluate(light, w)};
    });
    EXPECT_NEAR(dot(light, sh.sh_cosine_lobe(normal)), integral, 1e-3);
    EXPECT_NEAR(sh.sh_integral(light), total, 1e-3);
  }
}

}  // namespace
}  // namespace lightwell
