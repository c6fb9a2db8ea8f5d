// The scene's environment on the GPU.
#pragma once

#include <memory>
#include <optional>

#include "graph/frame_graph.h"
#include "lightwell/scene.h"
#include "passes/environment/environment_table.h"

namespace lightwell {

class Buffer;
class Device;
class ImageResource;

class GpuEnvironment {
 public:
  GpuEnvironment(Device& device, const Environment& environment);
  ~GpuEnvironment();

  // RGBA32F radiance in W/(sr m^2), latitude-longitude as in lightwell/scene.h; 1x1 where it is constant. Filled by the
  // first frame that asks.
  ImageHandle record(FrameGraph& graph);

  // EnvironmentTable::cumulative, for shaders/environment_table.glsl; something small where there is none.
  BufferHandle record_table(FrameGraph& graph);
  // Cells of the table; 0 x 0 where there is none.
  glm::uvec2 table_size() const { return {table_.width, table_.height}; }

  // No light at all.
  bool is_black() const { return black_; }
  // The radiance where it is the same from everywhere.
  std::optional<glm::vec3> constant_radiance() const { return constant_radiance_; }

 private:
  std::optional<glm::vec3> constant_radiance_;
  bool black_ = true;
  std::unique_ptr<ImageResource> image_;
  EnvironmentTable table_;  // without the sums once they are copied
  std::unique_ptr<Buffer> table_buffer_;
  std::vector<float> pending_;  // texels that still have to be copied
};

}  // namespace lightwell
