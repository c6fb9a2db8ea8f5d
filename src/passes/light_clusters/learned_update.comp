// Adds the last frame's rays to what is known: old ones count less and less.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_clusters/light_clusters_types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) buffer LearnedBuffer { uint data[]; } learned;

// What a frame leaves of what was known: half after five frames.
const uint kKept = 7;
const uint kKeptOf = 8;

// Enough to know; more would only be slow to change.
const uint kMostRays = 32 * kLearnedOne;

void main() {
  uint slot = kLearnedWords * gl_GlobalInvocationID.x;
  uint unblocked = learned.data[slot + kLearnedUnblocked];
  uint rays = learned.data[slot + kLearnedRays];
  uint new_rays = learned.data[slot + kLearnedNewRays];
  if ((rays | new_rays) == 0) return;
  // A frame's rays count as kMostRays together if they are more.
  float scale = min(1.0, float(kMostRays) / float(kLearnedOne) / max(float(new_rays), 1.0));
  uint new_unblocked = uint(float(learned.data[slot + kLearnedNewUnblocked]) * scale * float(kLearnedOne));
  learned.data[slot + kLearnedUnblocked] = unblocked * kKept / kKeptOf + new_unblocked;
  learned.data[slot + kLearnedRays] = rays * kKept / kKeptOf + uint(float(new_rays) * scale * float(kLearnedOne));
  learned.data[slot + kLearnedNewUnblocked] = 0;
  learned.data[slot + kLearnedNewRays] = 0;
}
