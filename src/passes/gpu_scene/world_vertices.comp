// Writes vertices in world space, morphed and skinned, and keeps where they were last frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/gpu_scene/gpu_scene_types.h"
#include "passes/gpu_scene/world_vertices_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 64) in;
LW_PAGED_READ(0, 0, VertexSource, sources)
LW_PAGED_READ(0, 1, ObjectVertex, object_vertices)
layout(set = 0, binding = 2) readonly buffer PartBuffer { Part data[]; } parts;
LW_PAGED_READ_WRITE(restrict, 0, 3, WorldVertex, vertices)
LW_PAGED_WRITE(0, 4, vec4, previous_positions)
LW_PAGED_READ(0, 5, Influence, influences)
layout(set = 0, binding = 6) readonly buffer JointBuffer { Joint data[]; } joints;
layout(set = 0, binding = 7) readonly buffer MorphBuffer { Morph data[]; } morphs;
LW_PAGED_READ(0, 8, MorphOffset, morph_offsets)

#include "shaders/linear_dispatch.glsl"

layout(constant_id = 0) const uint kDeforms = 0;  // 1: some of the vertices may be morphed or skinned

void main() {
  uint invocation = linear_invocation();
  if (invocation >= params.vertex_count) return;
  uint index = params.first_vertex + invocation;
  VertexSource source = sources_at(index);
  ObjectVertex v = object_vertices_at(source.object_vertex);
  Part part = parts.data[source.part];

  // Morph targets add to the mesh, then its joints or its node move it (glTF 2.0, 3.7.2.2 and 3.7.3.3). What only these
  // need is read inside their loops.
  for (uint i = 0; i < kDeforms * part.morph_count; ++i) {
    Morph morph = morphs.data[parts.data[source.part].first_morph + i];
    uint offset = morph.first_offset + source.object_vertex - parts.data[source.part].first_object_vertex;
    v.position += morph.weight * morph_offsets_at(offset).position.xyz;
    v.normal += morph.weight * morph_offsets_at(offset).normal.xyz;
  }
  vec4 row_0 = part.row_0;
  vec4 row_1 = part.row_1;
  vec4 row_2 = part.row_2;
  float side = part.handedness;
  for (uint i = 0; i < kDeforms * part.skin_count; ++i) {
    uint first_joint = parts.data[source.part].first_joint;
    Influence influence = influences_at(parts.data[source.part].first_influence + source.object_vertex -
                                        parts.data[source.part].first_object_vertex);
    row_0 = row_1 = row_2 = vec4(0.0);
    for (uint k = 0; k < 4; ++k) {
      Joint joint = joints.data[first_joint + influence.joints[k]];
      row_0 += influence.weights[k] * joint.row_0;
      row_1 += influence.weights[k] * joint.row_1;
      row_2 += influence.weights[k] * joint.row_2;
    }
    side = dot(row_0.xyz, cross(row_1.xyz, row_2.xyz)) < 0.0 ? -1.0 : 1.0;
  }
  vec4 p = vec4(v.position, 1.0);
  vec3 position = vec3(dot(row_0, p), dot(row_1, p), dot(row_2, p));

  // Normals turn with the cofactor matrix: right for any scale, and defined where the matrix is singular.
  mat3 cofactor = transpose(mat3(cross(row_1.xyz, row_2.xyz), cross(row_2.xyz, row_0.xyz),
                                 cross(row_0.xyz, row_1.xyz)));
  vec3 normal = cofactor * v.normal * side;
  float normal_length = length(normal);
  normal = normal_length > 0.0 ? normal / normal_length : vec3(0.0);

  vec3 last = params.first_frame != 0 ? position : vertices_at(index).position_material.xyz;
  previous_positions_store(index, vec4(last, 1.0));
  uvec2 color = floatBitsToUint(v.uv1.zw);
  vec2 packed = uintBitsToFloat(uvec2(part.material, floatBitsToUint(part.handedness)) ^ color);
  vertices_store(index, WorldVertex(vec4(position, packed.x), vec4(normal, v.u), vec4(v.v, v.uv1.xy, packed.y)));
}
