// Change of light, as host and kernels see it.
#ifndef LIGHTWELL_LIGHT_CHANGE_TYPES_H
#define LIGHTWELL_LIGHT_CHANGE_TYPES_H

#include "shaders/shared.h"

// Side of the blocks of pixels of which one, by turns, is asked whether its light has changed.
LW_CONSTANT(uint, kChangeBlock, 3)

#ifndef __cplusplus

// The pixel of a block whose turn it is.
uvec2 pixel_of_turn(uvec2 block, uint turn, uvec2 size) {
  return min(block * kChangeBlock + uvec2(turn % kChangeBlock, turn / kChangeBlock), size - 1);
}

#endif

#endif
