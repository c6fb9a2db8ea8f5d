#version 450
#include "graph/testing/scale.h"
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kOffset = 0u;
layout(set = 0, binding = 0) readonly buffer Source { uint values[]; } source;
layout(set = 0, binding = 1) buffer Target { uint values[]; } target;

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < params.count) target.values[i] = source.values[i] * params.factor + kOffset;
}
