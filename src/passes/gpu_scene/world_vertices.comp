// Writes vertices in world space, morphed and skinned, and keeps where they were last frame.
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
layout(set = 0, binding = 5) readonly buffer InfluenceBuffer { Influence data[]; } influences;
layout(set = 0, binding = 6) readonly buffer JointBuffer { Joint data[]; } joints;
layout(set = 0, binding = 7) readonly buffer MorphBuffer { Morph data[]; } morphs;
layout(set = 0, binding = 8) readonly buffer MorphOffsetBuffer { MorphOffset data[]; } morph_offsets;

#include "shaders/linear_dispatch.glsl"

layout(constant_id = 0) const uint kDeforms = 0;  // 1: some of the vertices may be morphed or skinned

void main() {
  uint invocation = linear_invocation();
  if (invocation >= params.vertex_count) return;
  uint index = params.first_vertex + invocation;
  VertexSource source = sources.data[index];
  ObjectVertex v = object_vertices.data[source.object_vertex];
  Part part = parts.data[source.part];

  // Morph targets add to the mesh, then its joints or its node move it (glTF 2.0, 3.7.2.2 and 3.7.3.3). What only these
  // need is read inside their loops.
  for (uint i = 0; i < kDeforms * part.morph_count; ++i) {
    Morph morph = morphs.data[parts.data[source.part].first_morph + i];
    uint offset = morph.first_offset + source.object_vertex - parts.data[source.part].first_object_vertex;
    v.position += morph.weight * morph_offsets.data[offset].position.xyz;
    v.normal += morph.weight * morph_offsets.data[offset].normal.xyz;
  }
  vec4 row_0 = part.row_0;
  vec4 row_1 = part.row_1;
  vec4 row_2 = part.row_2;
  float side = part.handedness;
  for (uint i = 0; i < kDeforms * part.skin_count; ++i) {
    uint first_joint = parts.data[source.part].first_joint;
    Influence influence = influences.data[parts.data[source.part].first_influence + source.object_vertex -
                                          parts.data[source.part].first_object_vertex];
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

  vec3 last = params.first_frame != 0 ? position : vertices.data[index].position_material.xyz;
  previous_positions.data[index] = vec4(last, 1.0);
  vertices.data[index].position_material = vec4(position, uintBitsToFloat(part.material));
  vertices.data[index].normal_u = vec4(normal, v.u);
  vertices.data[index].v_uv1 = vec4(v.v, v.uv1.xy, part.handedness);
}
