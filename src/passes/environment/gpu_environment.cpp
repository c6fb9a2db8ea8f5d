#include "passes/environment/gpu_environment.h"

#include <cstddef>
#include <cstring>

#include "gpu/device.h"
#include "passes/environment/environment_table.h"
#include "shaders/environment_kind.h"

namespace lightwell {
namespace {

// Radiance of every texel, alpha 1, to `target`.
void write_texels(const Environment& environment, std::byte* target) {
  const Image& map = environment.map;
  const std::size_t count = map.pixels.size() / 3;
  for (std::size_t i = 0; i < count; ++i) {
    const float* rgb = &map.pixels[3 * i];
    const glm::vec4 texel(environment.radiance * glm::vec3(rgb[0], rgb[1], rgb[2]), 1.0f);
    std::memcpy(target + i * sizeof(texel), &texel, sizeof(texel));
  }
}

}  // namespace

GpuEnvironment::GpuEnvironment(Device& device, const Environment& environment) {
  const Image& map = environment.map;
  const EnvironmentTable table = make_environment_table(environment);
  const bool constant = map.width == 0;
  if (constant) constant_radiance_ = environment.radiance;
  black_ = constant ? environment.radiance == glm::vec3(0.0f) : table.width == 0;
  table_size_ = {table.width, table.height};
  table_ = make_buffer(device, "environment table", as_byte_span(table.cumulative));
  ImageInfo info{.format = VK_FORMAT_R32G32B32A32_SFLOAT};
  info.width = constant ? 1 : static_cast<std::uint32_t>(map.width);
  info.height = constant ? 1 : static_cast<std::uint32_t>(map.height);
  image_ = make_image(device, "environment", info, sizeof(glm::vec4) * std::uint64_t{info.width} * info.height);
  if (constant) {
    const glm::vec4 texel(environment.radiance, 1.0f);
    std::memcpy(image_.staging->mapped(), &texel, sizeof(texel));
  } else {
    write_texels(environment, image_.staging->mapped());
  }
}

GpuEnvironment::~GpuEnvironment() = default;

std::uint32_t GpuEnvironment::kind() const {
  if (black_) return glsl::kEnvironmentBlack;
  return constant_radiance_ ? glsl::kEnvironmentConstant : glsl::kEnvironmentMap;
}

ImageHandle GpuEnvironment::record(FrameGraph& graph) {
  return import(graph, image_);
}

BufferHandle GpuEnvironment::record_table(FrameGraph& graph) {
  return import(graph, table_);
}

}  // namespace lightwell
