// The scene's environment on the GPU.
#pragma once

#include <memory>
#include <optional>

#include "graph/frame_graph.h"
#include "lightwell/scene.h"

namespace lightwell {

class Device;
class ImageResource;

class GpuEnvironment {
 public:
  GpuEnvironment(Device& device, const Environment& environment);
  ~GpuEnvironment();

  // RGBA32F radiance in W/(sr m^2), latitude-longitude as in lightwell/scene.h; 1x1 where it is constant. Filled by the
  // first frame that asks.
  ImageHandle record(FrameGraph& graph);

  // The radiance where it is the same from everywhere.
  std::optional<glm::vec3> constant_radiance() const { return constant_radiance_; }

 private:
  std::optional<glm::vec3> constant_radiance_;
  std::unique_ptr<ImageResource> image_;
  std::vector<float> pending_;  // texels that still have to be copied
};

}  // namespace lightwell
