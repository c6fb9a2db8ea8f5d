// The scene's environment on the GPU.
#pragma once

#include <cstdint>
#include <optional>

#include "graph/frame_graph.h"
#include "lightwell/scene.h"
#include "passes/gpu_scene/static_resources.h"

namespace lightwell {

class Device;

class GpuEnvironment {
 public:
  GpuEnvironment(Device& device, const Environment& environment);
  ~GpuEnvironment();

  // RGBA32F radiance in W/(sr m^2), latitude-longitude as in lightwell/scene.h; 1x1 where it is constant. Filled by the
  // first recorded frame that asks; keep this until that frame was recorded.
  ImageHandle record(FrameGraph& graph);

  // EnvironmentTable::cumulative, for shaders/environment_table.glsl; something small where there is none.
  BufferHandle record_table(FrameGraph& graph);
  // Cells of the table; 0 x 0 where there is none.
  glm::uvec2 table_size() const { return table_size_; }

  // SceneRevisions::environment: the same for good, since the environment does not change.
  std::uint64_t revision() const { return 1; }

  // One of shaders/environment_kind.h, for kernels that sample it.
  std::uint32_t kind() const;
  // No light at all.
  bool is_black() const { return black_; }
  // The radiance where it is the same from everywhere.
  std::optional<glm::vec3> constant_radiance() const { return constant_radiance_; }

 private:
  std::optional<glm::vec3> constant_radiance_;
  bool black_ = true;
  StaticImage image_;
  StaticBuffer table_;
  glm::uvec2 table_size_{0};
};

}  // namespace lightwell
