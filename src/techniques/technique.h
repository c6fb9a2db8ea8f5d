// The one interface of a GI technique. A technique owns a folder; nothing else knows its insides.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "graph/frame_graph.h"
#include "lightwell/options.h"
#include "lightwell/scene.h"
#include "passes/gbuffer/gbuffer.h"
#include "passes/gpu_scene/gpu_scene.h"
#include "passes/lights/light_table.h"
#include "passes/shadow_maps/shadow_maps.h"

namespace lightwell {

// Everything that a technique may read this frame.
struct FrameInputs {
  GBuffer gbuffer;
  GpuScene::Frame scene;                 // world-space vertices, indices, materials, textures
  const SceneSnapshot* world = nullptr;  // CPU side: bounds, cameras
  LightTable::Frame lights;
  ShadowMaps::Frame shadows;     // read_lights() binds both for shaders/direct.glsl
  ImageHandle environment;       // RGBA32F latitude-longitude, 1x1 if constant
  ImageHandle direct;            // RGBA32F: direct irradiance E (W/m^2) at each pixel, before albedo
  bool samples_sources = false;  // `direct` holds the light straight from emitters and the environment: the technique's
                                 // irradiance must not
  BufferHandle camera;           // glsl::GpuCamera, uniform
  std::uint64_t frame_index = 0;
  SceneRevisions revisions;  // of all categories
  bool reset = false;        // camera cut, resize, another scene: histories say nothing about this frame
  Bounds grid_bounds;        // of --grid-bounds, or of the scene
};

struct GiResult {
  ImageHandle irradiance;  // RGBA32F: indirect diffuse irradiance E (W/m^2), before albedo; with the light straight
                           // from emitters and the environment only where `samples_sources` is not set
  ImageHandle specular;    // optional radiance towards the camera
  bool includes_direct = false;  // then the frame adds no direct light of its own
  bool steady = true;            // false: another frame of the same inputs would come out different
};

// An intermediate image that can be looked at; filled by record() of the same frame.
struct DebugView {
  std::string_view name;
  ImageHandle image;
};

class Technique {
 public:
  virtual ~Technique() = default;
  // The only list of its options; defaults are those of the preset it was made with.
  virtual void describe(OptionVisitor& visitor) = 0;
  // Declares this frame's passes. Called once a frame, in frame order.
  virtual GiResult record(FrameGraph& graph, const FrameInputs& inputs) = 0;
  virtual std::span<const DebugView> debug_views() const { return {}; }
  // Cannot tell the light straight from emitters from that which bounced: the frame then adds none of its own.
  virtual bool includes_emitters() const { return false; }
};

// One row of the table of techniques. Each technique folder defines `const TechniqueInfo kTechnique_<folder>` in its
// own .cpp; CMake generates the table from the folders.
struct TechniqueInfo {
  std::string_view name;                      // as on the command line: "light-volume"
  std::string_view summary;                   // one sentence
  std::span<const std::string_view> presets;  // the first is the default
  std::unique_ptr<Technique> (*create)(std::string_view preset);
};

std::span<const TechniqueInfo* const> techniques();

}  // namespace lightwell
