// Fits the boxes of one level of wide nodes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer LevelBuffer { uint data[]; } levels;
layout(set = 0, binding = 1) readonly buffer TriangleBuffer { uvec4 data[]; } triangles;
layout(set = 0, binding = 2) buffer NodeBuffer { uvec4 data[]; } nodes;
layout(set = 0, binding = 3) buffer NodeBoxBuffer { vec4 data[]; } node_boxes;

#include "shaders/linear_dispatch.glsl"
#include "passes/trace/bvh_refit.glsl"

void main() { fit_level(params.round, linear_invocation()); }
