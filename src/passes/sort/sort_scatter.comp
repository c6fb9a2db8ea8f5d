// One pass of a radix sort, second half: every key to its place.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sort/sort_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 8) in;
LW_PAGED_READ(0, 0, uvec2, keys)
layout(set = 0, binding = 1) buffer PlaceBuffer { uint data[]; } places;          // [digit][chunk], within its block
layout(set = 0, binding = 2) readonly buffer BlockBuffer { uvec2 data[]; } blocks;  // before each block
LW_PAGED_WRITE(0, 3, uvec2, sorted)

#include "shaders/linear_dispatch.glsl"

void main() {
  uint chunk = linear_invocation();
  uint chunks = (params.count + kSortChunk - 1) / kSortChunk;
  if (chunk >= chunks) return;
  uint end = min((chunk + 1) * kSortChunk, params.count);
  for (uint i = chunk * kSortChunk; i < end; ++i) {
    uvec2 key = keys_at(i);
    uint cell = bitfieldExtract(key.x, int(params.shift), int(kSortBits)) * chunks + chunk;
    uint place = places.data[cell];
    places.data[cell] = place + 1;
    sorted_store(blocks.data[cell / kScanBlock].x + place, key);
  }
}
