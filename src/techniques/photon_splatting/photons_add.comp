// So many splats more are in use as there are light points.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/photon_splatting/photon_params.h"

layout(local_size_x = 1) in;
layout(set = 0, binding = 0) readonly buffer PointCountBuffer { uint data[]; } point_counts;
layout(set = 0, binding = 1) buffer SplatCountBuffer { uint data[]; } splat_counts;

#include "techniques/photon_splatting/splat_counts.glsl"

void main() { set_splat_count(splat_counts.data[kSplatsInUse] + point_counts.data[kPointsInAll]); }
