// Which tiles a splat may light. The kernel declares params, splats, counts, bounds and tiles.
#ifndef LIGHTWELL_SPLAT_COVER_GLSL
#define LIGHTWELL_SPLAT_COVER_GLSL

#include "shaders/hemisphere.glsl"
#include "shaders/light_point.glsl"
#include "techniques/photon_splatting/splat_rules.glsl"

layout(constant_id = 0) const uint kEstimate = kEstimateDensity;

// A splat and a tile that its bounds hold.
struct SplatVisit {
  uint id;
  uint last;  // splat of the part, that the visits end with
  uint step;  // to the next splat: 1 or -1
  uvec2 low;  // bounds, tiles
  uvec2 high;
  uvec2 tile;
};

uvec2 tile_of(uint packed) { return uvec2(packed & 0xffffu, packed >> 16); }

// At the first tile of splat `id`. One that is nowhere has one visit, to a tile that does not count.
void enter_splat(inout SplatVisit visit, uint id) {
  SplatBounds seen = bounds.data[id];
  visit.id = id;
  visit.low = visit.tile = tile_of(seen.low);
  visit.high = tile_of(seen.high);
}

// Of a part's splats, the first or the last. False where it has none.
bool begin_visits(uint part, bool forwards, out SplatVisit visit) {
  uint count = min(counts.data[0], uint(bounds.data.length()));
  uint each = (count + params.parts - 1) / params.parts;
  uint begin = min(part * each, count);
  uint end = min(begin + each, count);
  visit.last = forwards ? end - 1 : begin;
  visit.step = forwards ? 1 : 0xffffffffu;
  enter_splat(visit, min(forwards ? begin : end - 1, count));
  return part < params.parts && begin < end;
}

// All tiles of all splats in one loop: invocations side by side have as many rounds as the longest of them.
bool next_visit(inout SplatVisit visit) {
  bool next_row = visit.tile.x >= visit.high.x;
  bool next_splat = next_row && visit.tile.y >= visit.high.y;
  bool ends = next_splat && visit.id == visit.last;
  visit.tile = next_row ? uvec2(visit.low.x, visit.tile.y + 1) : visit.tile + uvec2(1, 0);
  if (next_splat && !ends) enter_splat(visit, visit.id + visit.step);
  return !ends;
}

// Whether the splat's box may hold one of the tile's surfaces, and light it.
bool may_light(SplatVisit visit) {
  if (visit.low.x > visit.high.x) return false;
  Splat splat = splat_at(visit.id);
  SplatBounds seen = bounds.data[visit.id];
  SplatTile tile = tiles.data[visit.tile.y * params.tiles.x + visit.tile.x];
  mat3 frame = frame_about(splat.direction);
  float per_depth = float(kSplatSlabs) / max(tile.farthest - tile.nearest, 1e-30);
  vec2 slabs = clamp((vec2(seen.nearest, seen.farthest) - tile.nearest) * per_depth, 0.0, float(kSplatSlabs - 1));
  uint first = uint(slabs.x);
  uint covered = (0xffffffffu >> (31u - uint(slabs.y) + first)) << first;

  vec3 offset = abs((0.5 * (tile.low + tile.high) - splat.center) * frame);
  vec3 extent = 0.5 * (tile.high - tile.low);
  vec3 room = vec3(dot(abs(frame[0]), extent), dot(abs(frame[1]), extent), dot(abs(frame[2]), extent)) +
              1.0001 * vec3(splat.half_width, splat.half_width, splat.reach);

  bool lights = seen.farthest >= tile.nearest && seen.nearest <= tile.farthest && (tile.slabs & covered) != 0 &&
                all(lessThanEqual(offset, room));
  // A splat of a density lights surfaces like the one that it ends on only.
  vec3 normal = unpack_unit_vector(splat.normal);
  if (kEstimate == kEstimateDensity) lights = lights && cone_meets(tile.axis, tile.cosine, normal, kLeastLikeness);
  return lights;
}

#endif
