// Which of the faces that want a page of links come first.
#ifndef LIGHTWELL_CACHE_PAGE_GROUP_GLSL
#define LIGHTWELL_CACHE_PAGE_GROUP_GLSL

#include "shaders/random.glsl"

uint page_group(uint key) {
  uint rank = params.levels.count - 1 - level_of_index(params.levels, key >> 3);
  return min(rank * kPageGroupsOfLevel + hash_word(key) % kPageGroupsOfLevel, kPageGroups - 1);
}

#endif
