// Merges the last clusters, all rounds in one workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/trace/bvh_params.h"
#include "shaders/paged_buffer.glsl"

layout(local_size_x = 256) in;
layout(set = 0, binding = 0) buffer StateBuffer { uint data[]; } state;
LW_PAGED_READ_WRITE(coherent, 0, 1, uvec4, lows)
LW_PAGED_READ_WRITE(coherent, 0, 2, uvec4, highs)
LW_PAGED_READ_WRITE(coherent, 0, 3, uint, sizes)
LW_PAGED_READ_WRITE(coherent, 0, 4, uint, clusters)

shared uint partner_of[kBvhTopClusters];
shared uint cluster_count;
shared uint inner_count;

#include "shaders/linear_dispatch.glsl"
#include "passes/trace/bvh_likeness.glsl"
#include "passes/trace/bvh_merge.glsl"

// In place: what is kept moves only forwards.
void merge_partners(uint count, uint first, uint round) {
  uint inner = inner_count;
  uint target = 0;
  for (uint i = 0; i < count; ++i) {
    uint partner = partner_of[i];
    bool mutual = partner != i && partner_of[partner] == i;
    if (mutual && partner < i) continue;
    uint cluster = clusters_at(first + i);
    if (mutual) {
      make_inner_node(params.count + inner, cluster, clusters_at(first + partner));
      cluster = params.count + inner++;
    }
    clusters_store(first + target++, cluster);
  }
  state.data[kBvhRounds + 4 * round + 3] = inner_count;
  state.data[kBvhRounds + 4 * round + 7] = inner;
  cluster_count = target;
  inner_count = inner;
}

void main() {
  uint local = gl_LocalInvocationID.x;
  uint first = state.data[kBvhHalf] * params.count;
  if (local == 0) {
    cluster_count = min(state.data[kBvhClusters], kBvhTopClusters);
    inner_count = state.data[kBvhInnerNodes];
  }
  barrier();
  for (uint round = 0; round < kBvhTopRounds; ++round) {
    uint count = cluster_count;
    if (count > 1) {
      for (uint i = local; i < count; i += 256)
        partner_of[i] = round < kBvhTopFree ? nearest_cluster(i, count, first) : paired_cluster(i, count);
    } else if (local == 0) {
      partner_of[0] = 0;
    }
    barrier();
    if (local == 0) merge_partners(count, first, params.rounds + round);
    memoryBarrierBuffer();
    barrier();
  }
}
