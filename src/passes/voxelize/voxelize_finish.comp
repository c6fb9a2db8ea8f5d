// Turns the number of tiles into the arguments of the dispatches that go through them. Where the list overflowed it
// is not used at all: the large triangles are then walked through cell by cell, slower but complete.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxelize/voxelize_params.h"
#include "shaders/linear_dispatch.glsl"

layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer TileCountBuffer { uint data[]; } tile_counts;

void write_groups(uint first, uint count) {
  uvec3 groups = linear_groups(count);
  for (uint i = 0; i < 3; ++i) tile_counts.data[first + i] = groups[i];
}

void main() {
  uint found = tile_counts.data[kTilesFound];
  bool overflow = found > params.tile_capacity;
  write_groups(kTileGroups, overflow ? 0 : found);
  write_groups(kLargeGroups, overflow ? (params.triangles.count + 63) / 64 : 0);
}
