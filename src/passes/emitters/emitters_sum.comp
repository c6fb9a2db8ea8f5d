// Running sums of the emitters' power, always added in the same order. Two dispatches: kStage 0 within each group of
// kEmitterGroup triangles (one invocation a group), 1 over the groups (one workgroup in all).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/emitters/emitters_params.h"
#include "passes/emitters/emitters_types.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kStage = 0;
layout(set = 0, binding = 0) buffer EmitterBuffer { EmissiveTriangle data[]; } emitters;
layout(set = 0, binding = 1) buffer GroupBuffer { EmitterGroup data[]; } groups;

#include "shaders/linear_dispatch.glsl"
#include "shaders/luminance.glsl"

const EmitterGroup kEmptyGroup = EmitterGroup(vec3(3e38), 0.0, vec3(-3e38), 3e38);

EmitterGroup join(EmitterGroup a, EmitterGroup b) {
  return EmitterGroup(min(a.low, b.low), a.power_before + b.power_before, max(a.high, b.high),
                      min(a.least_luminance, b.least_luminance));
}

// Leaves the group's own power in power_before.
void sum_triangles(uint group) {
  EmitterGroup sum = kEmptyGroup;
  uint end = min((group + 1) * kEmitterGroup, params.count);
  for (uint i = group * kEmitterGroup; i < end; ++i) {
    EmissiveTriangle emitter = emitters.data[i];
    vec3 b = emitter.corner + emitter.edge_1;
    vec3 c = emitter.corner + emitter.edge_2;
    sum = join(sum, EmitterGroup(min(emitter.corner, min(b, c)), emitter.power_so_far, max(emitter.corner, max(b, c)),
                                 luminance(emitter.emission)));
    emitters.data[i].power_so_far = sum.power_before;
  }
  groups.data[group] = sum;
}

shared EmitterGroup slices[64];

// Every invocation adds up a slice of the groups, then writes the sums before each of them.
void sum_groups(uint group_count) {
  uint slice = gl_LocalInvocationID.x;
  uint length = (group_count + 63) / 64;
  uint begin = min(slice * length, group_count);
  uint end = min(begin + length, group_count);
  EmitterGroup sum = kEmptyGroup;
  for (uint i = begin; i < end; ++i) sum = join(sum, groups.data[i]);
  slices[slice] = sum;
  barrier();
  float power = 0.0;
  for (uint i = 0; i < slice; ++i) power += slices[i].power_before;
  for (uint i = begin; i < end; ++i) {
    float own = groups.data[i].power_before;
    groups.data[i].power_before = power;
    power += own;
  }
  if (slice > 0) return;
  EmitterGroup whole = kEmptyGroup;
  for (uint i = 0; i < 64; ++i) whole = join(whole, slices[i]);
  groups.data[group_count] = whole;
}

void main() {
  uint group_count = (params.count + kEmitterGroup - 1) / kEmitterGroup;
  if (kStage == 1) {
    sum_groups(group_count);
  } else if (linear_invocation() < group_count) {
    sum_triangles(linear_invocation());
  }
}
