// Prefix sums of the blocks' sums.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sort/sort_params.h"

layout(local_size_x = 256) in;
layout(set = 0, binding = 0) buffer BlockBuffer { uvec2 data[]; } blocks;

#include "passes/sort/scan_blocks.glsl"

void main() { scan_blocks((params.count + kScanBlock - 1) / kScanBlock); }
