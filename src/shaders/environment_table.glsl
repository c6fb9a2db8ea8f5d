// Directions of an environment's map in proportion to how much light comes from there (passes/environment/
// environment_table.h). The including kernel declares, before including this file,
//   layout(set = 0, binding = n) readonly buffer EnvironmentTableBuffer { float data[]; } environment_table;
#ifndef LIGHTWELL_ENVIRONMENT_TABLE_GLSL
#define LIGHTWELL_ENVIRONMENT_TABLE_GLSL

#include "shaders/constants.glsl"

// A cell along one axis, and where in it: 0 to 1.
struct TableChoice {
  uint cell;
  float place;
  float probability;
};

float running_sum(uint first, uint cell) { return cell == 0 ? 0.0 : environment_table.data[first + cell - 1]; }

// The cell whose running sums enclose `u`, of `count` sums from `first` on.
TableChoice choose_cell(uint first, uint count, float u) {
  uint low = 0;
  uint high = count - 1;
  for (int i = 0; i < 16 && low < high; ++i) {
    uint middle = (low + high) / 2;
    if (environment_table.data[first + middle] > u) high = middle;
    else low = middle + 1;
  }
  float below = running_sum(first, low);
  float probability = environment_table.data[first + low] - below;
  return TableChoice(low, probability > 0.0 ? clamp((u - below) / probability, 0.0, 0.99999994) : 0.5, probability);
}

struct EnvironmentSample {
  vec3 direction;  // unit
  float density;   // per steradian; 0: of no use
};

// p(direction) = p(u, v) / (2 pi^2 sin(polar angle)): the Jacobian of latitude and longitude.
float density_per_steradian(float probability, uvec2 size, float sine) {
  const float kTwoPiSquared = 19.7392088021787;
  return sine > 0.0 ? probability * float(size.x) * float(size.y) / (kTwoPiSquared * sine) : 0.0;
}

EnvironmentSample sample_environment(uvec2 size, vec2 u) {
  TableChoice row = choose_cell(0, size.y, u.y);
  TableChoice column = choose_cell(size.y + row.cell * size.x, size.x, u.x);
  float longitude = 2.0 * kPi * ((float(column.cell) + column.place) / float(size.x) - 0.5);
  float polar = kPi * (float(row.cell) + row.place) / float(size.y);
  vec3 direction = vec3(sin(polar) * sin(longitude), cos(polar), -sin(polar) * cos(longitude));
  return EnvironmentSample(direction, density_per_steradian(row.probability * column.probability, size, sin(polar)));
}

// Density with which sample_environment() finds the unit `direction`.
float environment_density(uvec2 size, vec3 direction) {
  float sine = length(direction.xz);
  vec2 uv = vec2(atan(direction.x, -direction.z) / (2.0 * kPi) + 0.5, atan(sine, direction.y) / kPi);
  uvec2 cell = min(uvec2(uv * vec2(size)), size - 1);
  float row = environment_table.data[cell.y] - running_sum(0, cell.y);
  uint first = size.y + cell.y * size.x;
  float column = environment_table.data[first + cell.x] - running_sum(first, cell.x);
  return density_per_steradian(row * column, size, sine);
}

#endif
