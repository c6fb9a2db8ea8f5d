// Who meets a face with a ray asks for its light, and says where on its surface it may gather. The including kernel
// declares
//   layout(set = 0, binding = n) buffer VoteBuffer { uint data[]; } votes;
#ifndef LIGHTWELL_CACHE_VOTE_GLSL
#define LIGHTWELL_CACHE_VOTE_GLSL

#include "shaders/random.glsl"

// `bounces`: surfaces that a ray has met between the camera and this one. `place`: as in a vote.
void vote_for_place(uint face, uint place, uint bounces, uint seed) {
  const uint kPlace = (1u << kVoteRandomShift) - 1u;
  atomicMax(votes.data[face], (kMostAsking - bounces) << kVoteBounceShift |
                                  (hash_word(seed) & 63u) << kVoteRandomShift | (place & kPlace));
}

// For a face of this level.
void vote(uint face, uint level, vec3 position, uint bounces, uint seed) {
  if (bounces >= kMostAsking) return;
  vec3 inside = fract(grid_coordinates(level_grid(params.levels, level), position));
  uvec3 place = min(uvec3(inside * 256.0), uvec3(255));
  vote_for_place(face, place.z << 16 | place.y << 8 | place.x, bounces, seed);
}

#endif
