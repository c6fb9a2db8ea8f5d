// Light of chosen light points, shadowed by rays against the scene's triangles.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_clusters/light_clusters_types.h"
#include "shaders/light_point.h"
#include "techniques/many_light/many_light_types.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kRemember = true;

#include "shaders/trace.glsl"

#include "shaders/light_point.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/receiver.glsl"

bool is_occluded(Receiver receiver, LightPoint point) {
  return is_blocked(Ray(receiver.start, 0.0, point.position - receiver.start, 1.0));
}

#include "techniques/many_light/light_gather.glsl"
