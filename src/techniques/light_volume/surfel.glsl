// Finding and unpacking surfels. The including kernel declares `table`, see surfel_types.h.
#ifndef LIGHTWELL_SURFEL_GLSL
#define LIGHTWELL_SURFEL_GLSL

#include "shaders/hemisphere.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/random.glsl"

// Bit d: the cell has a surfel of direction d.
uint alive_directions(uint entry) { return (entry >> kTableAliveShift) & 63u; }

// Of a direction that is stored.
int stored_slot(uint entry, uint direction) {
  return int((entry >> kTableBaseShift) + bitCount(entry & ((1u << direction) - 1u)));
}

// Slot of a cell's surfel, or -1.
int surfel_slot(uint entry, uint direction) {
  return (alive_directions(entry) & (1u << direction)) == 0 ? -1 : stored_slot(entry, direction);
}

ivec3 key_cell(VoxelGrid grid, uint key) {
  uint index = key >> 3;
  uint row = index / grid.resolution.x;
  return ivec3(index % grid.resolution.x, row % grid.resolution.y, row / grid.resolution.y);
}

uint key_direction(uint key) { return key & 7u; }

// Three numbers in [0,1], 10 bits each.
uint pack_10(vec3 v) {
  uvec3 q = uvec3(clamp(v, 0.0, 1.0) * 1023.0 + 0.5);
  return q.x | (q.y << 10) | (q.z << 20);
}

vec3 unpack_10(uint v) {
  return vec3(v & 1023u, (v >> 10) & 1023u, (v >> 20) & 1023u) / 1023.0;
}

// 11 bits for red and green, 10 for blue.
uint pack_albedo(vec3 albedo) {
  uvec3 q = uvec3(clamp(albedo, 0.0, 1.0) * vec3(2047.0, 2047.0, 1023.0) + 0.5);
  return q.x | (q.y << 11) | (q.z << 22);
}

vec3 unpack_albedo(uint v) {
  return vec3(v & 2047u, (v >> 11) & 2047u, v >> 22) / vec3(2047.0, 2047.0, 1023.0);
}

uint pack_direction(vec3 v, float levels, uint bits) {
  uvec2 q = uvec2((to_octahedron(v) * 0.5 + 0.5) * levels + 0.5);
  return q.x | (q.y << bits);
}

vec3 unpack_direction(uint v, float levels, uint bits) {
  uint mask = (1u << bits) - 1u;
  return from_octahedron(vec2(v & mask, (v >> bits) & mask) / levels * 2.0 - 1.0);
}

// Point `index` of the plastic-number sequence (Roberts 2018), moved round the unit square by a hash of `seed`.
vec2 rotated_sample(uint seed, uint index) {
  uint h = hash_word(seed);
  vec2 rotation = vec2(h & 0xffffu, h >> 16) / 65536.0;
  return fract(rotation + 0.5 + float(index) * vec2(0.7548776662, 0.5698402910));
}

// Another frame than frame_about(): with that, every surfel would trace other rays, and all noise would be other noise.
mat3 surfel_frame(vec3 normal) {
  vec3 tangent = normalize(abs(normal.x) > 0.5 ? cross(normal, vec3(0, 1, 0)) : cross(normal, vec3(1, 0, 0)));
  return mat3(tangent, cross(normal, tangent), normal);
}

// Cosine-distributed. Radius and angle of the disk's point, and not disk_point(): to move points round the square, as
// rotated_sample() does, then turns their directions about the normal.
vec3 surfel_direction(vec3 normal, vec2 u) {
  float angle = 2.0 * kPi * u.y;
  return cosine_direction(surfel_frame(normal), sqrt(u.x) * vec2(cos(angle), sin(angle)));
}

#endif
