#include "reference/texturing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lightwell/metrics.h"

namespace lightwell {
namespace {

const std::array<float, 256>& srgb_table() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> decoded{};
    for (std::size_t i = 0; i < decoded.size(); ++i) decoded[i] = srgb_decode(static_cast<float>(i) / 255.0f);
    return decoded;
  }();
  return table;
}

glm::vec4 texel(const Texture& texture, int x, int y) {
  const std::size_t index =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width) + static_cast<std::size_t>(x);
  const std::uint8_t* rgba = texture.rgba.data() + 4 * index;
  const std::array<float, 256>& decode = srgb_table();
  return {decode[rgba[0]], decode[rgba[1]], decode[rgba[2]], static_cast<float>(rgba[3]) / 255.0f};
}

// Brings a coordinate to [0, 1]; what a transform drove beyond all numbers, to 0.
float wrap_coordinate(float u, Wrap wrap) {
  if (!std::isfinite(u)) return 0.0f;
  switch (wrap) {
    case Wrap::kRepeat:
      return u - std::floor(u);
    case Wrap::kMirroredRepeat: {
      const float period = u - 2.0f * std::floor(u * 0.5f);
      return period > 1.0f ? 2.0f - period : period;
    }
    case Wrap::kClampToEdge:
      break;
  }
  return std::clamp(u, 0.0f, 1.0f);
}

// Texels beyond the edge: the other side for kRepeat, else the edge itself, which is also its own mirror image.
int wrap_texel(int i, int size, Wrap wrap) {
  if (wrap == Wrap::kRepeat) return (i + size) % size;
  return std::clamp(i, 0, size - 1);
}

glm::vec4 look_up(const Scene& scene, const TextureRef& ref, const TexcoordSets& texcoords) {
  if (ref.texture < 0) return glm::vec4{1.0f};
  const glm::vec2 uv = ref.transform * glm::vec3{texcoords[static_cast<std::size_t>(ref.texcoord)], 1.0f};
  return sample_texture(scene.textures[static_cast<std::size_t>(ref.texture)], uv);
}

}  // namespace

glm::vec4 sample_texture(const Texture& texture, glm::vec2 uv) {
  if (texture.width <= 0 || texture.height <= 0) return glm::vec4{1.0f};
  const float x = wrap_coordinate(uv.x, texture.wrap_u) * static_cast<float>(texture.width);
  const float y = wrap_coordinate(uv.y, texture.wrap_v) * static_cast<float>(texture.height);
  if (texture.nearest) {
    return texel(texture, std::min(static_cast<int>(x), texture.width - 1),
                 std::min(static_cast<int>(y), texture.height - 1));
  }
  const float left = std::floor(x - 0.5f);
  const float top = std::floor(y - 0.5f);
  const int x0 = wrap_texel(static_cast<int>(left), texture.width, texture.wrap_u);
  const int x1 = wrap_texel(static_cast<int>(left) + 1, texture.width, texture.wrap_u);
  const int y0 = wrap_texel(static_cast<int>(top), texture.height, texture.wrap_v);
  const int y1 = wrap_texel(static_cast<int>(top) + 1, texture.height, texture.wrap_v);
  const float fx = x - 0.5f - left;
  const float fy = y - 0.5f - top;
  const glm::vec4 upper = (1.0f - fx) * texel(texture, x0, y0) + fx * texel(texture, x1, y0);
  const glm::vec4 lower = (1.0f - fx) * texel(texture, x0, y1) + fx * texel(texture, x1, y1);
  return (1.0f - fy) * upper + fy * lower;
}

glm::vec4 base_color(const Scene& scene, const Material& material, const TexcoordSets& texcoords) {
  return material.base_color * look_up(scene, material.base_color_texture, texcoords);
}

glm::vec3 emitted_radiance(const Scene& scene, const Material& material, const TexcoordSets& texcoords) {
  return material.emission * glm::vec3{look_up(scene, material.emission_texture, texcoords)};
}

bool is_cut_out(const Scene& scene, const Material& material, const TexcoordSets& texcoords, float vertex_alpha) {
  if (material.alpha_mode == AlphaMode::kOpaque) return false;
  const float cutoff = material.alpha_mode == AlphaMode::kMask ? material.alpha_cutoff : 0.5f;
  return base_color(scene, material, texcoords).a * vertex_alpha < cutoff;
}

}  // namespace lightwell
