#include "renderer/readback.h"

#include <cstdint>
#include <cstring>
#include <string>

#include <glm/gtc/packing.hpp>

#include "lightwell/error.h"

namespace lightwell {
namespace {

struct ChannelFormat {
  std::size_t count;
  enum class Type { kUnorm8, kHalf, kFloat, kUint } type;
};

ChannelFormat channel_format(VkFormat format) {
  using Type = ChannelFormat::Type;
  switch (format) {
    case VK_FORMAT_R8_UNORM:
      return {1, Type::kUnorm8};
    case VK_FORMAT_R8G8B8A8_UNORM:
      return {4, Type::kUnorm8};
    case VK_FORMAT_R16_SFLOAT:
      return {1, Type::kHalf};
    case VK_FORMAT_R16G16_SFLOAT:
      return {2, Type::kHalf};
    case VK_FORMAT_R16G16B16A16_SFLOAT:
      return {4, Type::kHalf};
    case VK_FORMAT_R32_SFLOAT:
    case VK_FORMAT_D32_SFLOAT:
      return {1, Type::kFloat};
    case VK_FORMAT_R32G32_SFLOAT:
      return {2, Type::kFloat};
    case VK_FORMAT_R32G32B32A32_SFLOAT:
      return {4, Type::kFloat};
    case VK_FORMAT_R32_UINT:
      return {1, Type::kUint};
    case VK_FORMAT_R32G32_UINT:
      return {2, Type::kUint};
    case VK_FORMAT_R32G32B32A32_UINT:
      return {4, Type::kUint};
    default:
      LW_ASSERT(false, "debug view of format " + std::to_string(format));
      return {};
  }
}

template <class T>
T load(const std::vector<std::byte>& bytes, std::size_t index) {
  T value;
  std::memcpy(&value, bytes.data() + index * sizeof(T), sizeof(T));
  return value;
}

float load_channel(const std::vector<std::byte>& bytes, std::size_t index, ChannelFormat::Type type) {
  switch (type) {
    case ChannelFormat::Type::kUnorm8:
      return static_cast<float>(load<std::uint8_t>(bytes, index)) / 255.0f;
    case ChannelFormat::Type::kHalf:
      return glm::unpackHalf1x16(load<std::uint16_t>(bytes, index));
    case ChannelFormat::Type::kFloat:
      return load<float>(bytes, index);
    case ChannelFormat::Type::kUint:
      return static_cast<float>(load<std::uint32_t>(bytes, index));
  }
  return 0.0f;
}

// One sum of the film divided by the number of samples.
Image mean(const std::vector<std::byte>& sums, int width, int height, int samples) {
  Image image(width, height, 3);
  for (std::size_t pixel = 0; pixel < image.pixels.size() / 3; ++pixel) {
    for (std::size_t c = 0; c < 3; ++c) {
      image.pixels[3 * pixel + c] = load<float>(sums, 4 * pixel + c) / static_cast<float>(samples);
    }
  }
  return image;
}

}  // namespace

Image decode_texels(const ImageDesc& desc, const std::vector<std::byte>& bytes) {
  const ChannelFormat format = channel_format(desc.format);
  // Layers and slices one below the other.
  Image image(static_cast<int>(desc.width), static_cast<int>(desc.height * desc.layers * desc.depth), 3);
  for (std::size_t pixel = 0; pixel < image.pixels.size() / 3; ++pixel) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t channel = format.count == 1 ? 0 : c;
      image.pixels[3 * pixel + c] =
          channel < format.count ? load_channel(bytes, format.count * pixel + channel, format.type) : 0.0f;
    }
  }
  return image;
}

Picture develop_film(const std::array<std::vector<std::byte>, 5>& film, int width, int height, int samples,
                     float eye_behind) {
  const auto& [direct, indirect, emission, albedo, normal_depth] = film;
  Picture picture;
  picture.direct = mean(direct, width, height, samples);
  picture.indirect = mean(indirect, width, height, samples);
  picture.emission = mean(emission, width, height, samples);
  picture.albedo = mean(albedo, width, height, samples);
  picture.normal = mean(normal_depth, width, height, samples);
  picture.combined = Image(width, height, 3);
  for (std::size_t i = 0; i < picture.combined.pixels.size(); ++i) {
    picture.combined.pixels[i] = picture.direct.pixels[i] + picture.indirect.pixels[i] + picture.emission.pixels[i];
  }
  picture.depth = Image(width, height, 1);
  for (std::size_t pixel = 0; pixel < picture.depth.pixels.size(); ++pixel) {
    // The mean over the samples that saw a surface.
    const float seen = load<float>(albedo, 4 * pixel + 3);
    if (seen > 0.0f) picture.depth.pixels[pixel] = load<float>(normal_depth, 4 * pixel + 3) / seen - eye_behind;
  }
  return picture;
}

}  // namespace lightwell
