// Radiance to what a display shows.
#pragma once

#include "graph/frame_graph.h"

namespace lightwell {

// Draws sRGB(x / (1 + x)), x = exposure * max(radiance, 0), to `target`: any colour format, of the radiance's size.
void record_tonemap(FrameGraph& graph, ImageHandle radiance, float exposure, ImageHandle& target);

}  // namespace lightwell
