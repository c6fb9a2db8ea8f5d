// Turns the sums of surfel_accumulate.comp into surfels.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxelize/voxelize_types.h"
#include "techniques/light_volume/surfel_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer CountBuffer { uint data[]; } counts;
layout(set = 0, binding = 1) readonly buffer SumBuffer { uint data[]; } sums;
layout(set = 0, binding = 2) readonly buffer CellBuffer { uint data[]; } cells;
layout(set = 0, binding = 3) buffer TableBuffer { uint data[]; } table;
layout(set = 0, binding = 4) buffer SurfelBuffer { Surfel data[]; } surfels;

#include "passes/voxelize/cut_by_box.glsl"
#include "shaders/linear_dispatch.glsl"
#include "techniques/light_volume/surfel.glsl"

vec3 read_sum(uint first, float scale) {
  return vec3(sums.data[first], sums.data[first + 1], sums.data[first + 2]) * scale;
}

vec3 read_signed_sum(uint first, float scale) {
  return vec3(int(sums.data[first]), int(sums.data[first + 1]), int(sums.data[first + 2])) * scale;
}

// How far the surface reaches beyond the plane through its centroid, along the direction's axis: more than the
// plane's own slope explains where there are several layers, a rug on a floor or the steps of a stair.
float outer_layer(vec3 position, vec3 normal, vec3 low, vec3 high, uint direction) {
  uint axis = direction / 2;
  uint b = (axis + 1) % 3;
  uint c = (axis + 2) % 3;
  float sign = (direction & 1u) == 0 ? 1.0 : -1.0;
  float top = sign > 0.0 ? high[axis] - position[axis] : position[axis] - low[axis];
  vec3 reach = max(high - position, position - low);
  float slope = (abs(normal[b]) * reach[b] + abs(normal[c]) * reach[c]) / abs(normal[axis]);
  return sign * max(0.0, top - slope);
}

void main() {
  uint slot = linear_invocation();
  if (slot >= counts.data[kCountSurfels]) return;
  Surfel surfel = surfels.data[slot];
  uint direction = key_direction(surfel.key);
  uint base = slot * kSumWords;
  uint weight = sums.data[base + kSumWeight];
  vec3 normal = read_signed_sum(base + kSumNormal, 1.0);

  if (weight == 0 || normal == vec3(0.0)) {
    // Only pieces without an area: the triangle touches the cell from outside.
    surfel.normal = vec3(0.0);
    surfels.data[slot] = surfel;
    atomicAnd(table.data[surfel.key >> 3], ~(1u << (kTableAliveShift + direction)));
    return;
  }

  float scale = 1.0 / float(weight);
  vec3 corner = vec3(key_cell(params.grid, surfel.key));
  vec3 position = clamp(read_sum(base + kSumPosition, scale), 0.0, 1.0);
  vec3 low = 1.0 - read_sum(base + kSumBoundsLow, 1.0 / 65536.0);
  vec3 high = read_sum(base + kSumBoundsHigh, 1.0 / 65536.0);

  surfel.normal = normalize(normal);
  // The outermost of several layers is the one that is lit and seen.
  position[direction / 2] += outer_layer(position, surfel.normal, low, high, direction);
  surfel.position = corner + position;
  surfel.albedo = pack_albedo(read_sum(base + kSumAlbedo, scale));
  surfel.bounds_low = pack_10(low);
  surfel.bounds_high = pack_10(high);
  surfel.is_front = (cells.data[surfel.key >> 3] >> direction) & 1u;
  // What the plane would cover inside the bounds if the surface had no gaps. Nearly closed surfaces are closed: what
  // is missing is rounding, or roughness.
  float full_area = cut_plane(position, surfel.normal, low - 1e-3, high + 1e-3).area;
  float opacity = float(weight) / kSumScale / max(full_area, 1e-9);
  surfel.opacity = opacity > 0.9 ? 1.0 : opacity;
  // A lamp just below a ceiling: two layers of which one emits still emit all that one does.
  surfel.area = min(float(weight) / kSumScale, full_area);
  surfel.emission = read_sum(base + kSumEmission, params.emission_scale / (kSumScale * max(surfel.area, 1e-9)));
  surfels.data[slot] = surfel;
}
