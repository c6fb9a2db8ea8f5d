// Makes wide nodes of the binary ones that one round of merging made.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer StateBuffer { uint data[]; } state;
LW_PAGED_READ(0, 1, uvec4, lows)
LW_PAGED_READ(0, 2, uvec4, highs)
LW_PAGED_READ(0, 3, uint, sizes)
LW_PAGED_READ_WRITE(restrict, 0, 4, uint, marks)
LW_PAGED_READ_WRITE(restrict, 0, 5, uint, firsts)
LW_PAGED_WRITE(0, 6, uvec4, children)
LW_PAGED_WRITE(0, 7, uvec4, triangles)

#include "shaders/linear_dispatch.glsl"
#include "passes/trace/bvh_collapse.glsl"

void main() { collapse_round(params.round, linear_invocation()); }
