// Cuts triangles by the unit cube.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxelize/cut_by_box.glsl"
#include "passes/voxelize/testing/cut.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CaseBuffer { CutCase data[]; } cases;
layout(set = 0, binding = 1) writeonly buffer ResultBuffer { CutResult data[]; } results;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= params.count) return;
  CutCase t = cases.data[i];
  FlatPiece piece = cut_triangle(t.a.xyz, t.b.xyz, t.c.xyz, t.normal.xyz, vec3(0.0), vec3(1.0));
  results.data[i] = CutResult(vec4(piece.center, piece.area), vec4(piece.low, 0.0), vec4(piece.high, 0.0));
}
