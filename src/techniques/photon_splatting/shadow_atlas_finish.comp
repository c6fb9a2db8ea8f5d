// The part of each map's texels that may be lit. Where there is none, there is no splat.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/paged_buffer.glsl"
#include "techniques/photon_splatting/photon_params.h"
#include "techniques/photon_splatting/splat_types.h"

layout(local_size_x = 64) in;
LW_PAGED_READ_WRITE(restrict, 0, 0, Splat, splats)
layout(set = 0, binding = 1) readonly buffer AcceptedBuffer { uint data[]; } accepted;
layout(set = 0, binding = 2) readonly buffer SplatCountBuffer { uint data[]; } splat_counts;

#include "shaders/linear_dispatch.glsl"

void main() {
  uint index = linear_invocation();
  if (index >= splat_counts.data[kSplatsInUse]) return;
  Splat splat = splats_at(index);
  uint texels = accepted.data[index];
  splat.accepted = float(max(texels, 1)) / float(params.map_side * params.map_side);
  if (texels == 0) splat.flux = vec3(0.0);
  splats_store(index, splat);
}
