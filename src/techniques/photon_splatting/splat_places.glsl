// Places of splats in the lists of all tiles. The kernel declares sums and blocks.
#ifndef LIGHTWELL_SPLAT_PLACES_GLSL
#define LIGHTWELL_SPLAT_PLACES_GLSL

#include "passes/sort/sort_types.h"

// Of the first splat of a counter: tile * parts + part.
uint place_of(uint counter) { return sums.data[counter] + blocks.data[counter / kScanBlock].x; }

// By which power of two the lists must be thinned to fit.
uint thinning_shift(uint total) {
  uint part = (total + params.capacity - 1) / params.capacity;
  return part <= 1 ? 0 : uint(findMSB(part - 1)) + 1;
}

// Of `place` splats those that stay: the first of each 2^shift.
uint thinned(uint place, uint shift) { return (place + (1u << shift) - 1) >> shift; }

#endif
