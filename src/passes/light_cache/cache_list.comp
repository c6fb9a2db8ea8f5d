// Arguments of the dispatch over the faces that gather.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_cache/cache_types.h"

layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer ListBuffer { uint data[]; } list;

#include "shaders/linear_dispatch.glsl"

void main() {
  uvec3 groups = linear_groups((list.data[kListCount] + 63) / 64);
  list.data[0] = groups.x;
  list.data[1] = groups.y;
  list.data[2] = groups.z;
}
