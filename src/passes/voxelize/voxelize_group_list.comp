// Arguments of the dispatch over the triangles of the listed groups, 64 a workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxelize/voxelize_types.h"

layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer GroupBuffer { uint data[]; } groups;

#include "shaders/linear_dispatch.glsl"

void main() {
  uvec3 size = linear_groups((groups.data[kGroupsListed] * kTriangleGroup + 63) / 64);
  for (uint i = 0; i < 3; ++i) groups.data[i] = size[i];
}
