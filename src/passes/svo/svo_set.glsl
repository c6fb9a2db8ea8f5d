// Set 3 of kernels that look into the octree or its grid of bits: Svo::set of passes/svo/svo.h.
#ifndef LIGHTWELL_SVO_SET_GLSL
#define LIGHTWELL_SVO_SET_GLSL

#include "passes/svo/svo_cells.glsl"
#include "passes/svo/svo_types.h"

layout(set = 3, binding = 0) readonly buffer SvoFrameBuffer { SvoFrame data; } svo_frame;

#endif
