// The one interface of a GI technique. A technique owns a folder; nothing else knows its insides.
//
// It has two parts. The world part is what all views share: voxels, virtual lights, photons, caches; it is
// recorded once a frame. The view part is what a camera needs of it: look-up, per-pixel sampling, histories.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "graph/frame_graph.h"
#include "lightwell/options.h"
#include "passes/lights/light_kinds.h"
#include "passes/view/view_frame.h"
#include "techniques/points.h"

namespace lightwell {

struct GiResult {
  ImageHandle
      irradiance;        // RGBA32F: diffuse irradiance E (W/m^2) of the kinds that the technique covers, before albedo
  ImageHandle specular;  // optional radiance towards the camera
  bool steady = true;    // false: another frame of the same inputs would come out different
};

// An intermediate image that can be looked at; costs nothing where nobody does.
struct DebugView {
  std::string_view name;
  ImageHandle image;
};

// The world part, made with the options that describe() marks as the world's. Views with equal ones share it.
class TechniqueWorld {
 public:
  virtual ~TechniqueWorld() = default;
  // Declares this frame's passes. Called once a frame, in frame order, before any view's part.
  virtual void record_world(FrameGraph& graph, WorldFrame& world) = 0;
  // Irradiance away from the screen: a vec4 a point, xyz E (W/m^2) of the kinds that the technique covers. After
  // record_world() of the same frame. Empty where the technique offers none.
  virtual BufferHandle record_points(FrameGraph&, WorldFrame&, const Points&) { return {}; }
  // What it keeps and what it had no room for, by name, in the last frame that is known to be complete.
  virtual std::map<std::string, std::uint64_t> counts() const { return {}; }
};

class Technique {
 public:
  virtual ~Technique() = default;
  // The only list of its options; defaults are those of the preset it was made with.
  virtual void describe(OptionVisitor& visitor) = 0;
  // The kinds of light in its results, where the frame itself can bring `direct` to visible surfaces. Those that it
  // does not cover are brought by the frame.
  virtual LightKinds covers(LightKinds direct) const { return LightKinds::kAll - direct; }
  // The world part; null where there is none. `covered`: what covers() said.
  virtual std::unique_ptr<TechniqueWorld> create_world(LightKinds) const { return nullptr; }
  // Declares this frame's passes of one view. `world`: what create_world() made, its passes already declared.
  virtual GiResult record_view(FrameGraph& graph, TechniqueWorld* world, ViewFrame& view) = 0;
  // Filled by record_view() of the same frame.
  virtual std::span<const DebugView> debug_views() const { return {}; }
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
