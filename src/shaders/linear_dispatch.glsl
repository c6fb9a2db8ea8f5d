// Long one-dimensional dispatches: a device need not take more than 65535 groups along an axis, so they are folded into
// rows. Host side: linear_groups() of graph/linear_dispatch.h.
#ifndef LIGHTWELL_LINEAR_DISPATCH_GLSL
#define LIGHTWELL_LINEAR_DISPATCH_GLSL

const uint kLinearRow = 32768;

// Arguments of an indirect dispatch of `count` groups.
uvec3 linear_groups(uint count) {
  return count <= kLinearRow ? uvec3(count, 1, 1) : uvec3(kLinearRow, (count + kLinearRow - 1) / kLinearRow, 1);
}

uint linear_group() {
  return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}

// Of workgroups that extend along x only. May exceed what was asked for: compare with the count.
uint linear_invocation() {
  return linear_group() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

#endif
