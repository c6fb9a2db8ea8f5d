#include "passes/environment/gpu_environment.h"

#include <cstddef>

#include "gpu/device.h"

namespace lightwell {

GpuEnvironment::GpuEnvironment(Device& device, const Environment& environment)
    : table_(make_environment_table(environment)) {
  const Image& map = environment.map;
  const bool constant = map.width == 0;
  if (constant) constant_radiance_ = environment.radiance;
  black_ = constant ? environment.radiance == glm::vec3(0.0f) : table_.width == 0;
  if (table_.cumulative.empty()) table_.cumulative.push_back(1.0f);
  table_buffer_ = std::make_unique<Buffer>(device, "environment table", table_.cumulative.size() * sizeof(float),
                                           MemoryKind::kDevice);
  ImageInfo info{.format = VK_FORMAT_R32G32B32A32_SFLOAT};
  info.width = constant ? 1 : static_cast<std::uint32_t>(map.width);
  info.height = constant ? 1 : static_cast<std::uint32_t>(map.height);
  image_ = std::make_unique<ImageResource>(device, "environment", info);
  for (std::size_t texel = 0; texel < std::size_t{info.width} * info.height; ++texel) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float radiance = environment.radiance[static_cast<glm::vec3::length_type>(c)];
      pending_.push_back(constant ? radiance : radiance * map.pixels[3 * texel + c]);
    }
    pending_.push_back(1.0f);
  }
}

GpuEnvironment::~GpuEnvironment() = default;

ImageHandle GpuEnvironment::record(FrameGraph& graph) {
  ImageHandle image = graph.import_image(*image_);
  if (!pending_.empty()) {
    graph.copy("upload environment", graph.upload<float>("environment texels", pending_), image);
    pending_ = {};
  }
  return image;
}

BufferHandle GpuEnvironment::record_table(FrameGraph& graph) {
  BufferHandle table = graph.import_buffer(*table_buffer_);
  if (!table_.cumulative.empty()) {
    graph.copy("upload environment table", graph.upload<float>("environment sums", table_.cumulative), table,
               table_.cumulative.size() * sizeof(float));
    table_.cumulative = {};
  }
  return table;
}

}  // namespace lightwell
