// Display transform: parameters shared with tonemap.frag.
#ifndef LIGHTWELL_PASSES_TONEMAP_H
#define LIGHTWELL_PASSES_TONEMAP_H

#include "shaders/shared.h"

// encode_srgb: 0 where the target's format encodes by itself.
#define LW_TONEMAP_PARAMS(MEMBER) MEMBER(float, exposure) MEMBER(uint, encode_srgb)
LW_PUSH_CONSTANTS(TonemapParams, LW_TONEMAP_PARAMS)

#endif
