// Shows the octree (Sun 2015, Fig. 4.3).
#pragma once

#include "graph/frame_graph.h"
#include "passes/svo/svo.h"
#include "passes/view/view_frame.h"

namespace lightwell {

// RGBA16F of the view's size: edges of inner nodes' boxes green, of occupied leaves' blue; what lies behind a leaf is
// hidden. Alpha: 1 where something was drawn. `svo` has a tree.
ImageHandle record_svo_view(FrameGraph& graph, const ViewFrame& view, const Svo& svo);

}  // namespace lightwell
