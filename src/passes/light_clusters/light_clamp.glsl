// The least distance of light points: closer ones count as if they were so far away. Needs params.clamp_focus,
// clamp_part, clamp_nearest and clamp_farthest (light_clusters_types.h).
#ifndef LIGHTWELL_LIGHT_CLAMP_GLSL
#define LIGHTWELL_LIGHT_CLAMP_GLSL

// Of light points at `place`, m. It belongs to the point and not to the receiver, so that what comes from a place may be
// left to other rays by that place alone.
float least_distance(vec3 place) {
  return params.clamp_part * clamp(distance(place, params.clamp_focus), params.clamp_nearest, params.clamp_farthest);
}

float least_distance_squared(vec3 place) {
  float least = least_distance(place);
  return least * least;
}

#endif
