// One fragment: the cell at this pixel and depth joins the list.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/svo/svo_params.h"

LW_PUSH_CONSTANTS(SvoBuildParams, LW_SVO_BUILD_PARAMS)

layout(set = 0, binding = 0) buffer BitBuffer { uint data[]; } bits;
layout(set = 0, binding = 1) writeonly buffer ListBuffer { uint data[]; } list;
layout(set = 0, binding = 2) buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 3) readonly buffer WindowBuffer { ivec4 data[]; } windows;

layout(location = 0) in float depth;
layout(location = 1) flat in uint axis;

#include "passes/svo/svo_add_cell.glsl"

void main() {
  ivec3 turned = ivec3(ivec2(gl_FragCoord.xy), int(floor(depth)));
  ivec3 cell = axis == 0 ? turned.zxy : axis == 1 ? turned.yzx : turned;
  add_cell(uvec3(clamp(cell, ivec3(0), ivec3(params.grid.resolution) - 1)));
}
