// Faces send rays: from a point on its surface each sends a shadow ray to a source of light and a cosine-distributed ray,
// and remembers what that has met.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lights.h"
#include "passes/light_cache/cache_types.h"

layout(local_size_x = 64) in;

#include "shaders/trace.glsl"

#include "passes/light_cache/cache_rays.glsl"

layout(constant_id = 3) const bool kFromLights = false;
layout(set = 0, binding = 9) buffer FaceLightBuffer { FaceLight data[]; } face_light;
layout(set = 0, binding = 10) readonly buffer KeyBuffer { uint data[]; } keys;
layout(set = 0, binding = 11) readonly buffer ListBuffer { uint data[]; } list;
layout(set = 0, binding = 12) buffer LinkBuffer { FaceLink data[]; } links;
layout(set = 0, binding = 13) buffer PageCountBuffer { uint data[]; } page_counts;
layout(set = 0, binding = 14) readonly buffer FreePageBuffer { uint data[]; } free_pages;

#include "shaders/light_point.glsl"
#include "shaders/linear_dispatch.glsl"
#include "shaders/normal_direction.glsl"
#include "passes/light_cache/cache_link.glsl"
#include "passes/light_cache/cache_page_group.glsl"

vec3 axis_of(uint direction) {
  vec3 axis = vec3(0.0);
  axis[direction >> 1] = (direction & 1u) == 0 ? 1.0 : -1.0;
  return axis;
}

// Whether faces look for those neighbours of theirs that nothing stands between. With so many links they have looked for
// all, and go on with one in a frame.
layout(constant_id = 4) const bool kSeesNeighbours = false;
const uint kLinksUntilSeen = 54;

uvec2 seed_of(uint key) { return uvec2(key & 0xffffu, key >> 16); }

uint direct_point(FaceLight light) { return light.met != 0 ? light.met : light.vote; }

// The surface beside the voted point, as it is in this frame: a short ray down the face's axis looks for it.
bool find_surface(uint point, uint key, out Surface surface) {
  const float kReach = 4.0 / 256.0;  // cells: the vote's rounding, on surfaces that lean by up to 55 degrees
  vec3 axis = axis_of(key & 7u);
  VoxelGrid grid = level_grid(params.levels, level_of_index(params.levels, key >> 3));
  vec3 place = vec3(level_cell_at(params.levels, key >> 3)) + place_of_vote(point) + kReach * axis;
  RayHit hit = trace_closest(Ray(grid.origin + place * grid.cell_size, 0.0, -axis, 2.0 * kReach * grid.cell_size));
  if (hit.triangle == kNoTriangle) return false;
  surface = surface_at(hit, -axis);
  return normal_direction(surface.face_normal) == (key & 7u);
}

// Bit `number` of the neighbours that are seen: from above one point to the other, and hardly above it, since there may
// be a wall close by.
uint look_for_neighbour(uint face, uint key, uint number, Surface surface, uint seen) {
  const float kLift = 0.1;        // cells
  const float kOtherLift = 0.02;  // more than the vote's rounding
  uint level = level_of_index(params.levels, key >> 3);
  VoxelGrid grid = level_grid(params.levels, level);
  ivec3 cell = level_cell_at(params.levels, key >> 3) + ivec3(number % 3, number / 3 % 3, number / 9) - 1;
  uint other = kNoFace;
  if (grid_contains(grid, cell)) other = face_slot(face_table.data[level_cell_index(params.levels, level, cell)], key & 7u);
  bool is_seen = other != kNoFace && face_light.data[other].vote != 0;
  if (is_seen) {
    vec3 axis = grid.cell_size * axis_of(key & 7u);
    vec3 start = surface.position + kLift * axis;
    vec3 line = grid.origin + (vec3(cell) + place_of_vote(face_light.data[other].vote)) * grid.cell_size + kOtherLift * axis - start;
    float distance = length(line);
    is_seen = !is_blocked(Ray(start, 0.0, line / max(distance, 1e-20), distance));
  }
  return is_seen ? seen | 1u << number : seen & ~(1u << number);
}

