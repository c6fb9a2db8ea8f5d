// Sums of the exact writer, for kernels that write samples: a record is a voxel's. Those that are in use are listed:
// only they need to be looked at, and cleared, afterwards. The order of the list is another one every time, and does
// not matter. Host side: write_exact_sums() of paper_exact.h.
#ifndef LIGHTWELL_RAY_TRACED_VOXELS_PAPER_SUMS_GLSL
#define LIGHTWELL_RAY_TRACED_VOXELS_PAPER_SUMS_GLSL

#include "shaders/paged_buffer.glsl"
#include "shaders/software_drivers.glsl"
#include "techniques/ray_traced_voxels/paper_types.h"

LW_PAGED_BLOCK(restrict, 0, 4, uvec4, sums)
LW_PAGED_BLOCK(restrict, 0, 5, uint, high_sums)
layout(set = 0, binding = 6) writeonly buffer TouchedBuffer { uint data[]; } touched;
layout(set = 0, binding = 7) buffer TouchedCountBuffer { uint data[]; } touched_count;

// A grid of 256^3 voxels has two pages of 128 MiB.
#define LW_ADD_TO_PAGE(number)                                              \
  for (uint i = 0; i < LW_ROUNDS_IF(page == number, 1); ++i) {              \
    before.r = atomicAdd(sums[number].data[place].r, amounts.r);            \
    before.g = atomicAdd(sums[number].data[place].g, amounts.g);            \
    before.b = atomicAdd(sums[number].data[place].b, amounts.b);            \
    before.a = atomicAdd(sums[number].data[place].a, amounts.a);            \
  }

uvec4 exact_add(uint voxel, uvec4 amounts) {
  uint page = kPages_sums == 1 ? 0 : sums_page(voxel);
  uint place = kPages_sums == 1 ? voxel : sums_place(voxel);
  uvec4 before = uvec4(0);
  LW_ADD_TO_PAGE(0)
  if (kPages_sums > 1) LW_ADD_TO_PAGE(1)
  if (kPages_sums > 2) LW_ADD_TO_PAGE(2)
  if (kPages_sums > 3) LW_ADD_TO_PAGE(3)
  return before;
}

void exact_add_high(uint voxel, uvec3 amounts) {
  for (uint k = 0; k < 3; ++k) {
    uint word = kExactHighWords * voxel + k;
    uint page = high_sums_page(word);
    uint place = high_sums_place(word);
    if (page == 0) atomicAdd(high_sums[0].data[place], amounts[k]);
    if (kPages_high_sums > 1 && page == 1) atomicAdd(high_sums[1].data[place], amounts[k]);
    if (kPages_high_sums > 2 && page == 2) atomicAdd(high_sums[2].data[place], amounts[k]);
    if (kPages_high_sums > 3 && page == 3) atomicAdd(high_sums[3].data[place], amounts[k]);
  }
}

// Makes room in the list: gives the first of `count` places.
uint append_touched(uint count) { return atomicAdd(touched_count.data[kTouchedCount], count); }

#endif
