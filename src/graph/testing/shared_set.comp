#version 450
// Copies numbers that lie in a shared set, in pages.
#include "graph/testing/scale.h"
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kPages_numbers = 1;
layout(constant_id = 1) const uint kPageShift_numbers = 31;
layout(constant_id = 2) const uint kOffset = 0;
layout(set = 0, binding = 0) buffer Target { uint values[]; } target;
layout(set = 1, binding = 0) readonly buffer Numbers { uint values[]; } numbers[4];

uint number(uint i) {
  if (kPages_numbers == 1) return numbers[0].values[i];
  uint inside = i & ((1u << kPageShift_numbers) - 1u);
  switch (i >> kPageShift_numbers) {
    case 0: return numbers[0].values[inside];
    case 1: return numbers[1].values[inside];
    case 2: return numbers[2].values[inside];
    default: return numbers[3].values[inside];
  }
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < params.count) target.values[i] = params.factor * number(i) + kOffset;
}
