// Irradiance at each pixel from the light that the cells around it have received. Mavridis et al. 2010, section 3.3.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/sh.glsl"
#include "techniques/light_volume/paper_types.h"

// Off for light propagation volumes (Kaplanyan 2009): all eight cells count, half a cell in front of the surface.
layout(constant_id = 0) const uint occlusion = 1;

layout(local_size_x = 8, local_size_y = 8) in;

LW_PUSH_CONSTANTS(PaperLookupParams, LW_PAPER_LOOKUP_PARAMS)

layout(set = 0, binding = 0) readonly buffer CellBuffer { vec4 data[]; } cells;  // normal; w: 1 if occupied, 0 if void
layout(set = 0, binding = 1) readonly buffer ReceivedBuffer { float data[]; } received;
layout(set = 0, binding = 2) uniform sampler2D positions;  // w = 0: no surface
layout(set = 0, binding = 3) uniform sampler2D normals;
layout(set = 0, binding = 4, rgba32f) uniform writeonly image2D irradiance;

vec4 received_light(uint index, uint channel) {
  uint plane = paper_plane_stride(params.grid.cell_count);
  uint at = 4u * channel * plane + index;
  return vec4(received.data[at], received.data[at + plane], received.data[at + 2u * plane], received.data[at + 3u * plane]);
}

// E = integral of L(w) max(0, -n.w) dw over directions of travel w (Eq. 3.3.2), L interpolated between those of the
// eight nearest cells that are occupied.
vec3 interpolated_irradiance(vec3 position, vec3 normal) {
  vec3 from_center = grid_coordinates(params.grid, position) - 0.5;
  ivec3 first = ivec3(floor(from_center));
  vec3 fraction = from_center - vec3(first);
  vec4 falling = sh_cosine_lobe(-normal);
  vec3 sum = vec3(0.0);
  float weight_sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    ivec3 offset = ivec3(corner & 1, (corner >> 1) & 1, corner >> 2);
    ivec3 cell = first + offset;
    if (!grid_contains(params.grid, cell)) continue;
    uint index = grid_cell_index(params.grid, cell);
    if (occlusion != 0 && cells.data[index].w == 0.0) continue;
    vec3 weights = mix(1.0 - fraction, fraction, vec3(offset));
    float weight = weights.x * weights.y * weights.z;
    weight_sum += weight;
    for (uint channel = 0; channel < 3; ++channel) sum[channel] += weight * dot(received_light(index, channel), falling);
  }
  return weight_sum > 0.0 ? max(sum / weight_sum, vec3(0.0)) : vec3(0.0);
}

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, params.size))) return;
  vec4 position = texelFetch(positions, ivec2(pixel), 0);
  vec3 light = vec3(0.0);
  if (position.w != 0.0) {
    vec3 normal = texelFetch(normals, ivec2(pixel), 0).xyz;
    float offset = occlusion != 0 ? 0.0 : 0.5 * params.grid.cell_size;
    light = interpolated_irradiance(position.xyz + offset * normal, normal);
  }
  imageStore(irradiance, ivec2(pixel), vec4(light, 0.0));
}
