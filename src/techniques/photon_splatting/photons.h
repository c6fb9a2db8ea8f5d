// Photons: light points of paths send one photon on each, which becomes a splat where it meets a surface.
#pragma once

#include "passes/light_paths/light_paths.h"
#include "passes/world/world.h"
#include "techniques/photon_splatting/photon_params.h"

namespace lightwell {

// What is made of a frame's photons, before their shadow maps.
struct PhotonSplats {
  glsl::PhotonParams params;
  BufferHandle splats;  // glsl::StoredSplat, params.capacity
  BufferHandle counts;  // uint, glsl::kSplatCountWords
  BufferHandle starts;  // glsl::PhotonStart a splat
  BufferHandle strata;  // uint a splat, where its path started: SizedLightPaths; empty without a guide
};

// No splats so far. `guided`: the paths have strata.
PhotonSplats begin_splats(FrameGraph& graph, const glsl::PhotonParams& params, bool guided);

// Appends a splat for each light point of a round, in their order; `params.first_path` is the round's. Light points
// without flux make none; photons that meet nothing make splats without flux.
void record_photons(FrameGraph& graph, WorldFrame& world, const SizedLightPaths& paths, PhotonSplats& splats);

// How many light points there are, cleared: uint, glsl::kPointCountWords.
BufferHandle begin_point_counts(FrameGraph& graph);

// The matrices of light paths' sequence.
BufferHandle upload_sobol_matrices(FrameGraph& graph);

}  // namespace lightwell
