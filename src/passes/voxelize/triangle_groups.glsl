// The triangles that a kernel goes through: all, or those of listed groups. The including kernel includes
// voxelize_types.h and shaders/linear_dispatch.glsl, has 64 x 1 x 1 invocations a group, and declares
//   layout(set = 0, binding = n) readonly buffer GroupBuffer { uint data[]; } groups;
#ifndef LIGHTWELL_TRIANGLE_GROUPS_GLSL
#define LIGHTWELL_TRIANGLE_GROUPS_GLSL

layout(constant_id = 1) const uint kGrouped = 0;  // 1: the listed ones

// Number of this invocation's, of those that are chosen; 2^32 - 1: none.
uint triangle_of_group() {
  if (kGrouped == 0) return linear_invocation();
  uint group = linear_invocation() / kTriangleGroup;
  return group < groups.data[kGroupsListed]
             ? groups.data[kGroupHeader + group] * kTriangleGroup + linear_invocation() % kTriangleGroup
             : 0xffffffffu;
}

#endif
