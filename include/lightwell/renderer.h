// The real-time renderer: a scene, a camera and a technique in, pictures out. It records into command buffers that the
// host owns (record()), or runs by itself (render()).
//
// Direct light comes from all sources: point, spot and directional lights by shadow maps or rays, emissive surfaces and
// the environment by traced samples whose mean over frames is the truth.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>

#include "lightwell/device.h"
#include "lightwell/options.h"
#include "lightwell/picture.h"
#include "lightwell/scene.h"
#include "lightwell/vulkan.h"

namespace lightwell {

struct RendererOptions {
  int width = 512;                             // pixels
  int height = 512;                            // pixels
  std::string technique = "none";              // "none": direct light only
  std::string preset;                          // "": the technique's first
  std::vector<std::string> technique_options;  // "name=value", after the preset
  std::optional<Bounds> grid_bounds;           // what voxel grids and directional shadow maps cover; default: the scene
  int samples = 4;                             // jittered frames that render() averages; anti-aliasing
  int frames = 0;                              // exactly so many, `samples` included; 0: until the technique is steady
  int shadow_map_size = 1024;                  // texels a side and view
  int shadows = 0;                             // of point, spot and directional lights: 0 maps, 1 rays
  int light_samples = 1;                 // rays a pixel and frame to emitters, as many to the environment; 0: none
  int tracing = 0;                       // who answers rays: 0 the faster, 1 our own hierarchy, 2 ray queries
  std::vector<std::string> debug_views;  // intermediate images that render() brings back, by name

  // Those of the options above that the command line takes by name: samples, frames, shadow-map-size, shadows,
  // light-samples, tracing.
  void describe(OptionVisitor& visitor);
};

// What one frame shows.
struct FrameView {
  const SceneSnapshot* snapshot = nullptr;  // the instances of the constructor's, wherever they are now
  WorldCamera camera;
  bool cut = false;     // nothing of the last frames helps this one
  bool settle = false;  // render() waits until the technique is steady, whatever RendererOptions::frames says
  double time = 0.0;    // of the world's clock, s
  // World positions, m. Grids and shadow maps of large scenes are finest about the middle of their box; none: about the
  // camera.
  std::vector<glm::vec3> points_of_interest;
};

// An image that the host lends for one frame: any colour format that can be drawn to, of the renderer's size. It gets
// sRGB(x / (1 + x)), x = exposure * radiance.
struct RenderTarget {
  VkImage image = VK_NULL_HANDLE;
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkImageLayout layout_before = VK_IMAGE_LAYOUT_UNDEFINED;
  VkImageLayout layout_after = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
  float exposure = 1.0f;
};

struct FrameReport {
  std::uint64_t frame = 0;  // its number: 1, 2, ...
  bool steady = true;       // the next frame of the same view would come out the same
};

struct PassStatistics {
  std::string name;
  double time_ms = 0.0;     // GPU time a frame: mean over the frames that had the pass, the first left out if possible
  std::uint32_t count = 0;  // dispatches and draws of this name a frame
  int frames = 1;           // that had the pass
};

// Where the host's time went before a renderer's first frame was done, in ms.
struct FirstFrame {
  double setup_ms = 0.0;        // the constructor: geometry and textures prepared
  double declare_ms = 0.0;      // passes declared, shaders' bindings looked up
  double pipelines_ms = 0.0;    // pipelines made, on all cores
  std::uint32_t pipelines = 0;  // so many: those that no other renderer on the device had made
  double record_ms = 0.0;       // memory taken, uploads copied, commands recorded
  double wait_ms = 0.0;         // render(): submitted until done; drivers may compile at first use
};

struct RenderStatistics {
  int frames = 0;
  bool steady = true;         // of the last frame; false: stopped by `frames` or by kMaximumFrames
  double gpu_time_ms = 0.0;   // a frame, all passes: the mean, the first frame left out if possible
  double wall_time_ms = 0.0;  // all frames, compilation and transfers included
  FirstFrame first_frame;
  std::vector<PassStatistics> passes;
  std::map<std::string, std::uint64_t> memory_bytes;  // GPU memory by name, of all that the device holds
  std::uint64_t triangles = 0;
  std::uint64_t vertices = 0;
  std::uint64_t lights = 0;
  std::map<std::string, std::uint64_t> counts;  // of what the technique keeps and what it had no room for, by name
};

inline constexpr int kMaximumFrames = 512;  // that render() waits for a technique to become steady

class Renderer {
 public:
  // Copies what it needs of `scene`, which an importer returned or validate() passed; `device` outlives the renderer.
  // `frames_in_flight`: how many recorded frames may be waiting or running at once. Throws InputError: an unknown
  // technique, preset or option, a snapshot of another scene, a size or scene that the device cannot hold.
  Renderer(Device& device, const Scene& scene, const SceneSnapshot& snapshot, const RendererOptions& options,
           std::uint32_t frames_in_flight = 2);
  // Gives all memory back at once: the GPU has finished every frame of this renderer that was submitted, and the others
  // never will be. Frames of other renderers on the device may be in flight.
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Records one frame; submits nothing, waits for nothing. `completed`: the last frame that the GPU has finished, 0 at
  // first; at most `frames_in_flight` frames may be unfinished, this one included. Throws InputError, before anything
  // is recorded, naming the argument or field that is wrong: other instances or joint counts than the constructor's, a
  // number that is not finite, a target that cannot be drawn to, a frame too many in flight.
  FrameReport record(VkCommandBuffer commands, const FrameView& view, const RenderTarget& target,
                     std::uint64_t completed);

  // Runs frames of one view until it is done (RendererOptions::frames, samples), and brings the picture back.
  // `progress` is told the number of frames done. What a technique remembers lives on to the next call. No frame of
  // record() may be unfinished then. Throws InputError as record() does.
  Picture render(const FrameView& view, const std::function<void(int)>& progress = {});

  // Of the last render().
  const RenderStatistics& statistics() const;
  // What one frame of record() cost: the GPU has finished it, and it is among the last `frames_in_flight`. The host
  // measures wall time by itself.
  RenderStatistics statistics_of(std::uint64_t frame) const;
  // The debug views that were asked for, of the last frame of the last render(); 3 channels, sums and signs as stored.
  const std::map<std::string, Image>& debug_images() const;
  // Names that RendererOptions::debug_views may hold; the technique's are known after the first frame.
  std::vector<std::string> debug_view_names() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lightwell
