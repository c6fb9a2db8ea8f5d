// Irradiance at any place, from the surfels of the cells round it. The including kernel declares
//   layout(set = 0, binding = n) readonly buffer TableBuffer { uint data[]; } table;
//   layout(set = 0, binding = n) readonly buffer LitBuffer { LitSurfel data[]; } lit;
//   layout(set = 0, binding = n) uniform sampler2D environment;
#ifndef LIGHTWELL_SURFEL_LOOKUP_GLSL
#define LIGHTWELL_SURFEL_LOOKUP_GLSL

#include "shaders/environment.glsl"
#include "techniques/light_volume/surfel.glsl"
#include "techniques/light_volume/surfel_home.glsl"

const uint kAllNeighbours = 0x7ffffffu;
const float kUsableValidity = 0.1;  // least validity of a surfel whose list of neighbours counts
const float kEnough = 1e-3;         // least weight of surfels that are not searched for further away

// The three directions that a normal leans to, one bit each; without those that it hardly does.
uint leaning_directions(vec3 n) {
  uint bits = 0;
  for (uint axis = 0; axis < 3; ++axis)
    if (abs(n[axis]) > 0.05) bits |= 1u << (2 * axis + (n[axis] < 0.0 ? 1 : 0));
  return bits;
}

// Weighted sum over a cell's surfels: xyz irradiance, w weight. A surfel counts by angle to the pixel's normal and by
// how far the pixel lies off its plane.
vec4 add_cell(ivec3 cell, uint directions, vec3 point, vec3 n) {
  vec4 sum = vec4(0.0);
  uint entry = grid_contains(params.grid, cell) ? table.data[grid_cell_index(params.grid, cell)] : 0;
  uint left = alive_directions(entry) & directions;
  while (left != 0) {
    LitSurfel surfel = lit.data[stored_slot(entry, uint(findLSB(left)))];
    left &= left - 1u;
    vec3 surfel_normal = unpack_direction(surfel.normal, 65535.0, 16);
    float cosine = max(0.0, dot(n, surfel_normal) - 0.1);
    float off_plane = abs(dot(point - vec3(cell) - unpack_10(surfel.position), surfel_normal));
    float weight = cosine * cosine * cosine * cosine * max(0.0, 1.0 - off_plane) * surfel.validity;
    sum += weight * vec4(surfel.irradiance, 1.0);
  }
  return sum;
}

// Trilinear over the eight nearest cells, those that the home surfel does not see left out.
vec4 add_nearest(uint directions, vec3 point, vec3 n) {
  ivec3 home;
  int slot = home_slot(point, n, home);
  uint seen = slot >= 0 && lit.data[slot].validity > kUsableValidity ? lit.data[slot].neighbours : kAllNeighbours;
  ivec3 base = ivec3(floor(point - 0.5));
  vec3 f = point - 0.5 - vec3(base);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 8; ++i) {
    ivec3 corner = ivec3(i & 1, (i >> 1) & 1, i >> 2);
    ivec3 cell = base + corner;
    ivec3 offset = cell - home + 1;
    bool is_seen = (seen & (1u << (offset.x + 3 * offset.y + 9 * offset.z))) != 0;
    vec3 w = mix(1.0 - f, f, vec3(corner));
    sum += (w.x * w.y * w.z + 1e-4) * add_cell(cell, is_seen ? directions : 0, point, n);
  }
  return sum;
}

// The 64 cells round the pixel, nearer ones more.
vec4 add_wide(uint directions, vec3 point, vec3 n) {
  ivec3 base = ivec3(floor(point - 0.5)) - 1;
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 64; ++i) {
    ivec3 cell = base + ivec3(i & 3, (i >> 2) & 3, i >> 4);
    vec3 w = max(1.0 - abs(vec3(cell) + 0.5 - point) / 2.0, 0.0);
    sum += w.x * w.y * w.z * add_cell(cell, directions, point, n);
  }
  return sum;
}

// Where the grid knows nothing: what the environment would give to an open surface.
vec3 open_irradiance(vec3 n) {
  const uint kRays = 8;
  vec3 sum = vec3(0.0);
  for (uint i = 0; i < (params.bounced_only != 0 ? 0 : kRays); ++i)
    sum += environment_radiance(surfel_direction(n, rotated_sample(0, i)));
  return sum * kPi / float(kRays);
}

// W/m^2, at a world position on a surface with the unit normal `n`.
vec3 look_up(vec3 position, vec3 n) {
  vec3 point = grid_coordinates(params.grid, position);
  uint directions = leaning_directions(n);
  vec4 sum = add_nearest(directions, point, n);
  if (sum.w < kEnough) sum += add_wide(directions, point, n);
  return sum.w > 0.0 ? sum.xyz / sum.w : open_irradiance(n);
}

#endif
