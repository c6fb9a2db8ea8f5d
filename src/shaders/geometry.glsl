// Triangles of the scene: bindings 0 and 1 of set 1, the scene's (GpuScene::Frame::set; shaders/material.glsl has the
// others). Kernels bind the set and call these functions.
#ifndef LIGHTWELL_GEOMETRY_GLSL
#define LIGHTWELL_GEOMETRY_GLSL

#include "passes/gpu_scene/gpu_scene_types.h"
#include "shaders/paged_buffer.glsl"
#include "shaders/vertex_color.glsl"

LW_PAGED_READ(1, 0, WorldVertex, vertices)
LW_PAGED_READ(1, 1, uint, indices)

WorldVertex scene_vertex(uint index) { return vertices_at(index); }
vec3 scene_position(uint index) { return vertices_at(index).position_material.xyz; }
uint scene_index(uint index) { return indices_at(index); }

vec3 vertex_position(WorldVertex v) { return v.position_material.xyz; }
vec3 vertex_normal(WorldVertex v) { return v.normal_u.xyz; }
vec4 vertex_uv(WorldVertex v) { return vec4(v.normal_u.w, v.v_uv1.xyz); }
uint vertex_material(WorldVertex v) { return floatBitsToUint(v.position_material.w) & 0xffffu; }
// +1, or -1 where the instance mirrors: its front faces are then wound clockwise.
float vertex_handedness(WorldVertex v) { return v.v_uv1.w < 0.0 ? -1.0 : 1.0; }

// Linear, multiplies the base colour. Stored as what its root is short of 1, alpha as it is (gpu_scene_types.h).
vec4 vertex_color(WorldVertex v) {
  if (kVertexColors == 0) return vec4(1.0);
  uint high = floatBitsToUint(v.position_material.w) >> 16;
  uint low = floatBitsToUint(v.v_uv1.w) ^ 0x3f800000u;
  uvec3 missing = uvec3(low & 0xfffu, (low >> 12) & 0xfffu, ((low >> 24) & 0x3fu) | ((high & 0x3fu) << 6));
  vec3 root = 1.0 - vec3(missing) / 4095.0;
  return vec4(root * root, 1.0 - float((high >> 6) & 0xffu) / 255.0);
}

struct Triangle {
  WorldVertex v[3];
};

Triangle load_triangle(uint index) {
  Triangle t;
  for (uint i = 0; i < 3; ++i) t.v[i] = scene_vertex(scene_index(3 * index + i));
  return t;
}

// At weights of the second and third corner.
vec3 corner_weights(vec2 barycentrics) { return vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics); }

vec4 triangle_uv(Triangle t, vec2 barycentrics) {
  vec3 weights = corner_weights(barycentrics);
  return weights.x * vertex_uv(t.v[0]) + weights.y * vertex_uv(t.v[1]) + weights.z * vertex_uv(t.v[2]);
}

vec4 triangle_color(Triangle t, vec2 barycentrics) {
  if (kVertexColors == 0) return vec4(1.0);
  vec3 weights = corner_weights(barycentrics);
  return weights.x * vertex_color(t.v[0]) + weights.y * vertex_color(t.v[1]) + weights.z * vertex_color(t.v[2]);
}

// Towards the front side; length twice the area (m^2).
vec3 front_normal(Triangle t) {
  vec3 origin = vertex_position(t.v[0]);
  return cross(vertex_position(t.v[1]) - origin, vertex_position(t.v[2]) - origin) * vertex_handedness(t.v[0]);
}

#endif
