// One step of radiance propagation: every cell gathers what its six neighbours send through the shared faces.
// Mavridis et al. 2010, section 3.2. A void cell passes the light on in the next step; an occupied cell adds it to what
// it has received so far and reflects it.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/sh.glsl"
#include "techniques/light_volume/paper_types.h"

// Off for light propagation volumes (Kaplanyan 2009): no cell blocks or reflects, and every cell accumulates.
layout(constant_id = 0) const uint occlusion = 1;

layout(local_size_x = 32, local_size_y = 2) in;

LW_PUSH_CONSTANTS(PaperPropagateParams, LW_PAPER_PROPAGATE_PARAMS)

layout(set = 0, binding = 0) readonly buffer CellBuffer { vec4 data[]; } cells;  // normal; w: 1 if occupied, 0 if void
layout(set = 0, binding = 1) readonly buffer SourceBuffer { float data[]; } source;
layout(set = 0, binding = 2) buffer TargetBuffer { float data[]; } target;
layout(set = 0, binding = 3) buffer ReceivedBuffer { float data[]; } received;

// Where light that travels along an axis comes from: index of the neighbour and 1, or anything and 0 at the grid's edge.
struct Neighbour {
  uint index;
  float inside;
};

Neighbour neighbour(ivec3 cell, ivec3 offset) {
  ivec3 other = cell + offset;
  bool inside = grid_contains(params.grid, other);
  return Neighbour(grid_cell_index(params.grid, inside ? other : cell), inside ? 1.0 : 0.0);
}

// The light that arrives along one axis from both neighbours on it: radiance `forward` travels up the axis, `backward`
// down, each averaged over the solid angle |W| of the face that it came through,
//   dot(L, T) / |W|,  T = sh_cube_face(+-axis).
// Mavridis et al. 2010, Eq. 3.2.2, has the integral without 1/|W|: taken literally, the light in void grows |W| = 2.09
// times a step. With it, a cell's six averages times |W| sum to its integral over the sphere (the six T sum to 1), so
// that no light is lost or made. An average may be negative and stays so: the sum needs it.
vec2 arriving(Neighbour below, Neighbour above, uint channel, uint axis) {
  const float constant_part = kShY0;
  const float linear_part = kShY1 * kShFaceMoment / kShFaceSolidAngle;
  uint stride = paper_plane_stride(params.grid.cell_count);
  uint plane_0 = 4u * channel * stride;
  uint plane_1 = plane_0 + (1u + axis) * stride;
  float forward = constant_part * source.data[plane_0 + below.index] + linear_part * source.data[plane_1 + below.index];
  float backward = constant_part * source.data[plane_0 + above.index] - linear_part * source.data[plane_1 + above.index];
  return vec2(below.inside * forward, above.inside * backward);
}

void main() {
  ivec3 cell = ivec3(gl_GlobalInvocationID);
  if (!grid_contains(params.grid, cell)) return;
  uint index = grid_cell_index(params.grid, cell);

  Neighbour below[3];
  Neighbour above[3];
  for (int axis = 0; axis < 3; ++axis) {
    ivec3 offset = ivec3(axis == 0, axis == 1, axis == 2);
    below[axis] = neighbour(cell, -offset);
    above[axis] = neighbour(cell, offset);
  }

  vec4 light[3];
  for (uint channel = 0; channel < 3; ++channel) {
    vec2 x = arriving(below[0], above[0], channel, 0);
    vec2 y = arriving(below[1], above[1], channel, 1);
    vec2 z = arriving(below[2], above[2], channel, 2);
    // Eq. 3.2.3 summed over the six neighbours: sum of T * average, with T = sh_lobe(+-axis, |W|, moment).
    float total = x.x + x.y + y.x + y.y + z.x + z.y;
    light[channel] = vec4(kShY0 * kShFaceSolidAngle * total,
                          kShY1 * kShFaceMoment * vec3(x.x - x.y, y.x - y.y, z.x - z.y));
  }

  uint stride = paper_plane_stride(params.grid.cell_count);
  bool occupied = occlusion != 0 && cells.data[index].w != 0.0;
  bool receives = occlusion == 0 || occupied;
  if (receives) {
    for (uint channel = 0; channel < 3; ++channel) {
      for (uint k = 0; k < 4; ++k) {
        received.data[(4u * channel + k) * stride + index] += light[channel][k];
      }
    }
  }
  if (occupied) {
    // Light is stored by the direction in which it travels: what falls on the surface goes against its normal.
    vec3 normal = cells.data[index].xyz;
    vec4 falling = sh_cosine_lobe(-normal);
    vec4 leaving = (params.reflectance / kPi) * sh_hemisphere(normal);
    for (uint channel = 0; channel < 3; ++channel) light[channel] = dot(light[channel], falling) * leaving;
  }
  for (uint channel = 0; channel < 3; ++channel) {
    for (uint k = 0; k < 4; ++k) {
      target.data[(4u * channel + k) * stride + index] = light[channel][k];
    }
  }
}