// W/m^2 that a ray finds of an emitter and shadow rays leave out.
vec3 near_emitter(Surface there, float distance, vec3 direction, float cosine) {
  float factor_luminance = luminance(scene_material(there.material).emission.xyz);
  return there.emission * (kPi * left_to_cosine_rays(factor_luminance, kEmitterShare, distance, cosine,
                                                     -dot(there.face_normal, direction)));
}

// And gets none in this round.
bool lacks_page(uint face) {
  return page_group(keys.data[face]) >= page_counts.data[kPagesGranted] && face_light.data[face].page == 0;
}

// A cosine-distributed ray: what it says of emitters near by goes into `near`, what it meets is the link. Number `index`
// of the face's rays.
uvec2 find_link(Receiver receiver, uint key, uint bounces, uint index, inout vec3 near) {
  uvec2 link = make_link(kLinkEscaped, vec3(0.0));
  vec3 direction =
      cosine_direction(frame_about(receiver.normal), disk_point(stratified_point(seed_of(key), index, 0)));
  float cosine = cosine_above(receiver, direction);
  if (cosine <= 0.0) return link;
  RayHit hit = trace_closest(Ray(receiver.start, 0.0, direction, kFarAway));
  if (hit.triangle == kNoTriangle) return link;
  Surface there = surface_at(hit, direction);
  if (kEmitters && !kFromLights) near += near_emitter(there, hit.t, direction, cosine);
  uint level;
  uint met = face_at(params.levels, there.position, there.face_normal, kFootprint * hit.t, level);
  if (met == kNoFace) return make_link(kLinkUnknown, there.albedo);
  // Where the finer levels' faces have no room to gather, a coarser one answers.
  uint levels = page_counts.data[kPagesShort] == 0 ? 0 : params.levels.count;
  for (uint next = level + 1; next < levels && lacks_page(met); ++next) {
    uint coarser = face_in_level(params.levels, next, there.position, there.face_normal);
    if (coarser == kNoFace) continue;
    met = coarser;
    level = next;
  }
  vote(met, kVoteMet, level, there.position, bounces, key ^ index * 0x9e3779b9u);
  return make_link(keys.data[met] + 1, there.albedo);
}

// What a link to a cell that has left its level's window since leads to now: the coarser cell that holds it.
uint coarser_link(uint to, ivec3 old_center) {
  uint index = (to - 1) >> 3;
  uint direction = (to - 1) & 7u;
  uint level = level_of_index(params.levels, index);
  VoxelLevels old = params.levels;
  old.center = old_center;
  ivec3 cell = level_cell_at(old, index) + level_lower(old, level);
  while (++level < params.levels.count) {
    cell >>= 1;
    ivec3 inside = cell - level_lower(params.levels, level);
    if (any(lessThan(inside, ivec3(0))) || any(greaterThanEqual(inside, ivec3(params.levels.resolution)))) continue;
    uint coarser = level_cell_index(params.levels, level, inside);
    if (face_slot(face_table.data[coarser], direction) != kNoFace) return (coarser << 3 | direction) + 1;
  }
  return kLinkUnknown;
}

// The word of a link's slot.
uint slot_of(uint word) {
  uint to = link_to(word);
  if (to == kLinkEscaped) return lead_to(word, kFallenEscaped);
  uint slot = to == kLinkUnknown ? kNoFace : face_slot(face_table.data[(to - 1) >> 3], (to - 1) & 7u);
  return lead_to(word, slot == kNoFace ? kFallenUnknown : kFallenFaces + slot);
}

