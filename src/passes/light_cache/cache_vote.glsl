// Who reads a face asks for its light, and says where on its surface that should be of. The including kernel declares
//   layout(set = 0, binding = n) buffer VoteBuffer { uint data[]; } votes;
#ifndef LIGHTWELL_CACHE_VOTE_GLSL
#define LIGHTWELL_CACHE_VOTE_GLSL

#include "shaders/random.glsl"

// `kind`: kVoteSeen or kVoteMet. `place`: as in a vote. `bounces`: surfaces that a ray has met between the camera and
// this one.
void vote_for_place(uint face, uint kind, uint place, uint bounces, uint seed) {
  const uint kPlace = (1u << kVoteRandomShift) - 1u;
  // Of uniform numbers many would share the highest step, and among them the highest place would win.
  float chance = (float(hash_word(seed) >> 8) + 0.5) * exp2(-24.0);
  uint random = min(uint(-4.0 * log2(chance)), 63u);
  atomicMax(votes.data[face * kVoteWords + kind],
            (kMostAsking - bounces) << kVoteBounceShift | random << kVoteRandomShift | (place & kPlace));
}

// For a face of this level.
void vote(uint face, uint kind, uint level, vec3 position, uint bounces, uint seed) {
  if (bounces >= kMostAsking) return;
  vec3 inside = fract(grid_coordinates(level_grid(params.levels, level), position));
  uvec3 place = min(uvec3(inside * 256.0), uvec3(255));
  vote_for_place(face, kind, place.z << 16 | place.y << 8 | place.x, bounces, seed);
}

#endif
