// Faces send rays: from a point on its surface each sends a shadow ray to a source of light and a cosine-distributed ray,
// and remembers what that has met.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lights.h"
#include "techniques/ray_traced_voxels/cache_types.h"

layout(local_size_x = 64) in;

#include "shaders/trace.glsl"

#include "techniques/ray_traced_voxels/cache_rays.glsl"

layout(constant_id = 3) const bool kFromLights = false;
layout(set = 0, binding = 9) buffer FaceLightBuffer { FaceLight data[]; } face_light;
layout(set = 0, binding = 10) readonly buffer KeyBuffer { uint data[]; } keys;
layout(set = 0, binding = 11) readonly buffer ListBuffer { uint data[]; } list;
layout(set = 0, binding = 12) writeonly buffer LinkBuffer { uvec2 data[]; } links;

#include "shaders/linear_dispatch.glsl"
#include "shaders/normal_direction.glsl"
#include "techniques/ray_traced_voxels/cache_link.glsl"

vec3 axis_of(uint direction) {
  vec3 axis = vec3(0.0);
  axis[direction >> 1] = (direction & 1u) == 0 ? 1.0 : -1.0;
  return axis;
}

// The surface beside the voted point, as it is in this frame: a short ray down the face's axis looks for it.
bool find_surface(FaceLight light, uint key, out Surface surface) {
  const float kReach = 4.0 / 256.0;  // cells: the vote's rounding, on surfaces that lean by up to 55 degrees
  vec3 axis = axis_of(key & 7u);
  VoxelGrid grid = level_grid(params.levels, level_of_index(params.levels, key >> 3));
  vec3 place = vec3(level_cell_at(params.levels, key >> 3)) + place_of_vote(light.vote) + kReach * axis;
  RayHit hit = trace_closest(Ray(grid.origin + place * grid.cell_size, 0.0, -axis, 2.0 * kReach * grid.cell_size));
  if (hit.triangle == kNoTriangle) return false;
  surface = surface_at(hit, -axis);
  return normal_direction(surface.face_normal) == (key & 7u);
}

// W/m^2 that a ray finds of an emitter and shadow rays leave out.
vec3 near_emitter(Surface there, float distance, vec3 direction, float cosine) {
  float factor_luminance = luminance(scene_material(there.material).emission.xyz);
  return there.emission * (kPi * left_to_cosine_rays(factor_luminance, kEmitterShare, distance, cosine,
                                                     -dot(there.face_normal, direction)));
}

void main() {
  uint index = linear_invocation();
  if (index >= list.data[kListCount]) return;
  uint face = list.data[kListHeader + index];
  FaceLight light = face_light.data[face];
  uint key = keys.data[face];
  Surface surface;
  if (!find_surface(light, key, surface)) return;

  Receiver receiver = receiver_at(surface);
  uvec2 seed = uvec2(key & 0xffffu, key >> 16);
  if (!kFromLights) inject(face, direct_at(receiver, seed, params.frame, 1));

  vec3 direction = cosine_direction(frame_about(receiver.normal), disk_point(stratified_point(seed, params.frame, 0)));
  uvec2 link = make_link(kLinkEscaped, vec3(0.0));
  vec3 near = vec3(0.0);
  float cosine = cosine_above(receiver, direction);
  if (cosine > 0.0) {
    RayHit hit = trace_closest(Ray(receiver.start, 0.0, direction, kFarAway));
    if (hit.triangle != kNoTriangle) {
      Surface there = surface_at(hit, direction);
      if (kEmitters && !kFromLights) near = near_emitter(there, hit.t, direction, cosine);
      uint level;
      uint met = face_at(params.levels, there.position, there.face_normal, kFootprint * hit.t, level);
      link = make_link(met == kNoFace ? kLinkUnknown : keys.data[met] + 1, there.albedo);
      if (met != kNoFace) {
        vote(met, level, there.position, bounces_of_vote(light.vote) + 1, key ^ params.frame * 0x9e3779b9u);
      }
    }
  }
  light.gathered = min(light.gathered + 1.0, params.most_gathered);
  float weight = face_weight(1.0, light.gathered);
  face_light.data[face].near = mix(light.near, near, weight);
  face_light.data[face].gathered = light.gathered;
  links.data[light.links % params.link_count * params.capacity + face] = link;
  face_light.data[face].links = light.links + 1;
}
