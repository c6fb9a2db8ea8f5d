// One pass of a radix sort, first half: how often each digit occurs in each chunk. One invocation a chunk, so that
// neither atomics nor barriers are needed and equal digits keep their order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sort/sort_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 8) in;
LW_PAGED_READ(0, 0, uvec2, keys)
layout(set = 0, binding = 1) buffer CountBuffer { uint data[]; } counts;  // [digit][chunk]

#include "shaders/linear_dispatch.glsl"

void main() {
  uint chunk = linear_invocation();
  uint chunks = (params.count + kSortChunk - 1) / kSortChunk;
  if (chunk >= chunks) return;
  for (uint digit = 0; digit < 1u << kSortBits; ++digit) counts.data[digit * chunks + chunk] = 0;
  uint end = min((chunk + 1) * kSortChunk, params.count);
  for (uint i = chunk * kSortChunk; i < end; ++i) {
    uint digit = bitfieldExtract(keys_at(i).x, int(params.shift), int(kSortBits));
    counts.data[digit * chunks + chunk] += 1;
  }
}
