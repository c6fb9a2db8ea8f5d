// One emissive triangle each: what sampling it needs, and its power.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/emitters/emitters_params.h"
#include "passes/emitters/emitters_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 7) readonly buffer ListBuffer { uint data[]; } emissive_triangles;
layout(set = 0, binding = 8) writeonly buffer EmitterBuffer { EmissiveTriangle data[]; } emitters;

#include "shaders/geometry.glsl"
#include "shaders/linear_dispatch.glsl"
#include "shaders/luminance.glsl"
#include "shaders/material.glsl"

// Mean luminance over 16 points, each for the part of the texture round it. The least part of it that a triangle is
// given keeps one alive whose light the points have missed.
float mean_luminance(GpuMaterial material, Triangle t) {
  const float kLeastPart = 0.01;
  float factor = luminance(material.emission.xyz);
  if (material.emission_texture == kNoTexture) return factor;
  vec4 origin = vertex_uv(t.v[0]);
  vec4 step_1 = 0.25 * (vertex_uv(t.v[1]) - origin);
  vec4 step_2 = 0.25 * (vertex_uv(t.v[2]) - origin);
  float sum = 0.0;
  // Centres of 16 equal parts: in every row, upright and inverted ones by turns.
  for (int row = 0; row < 4; ++row) {
    for (int part = 0; part < 7 - 2 * row; ++part) {
      vec2 place = vec2(part / 2, row) + ((part & 1) != 0 ? 2.0 / 3.0 : 1.0 / 3.0);
      sum += luminance(emitted_radiance(material, origin + place.x * step_1 + place.y * step_2, step_1, step_2, true));
    }
  }
  return max(sum / 16.0, kLeastPart * factor);
}

void main() {
  uint index = linear_invocation();
  if (index >= params.count) return;
  uint triangle = emissive_triangles.data[index];
  Triangle t = load_triangle(triangle);
  GpuMaterial material = scene_material(vertex_material(t.v[0]));
  bool mirrored = vertex_handedness(t.v[0]) < 0.0;
  bool looks_up = material.emission_texture != kNoTexture || material.alpha_cutoff > 0.0;

  EmissiveTriangle emitter;
  emitter.corner = vertex_position(t.v[0]);
  emitter.edge_1 = vertex_position(t.v[mirrored ? 2 : 1]) - emitter.corner;
  emitter.edge_2 = vertex_position(t.v[mirrored ? 1 : 2]) - emitter.corner;
  emitter.triangle = triangle;
  emitter.luminance = mean_luminance(material, t);
  emitter.power_so_far = 0.5 * length(cross(emitter.edge_1, emitter.edge_2)) * emitter.luminance;
  emitter.emission = material.emission.xyz;
  emitter.flags = (material.emission.w != 0.0 ? kEmitsFromBothSides : 0) | (mirrored ? kEmitterMirrored : 0) |
                  (looks_up ? kEmitterLooksUp : 0);
  emitters.data[index] = emitter;
}
