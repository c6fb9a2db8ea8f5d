// Everything that turns a scene into a Picture, by the name that --technique takes.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/option_set.h"
#include "lightwell/photon_mapper.h"
#include "lightwell/picture.h"
#include "lightwell/renderer.h"
#include "lightwell/scene.h"

namespace lightwell {

// Options of the techniques that run on the GPU.
struct GpuArguments {
  std::string device;
  bool validation = false;
  std::optional<Bounds> grid_bounds;
  std::vector<std::string> debug_views;
};

struct RenderResult {
  Picture picture;
  std::string device;                                   // "" on the CPU
  std::optional<RenderStatistics> statistics;           // on the GPU
  std::optional<PhotonMapperStatistics> photon_mapper;  // of --technique photon-mapping
  std::map<std::string, Image> debug_images;
};

// What is seen at one moment.
struct Moment {
  SceneSnapshot world;
  WorldCamera camera;
  double time = 0.0;  // s
};

struct RenderJob {
  const Scene& scene;
  Moment start;
  // Frame k of a scene that moves, the first being `start`; empty: the scene is static. Where it moves, the option
  // `frames` counts moments, each shown once.
  std::function<Moment(int)> play;
  int width = 0;
  int height = 0;
  std::string preset;                    // one of the method's, or ""
  std::vector<std::string> assignments;  // "name=value", checked
  GpuArguments gpu;
  bool variance = false;                // Picture::variance is wanted; of methods that have it
  std::function<void(float)> progress;  // part done in (0,1]
  // If set, it is given every frame (0, 1, ...), and the method returns the last. Of a static scene
  // renderers on the CPU have one.
  std::function<void(int, const RenderResult&)> each_frame;
};

struct RenderMethod {
  std::string name;
  std::string help;                  // one sentence
  std::vector<std::string> presets;  // the first is the default; none on the CPU
  bool on_gpu = false;               // has debug images
  bool has_statistics = false;
  bool has_variance = false;  // Picture::variance
  // Its own options at the defaults of a preset; what is set through them goes nowhere but is checked.
  std::function<DescribeOptions(const std::string& preset)> own_options;
  std::function<RenderResult(const RenderJob&)> render;
};

// The options of the renderer, which all techniques on the GPU share; what is set through them goes nowhere.
DescribeOptions shared_options();

// A method's own options, and the shared ones where it runs on the GPU.
DescribeOptions all_options(const RenderMethod& method, const std::string& preset);

// What a technique on the GPU is built with. `technique`: its name.
RendererOptions renderer_options(const RenderJob& job, const std::string& technique);

// All of them: the techniques of the GPU, "none" (direct light only), the path tracer and the photon mapper.
std::vector<RenderMethod> make_render_methods();

// Throws InputError listing the names.
const RenderMethod& find_render_method(const std::vector<RenderMethod>& methods, const std::string& name);

// The preset that `wanted` names, or the default one for "". Throws InputError listing them.
std::string find_preset(const RenderMethod& method, const std::string& wanted);

}  // namespace lightwell
