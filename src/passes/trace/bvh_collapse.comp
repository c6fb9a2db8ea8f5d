// Makes wide nodes of the binary ones that one round of merging made.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer StateBuffer { uint data[]; } state;
layout(set = 0, binding = 1) readonly buffer LowBuffer { uvec4 data[]; } lows;
layout(set = 0, binding = 2) readonly buffer HighBuffer { uvec4 data[]; } highs;
layout(set = 0, binding = 3) readonly buffer SizeBuffer { uint data[]; } sizes;
layout(set = 0, binding = 4) buffer MarkBuffer { uint data[]; } marks;
layout(set = 0, binding = 5) buffer FirstBuffer { uint data[]; } firsts;
layout(set = 0, binding = 6) writeonly buffer ChildBuffer { uvec4 data[]; } children;
layout(set = 0, binding = 7) writeonly buffer TriangleBuffer { uvec4 data[]; } triangles;

#include "shaders/linear_dispatch.glsl"
#include "passes/trace/bvh_collapse.glsl"

void main() { collapse_round(params.round, linear_invocation()); }
