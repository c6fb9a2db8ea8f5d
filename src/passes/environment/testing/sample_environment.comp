// One direction for each pair of numbers.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/environment/testing/sample_environment.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer NumberBuffer { vec2 data[]; } numbers;
layout(set = 0, binding = 1) readonly buffer EnvironmentTableBuffer { float data[]; } environment_table;
layout(set = 0, binding = 2) writeonly buffer SampleBuffer { TableTestSample data[]; } samples;

#include "shaders/environment_table.glsl"
#include "shaders/linear_dispatch.glsl"

void main() {
  uint index = linear_invocation();
  if (index >= params.count) return;
  EnvironmentSample s = sample_environment(params.table_size, numbers.data[index]);
  samples.data[index] = TableTestSample(s.direction, s.density, environment_density(params.table_size, s.direction), 0.0, 0.0, 0.0);
}
