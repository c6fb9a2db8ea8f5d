// The direction about a normal for each pair of numbers in [0,1).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sampled_lights/testing/cosine_directions.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer QuestionBuffer { CosineQuestion data[]; } questions;
layout(set = 0, binding = 1) writeonly buffer DirectionBuffer { vec4 data[]; } directions;

#include "shaders/hemisphere.glsl"
#include "shaders/linear_dispatch.glsl"

void main() {
  uint i = linear_invocation();
  if (i >= params.count) return;
  CosineQuestion question = questions.data[i];
  directions.data[i] = vec4(cosine_direction(frame_about(question.normal), disk_point(question.numbers)), 0.0);
}
