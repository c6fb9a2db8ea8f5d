// As light_gather_rays.comp, shadowed by rays through the octree as published.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_clusters/light_clusters_types.h"
#include "shaders/light_point.h"
#include "techniques/many_light/many_light_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kRemember = true;

#include "passes/svo/svo_trace.glsl"
#include "shaders/light_point.glsl"
#include "shaders/luminance.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/receiver.glsl"

bool is_occluded(Receiver receiver, LightPoint point) {
  return svo_restart_blocked(receiver.position, point.position);
}

#include "techniques/many_light/light_gather.glsl"
