// As paper_gather_rays.comp, shadowed by rays through the octree as published.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/light_point.h"
#include "techniques/many_light/many_light_types.h"

layout(local_size_x = 8, local_size_y = 8) in;

#include "passes/svo/svo_trace.glsl"
#include "shaders/light_point.glsl"
#include "shaders/luminance.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/receiver.glsl"

bool is_occluded(Receiver receiver, LightPoint point) {
  return svo_restart_blocked(receiver.position, point.position);
}

#include "techniques/many_light/paper_gather.glsl"
