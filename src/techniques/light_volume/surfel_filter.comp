// What pixels will read. Every surfel has its own set of rays, so the errors of neighbours differ: averaging over the
// neighbours that it sees on the same surface uses nine sets instead of one.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/light_volume/surfel_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer TableBuffer { uint data[]; } table;
layout(set = 0, binding = 2) readonly buffer SurfelBuffer { Surfel data[]; } surfels;
layout(set = 0, binding = 3) readonly buffer SummaryBuffer { LinkSummary data[]; } summaries;
layout(set = 0, binding = 4) readonly buffer IrradianceBuffer { vec4 data[]; } irradiance;
layout(set = 0, binding = 5) writeonly buffer LitBuffer { LitSurfel data[]; } lit;

#include "shaders/linear_dispatch.glsl"
#include "techniques/light_volume/surfel.glsl"

// By distance (half the weight at 1.8 cells), by angle, and by how far each lies off the plane of the other.
float neighbour_weight(vec3 offset, vec3 normal, vec3 other_normal) {
  float cosine = max(0.0, dot(normal, other_normal));
  float cosine_8 = cosine * cosine * cosine * cosine;
  cosine_8 *= cosine_8;
  float off_plane = abs(dot(offset, normal)) + abs(dot(offset, other_normal));
  return cosine_8 * max(0.0, 1.0 - off_plane) * exp2(-0.3 * dot(offset, offset));
}

// What pixels near the surfel are to get of its light.
vec3 pixel_irradiance(uint slot) {
  vec3 sources = summaries.data[slot].from_sources;
  return max(irradiance.data[slot].xyz - (params.bounced_only != 0 ? sources : vec3(0.0)), vec3(0.0));
}

void main() {
  uint slot = linear_invocation();
  if (slot >= counts.data[kCountSurfels]) return;
  vec3 position = surfels.data[slot].position;
  vec3 normal = surfels.data[slot].normal;
  uint key = surfels.data[slot].key;
  uint neighbours = summaries.data[slot].neighbours;
  ivec3 cell = key_cell(params.grid, key);

  vec4 sum = vec4(0.0);
  uint left = neighbours;
  while (left != 0) {
    uint i = uint(findLSB(left));
    left &= left - 1u;
    ivec3 other = cell + ivec3(i % 3, i / 3 % 3, i / 9) - 1;
    int other_slot = stored_slot(table.data[grid_cell_index(params.grid, other)], key_direction(key));
    vec3 offset = surfels.data[other_slot].position - position;
    float weight =
        neighbour_weight(offset, normal, surfels.data[other_slot].normal) * summaries.data[other_slot].validity;
    sum += weight * vec4(pixel_irradiance(uint(other_slot)), 1.0);
  }
  LitSurfel result;
  result.irradiance = sum.w > 0.0 ? sum.xyz / sum.w : pixel_irradiance(slot);
  result.validity = summaries.data[slot].validity;
  result.position = pack_10(position - vec3(cell));
  result.normal = normal == vec3(0.0) ? 0 : pack_direction(normal, 65535.0, 16);
  result.neighbours = neighbours;
  result.unused = 0;
  lit.data[slot] = result;
}
