#include "passes/gpu_scene/texture_buckets.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>

#include <tbb/parallel_for.h>
#include <glm/ext/vector_float4.hpp>

#include "lightwell/error.h"
#include "lightwell/metrics.h"
#include "passes/gpu_scene/gpu_scene_types.h"

namespace lightwell {
namespace {

// What materials ask of a texture.
struct Use {
  bool used = false;
  float cutoff = 0.0f;  // of the texture's own alpha; 0: no holes
};

std::vector<Use> find_uses(const Scene& scene) {
  std::vector<Use> uses(scene.textures.size());
  for (const Material& material : scene.materials) {
    for (const TextureRef* ref : {&material.base_color_texture, &material.emission_texture}) {
      if (ref->texture >= 0) uses[static_cast<std::size_t>(ref->texture)].used = true;
    }
    if (material.alpha_mode == AlphaMode::kOpaque || material.base_color_texture.texture < 0) continue;
    const float cutoff = material.alpha_mode == AlphaMode::kBlend ? 0.5f : material.alpha_cutoff;
    uses[static_cast<std::size_t>(material.base_color_texture.texture)].cutoff =
        std::min(1.0f, cutoff / std::max(material.base_color.a, 1e-6f));
  }
  return uses;
}

// Of a value that is not negative. std::lround is a call into the C library for each of a scene's texels.
std::uint32_t round_up_halves(float value) {
  return static_cast<std::uint32_t>(static_cast<double>(value) + 0.5);
}

// Conversions by table: exact to the rounding of 8 bits.
class SrgbTables {
 public:
  SrgbTables() {
    for (std::size_t i = 0; i < decode_.size(); ++i) decode_[i] = srgb_decode(static_cast<float>(i) / 255.0f);
    for (std::size_t i = 0; i < encode_.size(); ++i) {
      encode_[i] = static_cast<std::uint8_t>(std::lround(255.0f * srgb_encode(static_cast<float>(i) / 65535.0f)));
    }
  }

  glm::vec4 decode(const std::uint8_t* texel) const {
    return {decode_[texel[0]], decode_[texel[1]], decode_[texel[2]], static_cast<float>(texel[3]) / 255.0f};
  }
  void encode(const glm::vec4& color, std::uint8_t* texel) const {
    for (int c = 0; c < 3; ++c) texel[c] = encode_[round_up_halves(65535.0f * std::clamp(color[c], 0.0f, 1.0f))];
    texel[3] = static_cast<std::uint8_t>(round_up_halves(255.0f * std::clamp(color.a, 0.0f, 1.0f)));
  }

