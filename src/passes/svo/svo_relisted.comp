// Goes on with the list that was made anew.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/svo/svo_types.h"
#include "shaders/linear_dispatch.glsl"

layout(local_size_x = 1) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) writeonly buffer ArgumentBuffer { uint data[]; } arguments;

void main() {
  uvec3 groups = linear_groups((counts.data[kSvoListCount] + 63) / 64);
  for (uint i = 0; i < 3; ++i) arguments.data[kSvoListGroups + i] = groups[i];
}
