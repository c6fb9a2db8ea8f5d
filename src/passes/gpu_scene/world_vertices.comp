// Writes vertices in world space, and keeps where it was last frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gpu_scene/gpu_scene_types.h"
#include "passes/gpu_scene/world_vertices_params.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer SourceBuffer { VertexSource data[]; } sources;
layout(set = 0, binding = 1) readonly buffer ObjectBuffer { ObjectVertex data[]; } object_vertices;
layout(set = 0, binding = 2) readonly buffer PartBuffer { Part data[]; } parts;
layout(set = 0, binding = 3) buffer VertexBuffer { WorldVertex data[]; } vertices;
layout(set = 0, binding = 4) buffer PreviousBuffer { vec4 data[]; } previous_positions;

#include "shaders/linear_dispatch.glsl"

void main() {
  uint invocation = linear_invocation();
  if (invocation >= params.vertex_count) return;
  uint index = params.first_vertex + invocation;
  ObjectVertex v = object_vertices.data[sources.data[index].object_vertex];
  Part part = parts.data[sources.data[index].part];

  vec4 p = vec4(v.position, 1.0);
  vec3 position = vec3(dot(part.row_0, p), dot(part.row_1, p), dot(part.row_2, p));

  // Normals turn with the cofactor matrix: right for any scale, and defined where the matrix is singular.
  mat3 cofactor = transpose(mat3(cross(part.row_1.xyz, part.row_2.xyz), cross(part.row_2.xyz, part.row_0.xyz),
                                 cross(part.row_0.xyz, part.row_1.xyz)));
  vec3 normal = cofactor * v.normal * part.handedness;
  float normal_length = length(normal);
  normal = normal_length > 0.0 ? normal / normal_length : vec3(0.0);

  vec3 last = params.first_frame != 0 ? position : vertices.data[index].position_material.xyz;
  previous_positions.data[index] = vec4(last, 1.0);
  vertices.data[index].position_material = vec4(position, uintBitsToFloat(part.material));
  vertices.data[index].normal_u = vec4(normal, v.u);
  vertices.data[index].v_uv1 = vec4(v.v, v.uv1.xy, part.handedness);
}
