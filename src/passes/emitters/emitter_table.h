// The emissive triangles with their power, ready to be sampled: host side of emitters.glsl.
#pragma once

#include <cstdint>

#include "graph/frame_graph.h"
#include "passes/gpu_scene/gpu_scene.h"

namespace lightwell {

class EmitterTable {
 public:
  struct Frame {
    BufferHandle emitters;  // glsl::EmissiveTriangle
    BufferHandle groups;    // glsl::EmitterGroup, and one for the whole
    bool look_up = false;   // some need their texture coordinates
  };

  // Declares the passes that make the table, if anything in the scene has changed. Throws InputError if the device
  // cannot hold it.
  Frame record(FrameGraph& graph, const GpuScene::Frame& scene);

 private:
  SceneRevisions revisions_;  // of the scene in the table
};

}  // namespace lightwell
