#version 450
// Scales numbers that lie in a shared set. All buffers may be in pages.
#include "graph/testing/scale.h"
#include "shaders/paged_buffer.glsl"
layout(local_size_x = 64) in;
layout(constant_id = 2) const uint kOffset = 0;
LW_PAGED_READ_WRITE(restrict, 0, 0, uint, target)
LW_PAGED_READ(1, 0, uint, numbers)

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= params.count) return;
  target_store(i, params.factor * numbers_at(i));
  target_store(i, target_at(i) + kOffset + numbers_count() - target_count());
}