// After slots changed: links to what has left its level's window lead to another face (the place in the table is another
// cell's), and all have new slots.
void follow_links(uint face, inout FaceLight light) {
  uint moves = params.count;
  uint count = light.page == 0 || light.moves == moves ? 0 : min(light.links, params.link_count);
  for (uint k = 0; k < count; ++k) {
    uint place = (light.page - 1) * params.link_count + k;
    uint word = links.data[place].met;
    uint to = link_to(word);
    bool is_face = to != kLinkEscaped && to != kLinkUnknown;
    if (light.center != params.levels.center && is_face && !is_same_cell(params.levels, light.center, (to - 1) >> 3)) {
      word = lead_to(word, coarser_link(to, light.center));
      links.data[place].met = word;
    }
    links.data[place].slot = slot_of(word);
  }
  light.center = params.levels.center;
  light.moves = moves;
  face_light.data[face].center = light.center;
  face_light.data[face].moves = moves;
}

// False where there are no pages.
bool take_page(uint key, inout FaceLight light) {
  if (light.page != 0) return true;
  if (page_group(key) >= page_counts.data[kPagesGranted]) return false;
  light.page = free_pages.data[atomicAdd(page_counts.data[kPagesFree], 0xffffffffu) - 1];
  light.links = 0;
  return true;
}

// What a face's old links have met must be awake to know its light. It gathers from where it did.
void ask_along(FaceLight light, uint key) {
  uint bounces = bounces_of_vote(light.vote) + 1;
  if (bounces >= kMostAsking) return;
  for (uint i = 0; i < params.asks; ++i) {
    uint ray = light.links + i;
    uint to = link_to(links.data[(light.page - 1) * params.link_count + ray % params.link_count].slot);
    if (to < kFallenFaces) continue;
    uint met = to - kFallenFaces;
    uint point = direct_point(face_light.data[met]);
    if (point != 0) vote_for_place(met, kVoteMet, point, bounces, key ^ ray * 0x9e3779b9u);
  }
}

void main() {
  uint index = linear_invocation();
  if (index >= list.data[kListCount]) return;
  uint face = list.data[kListHeader + index];
  FaceLight light = face_light.data[face];
  follow_links(face, light);
  bool is_young = light.page == 0 || light.links < params.link_count;
  if (params.rest > kAllSample && !is_young) return;
  uint key = keys.data[face];
  Surface surface;
  if (!find_surface(light.vote, key, surface) || !take_page(key, light)) return;

  Receiver receiver = receiver_at(surface);
  Surface met;
  Receiver sender = receiver;
  if (!kFromLights && light.met != 0 && find_surface(light.met, key, met)) sender = receiver_at(met);
  vec3 near = vec3(0.0);
  for (uint i = 0; i < (kFromLights ? 0 : params.rays); ++i)
    inject(face, direct_at(sender, seed_of(key), light.links + i, 1));
  if (!is_young) ask_along(light, key);
  bool sends_all = params.rest == kAllSend || is_young;
  uint sent = sends_all ? params.rays : 1;
  // One ray takes the place of the first of its round's in one cycle of all links, in the next that of the second, ...
  uint first = light.links + (sends_all ? 0 : light.links / params.link_count % params.rays);
  for (uint i = 0; i < sent; ++i) {
    uint ray = first + i;
    bool is_new = light.links < kLinksUntilSeen;
    uint neighbour = (is_new ? ray : light.links / params.rays) % 27;
    if (kSeesNeighbours && (is_new || i == 0))
      light.seen = look_for_neighbour(face, key, neighbour, surface, light.seen);
    uvec2 link = find_link(receiver, key, bounces_of_vote(light.vote) + 1, ray, near);
    uint place = (light.page - 1) * params.link_count + ray % params.link_count;
    links.data[place] = FaceLink(link.x, link.y, slot_of(link.x));
  }
  float rays = float(sent);
  light.gathered = min(light.gathered + rays, params.most_gathered);
  face_light.data[face].near = mix(light.near, near / rays, face_weight(rays, light.gathered));
  face_light.data[face].gathered = light.gathered;
  face_light.data[face].page = light.page;
  face_light.data[face].links = light.links + params.rays;
  face_light.data[face].normal = pack_unit_vector(surface.face_normal);
  face_light.data[face].seen = kSeesNeighbours ? light.seen : kAllNeighbours;
}
