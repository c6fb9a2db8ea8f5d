// Which part of the light points of a cluster is visible from where, as far as shadow rays have told. The including
// kernel declares
//   layout(set = 0, binding = n) [readonly] buffer LearnedBuffer { uint data[]; } learned;   // kLearnedWords a slot
#ifndef LIGHTWELL_LEARNED_VISIBILITY_GLSL
#define LIGHTWELL_LEARNED_VISIBILITY_GLSL

#include "passes/light_clusters/light_clusters_types.h"
#include "shaders/random.glsl"

// First word of the slot for receivers in `cell` and the cluster with `key`.
uint learned_slot(uint cell, uint key) { return kLearnedWords * (hash_word(cell ^ hash_word(key)) & (kLearnedSlots - 1)); }

// In (0, 1]; 1 where nothing is known.
float learned_visibility(uint slot) {
  float one = float(kLearnedOne);
  return (float(learned.data[slot + kLearnedUnblocked]) + one) / (float(learned.data[slot + kLearnedRays]) + one);
}

#endif
