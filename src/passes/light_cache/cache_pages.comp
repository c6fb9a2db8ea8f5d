// Lists the pages that no face has, from page params.count on.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_cache/cache_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer OwnedBuffer { uint data[]; } owned;
layout(set = 0, binding = 1) buffer PageCountBuffer { uint data[]; } page_counts;
layout(set = 0, binding = 2) writeonly buffer FreePageBuffer { uint data[]; } free_pages;

#include "shaders/linear_dispatch.glsl"

void main() {
  uint page = params.count + linear_invocation();
  if (page >= params.page_count || owned.data[page] != 0) return;
  free_pages.data[atomicAdd(page_counts.data[kPagesFree], 1)] = page + 1;
}
