// What the presets share of the view's part: options, the picture's splats, debug views.
#pragma once

#include <memory>
#include <vector>

#include "lightwell/options.h"
#include "techniques/photon_splatting/splat_passes.h"
#include "techniques/photon_splatting/world_part.h"
#include "techniques/technique.h"

namespace lightwell {

struct SplatViewOptions {
  float tolerance = 0.5f;  // texels
  int list_memory = 32;    // MiB
  int sampling = 0;        // light is gathered at a pixel of each block of side 2^sampling
};

void describe_splat_view(OptionVisitor& visitor, SplatViewOptions& options);

// One view's splats in one frame.
struct SplatPicture {
  SplatScreen screen;
  Splats splats;
  SplatLists lists;
  SplatRules rules;
  ImageHandle gathered;  // record_splat_gather()
  ImageHandle light;     // the same at every pixel
};

// `rules`: the kernel is the world's, the tolerance that of the options.
SplatPicture record_splat_picture(FrameGraph& graph, const ViewFrame& view, const PhotonWorld& world,
                                  const SplatViewOptions& options, SplatRules rules,
                                  const std::shared_ptr<bool>& warned);

// Photons where they start, centers of splats, how many light each pixel, shadow maps, cells of the stratification.
void add_splat_views(FrameGraph& graph, const ViewFrame& view, const PhotonWorld& world,
                     const SplatViewOptions& options, const SplatPicture& picture, std::vector<DebugView>& views);

}  // namespace lightwell
