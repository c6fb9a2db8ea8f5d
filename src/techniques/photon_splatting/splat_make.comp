// A splat for each light point, in their order.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/sort/sort_types.h"
#include "shaders/light_point.h"
#include "techniques/photon_splatting/photon_params.h"
#include "techniques/photon_splatting/splat_storage.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kGuided = false;  // splats are told where their paths started
layout(set = 0, binding = 0) readonly buffer LightPointBuffer { LightPoint data[]; } points;
layout(set = 0, binding = 1) readonly buffer AreaBuffer { float data[]; } areas;
layout(set = 0, binding = 2) readonly buffer SumBuffer { uint data[]; } sums;
layout(set = 0, binding = 3) readonly buffer BlockBuffer { uvec2 data[]; } blocks;
layout(set = 0, binding = 4) readonly buffer PointCountBuffer { uint data[]; } point_counts;
layout(set = 0, binding = 5) readonly buffer SplatCountBuffer { uint data[]; } splat_counts;
layout(set = 0, binding = 6) readonly buffer SobolBuffer { uint data[]; } sobol_matrices;
LW_SPLATS_WRITE(0, 7)
layout(set = 0, binding = 8) writeonly buffer StartBuffer { PhotonStart data[]; } starts;
layout(set = 0, binding = 9) readonly buffer PathStratumBuffer { uint data[]; } path_strata;
layout(set = 0, binding = 10) writeonly buffer SplatStratumBuffer { uint data[]; } splat_strata;

#include "shaders/trace.glsl"

#include "shaders/linear_dispatch.glsl"
#include "techniques/photon_splatting/splat_make.glsl"

void main() {
  uint index = linear_invocation();
  if (index >= params.paths * params.bounces) return;
  LightPoint point = points.data[index];
  uint slot = splat_counts.data[kSplatsInUse] + sums.data[index] + blocks.data[index / kScanBlock].x;
  if (point.flux == vec3(0.0) || slot >= params.capacity) return;
  if (kGuided) splat_strata.data[slot] = path_strata.data[index % params.paths];
  make_splat(slot, point, 1.0, params.half_width > 0.0 ? 0.0 : areas.data[index], path_of(index));
}
