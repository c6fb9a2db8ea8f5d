// Arguments of the dispatch over the faces that gather, and which of them may take a page of links.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_cache/cache_types.h"

layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer ListBuffer { uint data[]; } list;
layout(set = 0, binding = 1) buffer PageCountBuffer { uint data[]; } page_counts;

#include "shaders/linear_dispatch.glsl"

// Whole groups, as many as there are pages for, so that the order in which faces take them does not show.
void grant_pages(uint free) {
  uint left = free;
  uint granted = 0;
  uint wanted = 0;
  for (uint group = 0; group < kPageGroups; ++group) {
    uint faces = page_counts.data[kPagesWanted + group];
    page_counts.data[kPagesWanted + group] = 0;
    wanted += faces;
    if (granted == group && faces <= left) {
      left -= faces;
      granted = group + 1;
    }
  }
  page_counts.data[kPagesGranted] = granted;
  page_counts.data[kPagesShort] = wanted - (free - left);
}

// Before pages run out those of faces that sleep are called back.
void choose_age(uint free) {
  uint age = page_counts.data[kPagesAge];
  if (age == 0) age = kMostPageAge;
  if (free < params.page_count / 8) age = max(age / 2, kFramesAwake);
  if (free > params.page_count / 2) age = min(age * 2, kMostPageAge);
  page_counts.data[kPagesAge] = age;
}

void main() {
  uint free = page_counts.data[kPagesFree];
  grant_pages(free);
  choose_age(free);
  uvec3 groups = linear_groups((list.data[kListCount] + 63) / 64);
  list.data[0] = groups.x;
  list.data[1] = groups.y;
  list.data[2] = groups.z;
}
