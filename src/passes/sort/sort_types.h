// Sorting and prefix sums: sizes and parameters shared with the kernels.
#ifndef LIGHTWELL_SORT_TYPES_H
#define LIGHTWELL_SORT_TYPES_H

#include "shaders/shared.h"

LW_CONSTANT(uint, kSortBits, 8)     // of a key, a round
LW_CONSTANT(uint, kSortChunk, 512)  // keys that one invocation counts and scatters
LW_CONSTANT(uint, kScanBlock, 64)   // elements that one invocation adds up

#endif
