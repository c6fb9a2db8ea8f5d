// Fits the boxes of one level of wide nodes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer LevelBuffer { uint data[]; } levels;
LW_PAGED_READ(0, 1, uvec4, triangles)
LW_PAGED_READ_WRITE(restrict, 0, 2, uvec4, nodes)
LW_PAGED_READ_WRITE(restrict, 0, 3, vec4, node_boxes)

#include "shaders/linear_dispatch.glsl"
#include "passes/trace/bvh_refit.glsl"

void main() { fit_level(params.round, linear_invocation()); }
