// What rays of both injections share. The including kernel declares, by these names,
//   layout(set = 0, binding = n) readonly buffer LightBuffer { GpuLight data[]; } lights;
//   layout(set = 0, binding = n) readonly buffer AlbedoBuffer { uint data[]; } albedo;
//   layout(set = 0, binding = n) readonly buffer NormalBuffer { uint data[]; } normals;
// before including this file, and one of paper_find_triangle.glsl and paper_find_voxel.glsl after it.
#ifndef LIGHTWELL_RAY_TRACED_VOXELS_PAPER_INJECT_GLSL
#define LIGHTWELL_RAY_TRACED_VOXELS_PAPER_INJECT_GLSL

#include "passes/light_paths/light_rays.glsl"
#include "shaders/linear_dispatch.glsl"
#include "techniques/ray_traced_voxels/paper_voxels.glsl"

// What a ray met first.
struct Found {
  float t;  // m; negative: nothing
  uint voxel;
  vec3 start;  // of rays that leave again, outside the surface
};

// The place in the square of rays of element `index` of the buffers: neighbours in the buffer are neighbours there.
uvec2 ray_place(uint index) {
  uint blocks = (params.side + kRayBlock - 1) / kRayBlock;
  uint block = index / (kRayBlock * kRayBlock);
  uvec2 inside = uvec2((index & 1u) | ((index >> 1) & 2u) | ((index >> 2) & 4u),
                       ((index >> 1) & 1u) | ((index >> 2) & 2u) | ((index >> 3) & 4u));
  return kRayBlock * uvec2(block % blocks, block / blocks) + inside;
}

vec3 voxel_normal(uint voxel) { return decode_normal(normals.data[voxel]); }
vec3 voxel_albedo(uint voxel) { return unpackUnorm4x8(albedo.data[voxel]).rgb; }
bool has_surface(uint voxel) { return voxel != kNoVoxel && is_occupied(normals.data[voxel]); }

// Sent on as from a mirror; a voxel whose normals cancelled sends nothing on. Unit.
bool mirror(vec3 direction, vec3 normal, out vec3 mirrored) {
  float size = length(normal);
  mirrored = normalize(reflect(direction, normal / max(size, 1e-6)));
  return size > 1e-3;
}

const float kLeastSquare = 1e-18;  // m^2: a light on a surface is as if 1 nm away

#endif