 private:
  std::array<float, 256> decode_;
  std::array<std::uint8_t, 65536> encode_;
};

int wrap_index(int i, int size, Wrap wrap) {
  switch (wrap) {
    case Wrap::kRepeat:
      return ((i % size) + size) % size;
    case Wrap::kMirroredRepeat: {
      const int m = ((i % (2 * size)) + 2 * size) % (2 * size);
      return m < size ? m : 2 * size - 1 - m;
    }
    case Wrap::kClampToEdge:
      return std::clamp(i, 0, size - 1);
  }
  return 0;
}

// The source texels that one target texel is made of, along one axis: linear interpolation where the texture grows, the
// average of what is covered where it shrinks, the nearest where the texture is not to be interpolated.
struct Taps {
  int first = 0;
  std::vector<float> weights;
};

Taps make_taps(int target, int target_size, int source_size, bool nearest) {
  const float scale = static_cast<float>(source_size) / static_cast<float>(target_size);
  const float center = (static_cast<float>(target) + 0.5f) * scale;
  if (nearest) return {std::min(static_cast<int>(center), source_size - 1), {1.0f}};
  const float radius = std::max(1.0f, scale);
  Taps taps;
  taps.first = static_cast<int>(std::floor(center - radius));
  float sum = 0.0f;
  for (int i = taps.first; static_cast<float>(i) < center + radius; ++i) {
    const float weight = std::max(0.0f, 1.0f - std::abs(static_cast<float>(i) + 0.5f - center) / radius);
    taps.weights.push_back(weight);
    sum += weight;
  }
  for (float& weight : taps.weights) weight /= sum;
  return taps;
}

// Resamples to a square of `side` texels.
void resample(const SrgbTables& srgb, const Texture& texture, int side, std::uint8_t* target) {
  if (texture.width == side && texture.height == side) {
    std::copy(texture.rgba.begin(), texture.rgba.end(), target);
    return;
  }
  std::vector<Taps> columns;
  for (int x = 0; x < side; ++x) columns.push_back(make_taps(x, side, texture.width, texture.nearest));
  for (int y = 0; y < side; ++y) {
    const Taps rows = make_taps(y, side, texture.height, texture.nearest);
    for (int x = 0; x < side; ++x) {
      const Taps& column = columns[static_cast<std::size_t>(x)];
      glm::vec4 sum(0.0f);
      for (std::size_t j = 0; j < rows.weights.size(); ++j) {
        const int v = wrap_index(rows.first + static_cast<int>(j), texture.height, texture.wrap_v);
        for (std::size_t i = 0; i < column.weights.size(); ++i) {
          const int u = wrap_index(column.first + static_cast<int>(i), texture.width, texture.wrap_u);
          const auto index =
              static_cast<std::size_t>(v) * static_cast<std::size_t>(texture.width) + static_cast<std::size_t>(u);
          sum += srgb.decode(&texture.rgba[4 * index]) * (rows.weights[j] * column.weights[i]);
        }
      }
      srgb.encode(sum, target + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                                     static_cast<std::size_t>(x)));
    }
  }
}

// Averages 2x2 texels. Where there are holes, colour is weighted by coverage, so that what is cut away leaves no
// fringe.
template <class Fetch>
std::vector<glm::vec4> halve(std::size_t side, bool holes, const Fetch& fetch) {
  std::vector<glm::vec4> half((side / 2) * (side / 2));
  for (std::size_t y = 0; y < side / 2; ++y) {
    for (std::size_t x = 0; x < side / 2; ++x) {
      glm::vec4 sum(0.0f);
      float weights = 0.0f;
      for (std::size_t k = 0; k < 4; ++k) {
        const glm::vec4 texel = fetch((2 * y + k / 2) * side + 2 * x + k % 2);
        const float weight = holes ? texel.a + 1.0f / 255.0f : 1.0f;
        sum += glm::vec4(glm::vec3(texel) * weight, texel.a);
        weights += weight;
      }
      half[y * (side / 2) + x] = glm::vec4(glm::vec3(sum) / weights, sum.a / 4.0f);
    }
  }
  return half;
}

// Factor on alpha that leaves the fraction `coverage` of texels at or above `cutoff`.
float coverage_scale(const std::vector<glm::vec4>& texels, float coverage, float cutoff) {
  std::vector<float> alphas;
  for (const glm::vec4& texel : texels) alphas.push_back(texel.a);
  const auto kept = static_cast<std::ptrdiff_t>(std::lround(coverage * static_cast<float>(alphas.size())));
  if (kept <= 0) return 1.0f;
  std::nth_element(alphas.begin(), alphas.begin() + (kept - 1), alphas.end(), std::greater<>());
  return cutoff / std::max(alphas[static_cast<std::size_t>(kept - 1)], 1e-3f);
}

// Fills one layer of a bucket, all mips.
void build_layer(const SrgbTables& srgb, const Texture& texture, const Use& use, TextureBucket& bucket,
                 std::size_t layer) {
  std::size_t side = bucket.side;
  std::size_t offset = 0;
  std::uint8_t* level = &bucket.texels[layer * side * side * 4];
  resample(srgb, texture, static_cast<int>(side), level);

  const bool holes = use.cutoff > 0.0f;
  std::size_t covered = 0;
  for (std::size_t i = 0; holes && i < side * side; ++i) {
    covered += static_cast<float>(level[4 * i + 3]) >= use.cutoff * 255.0f ? 1 : 0;
  }
  const float coverage = static_cast<float>(covered) / static_cast<float>(side * side);

  std::vector<glm::vec4> texels = halve(side, holes, [&](std::size_t i) { return srgb.decode(level + 4 * i); });
  for (std::uint32_t mip = 1; mip < bucket.mips; ++mip) {
    offset += side * side * 4 * bucket.layers;
    side /= 2;
    level = &bucket.texels[offset + layer * side * side * 4];
    const float alpha_scale = holes ? coverage_scale(texels, coverage, use.cutoff) : 1.0f;
    for (std::size_t i = 0; i < texels.size(); ++i) {
      srgb.encode(texels[i] * glm::vec4(1.0f, 1.0f, 1.0f, alpha_scale), level + 4 * i);
    }
    texels = halve(side, holes, [&](std::size_t i) { return texels[i]; });
  }
}

std::size_t bucket_of(const Texture& texture) {
  const auto size = static_cast<std::uint32_t>(std::max(texture.width, texture.height));
  const auto found = std::lower_bound(kTextureSides.begin(), kTextureSides.end(), size);
  return std::min<std::size_t>(static_cast<std::size_t>(found - kTextureSides.begin()), kTextureSides.size() - 1);
}

}  // namespace

TextureBuckets build_texture_buckets(const Scene& scene, std::uint32_t most_layers) {
  TextureBuckets result;
  result.slots.assign(scene.textures.size(), glsl::kNoTexture);
  const std::vector<Use> uses = find_uses(scene);
  for (std::size_t t = 0; t < uses.size(); ++t) {
    if (!uses[t].used) continue;
    const std::size_t bucket = bucket_of(scene.textures[t]);
    result.slots[t] = static_cast<std::uint32_t>(bucket) << 16 | result.buckets[bucket].layers++;
  }
  for (std::size_t b = 0; b < result.buckets.size(); ++b) {
    TextureBucket& bucket = result.buckets[b];
    if (bucket.layers == 0) continue;
    bucket.side = kTextureSides[b];
    if (bucket.layers > most_layers)
      throw InputError("scene", std::to_string(bucket.layers) + " textures of " + std::to_string(bucket.side) +
                                    " texels a side; this device holds " + std::to_string(most_layers));
    bucket.mips = static_cast<std::uint32_t>(std::bit_width(bucket.side));
    std::size_t texels = 0;
    for (std::size_t side = bucket.side; side > 0; side /= 2) texels += side * side;
    bucket.texels.resize(texels * 4 * bucket.layers);
  }
  static const SrgbTables srgb;
  tbb::parallel_for(std::size_t{0}, uses.size(), [&](std::size_t t) {
    if (!uses[t].used) return;
    build_layer(srgb, scene.textures[t], uses[t], result.buckets[result.slots[t] >> 16], result.slots[t] & 0xffffu);
  });
  return result;
}

}  // namespace lightwell
