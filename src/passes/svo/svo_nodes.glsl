// The octree's nodes, of set 3.
#ifndef LIGHTWELL_SVO_NODES_GLSL
#define LIGHTWELL_SVO_NODES_GLSL

#include "passes/svo/svo_set.glsl"
#include "shaders/paged_buffer.glsl"

LW_PAGED_READ(3, 4, uvec4, svo_nodes)

#endif
