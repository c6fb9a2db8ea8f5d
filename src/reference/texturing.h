// Texture lookups without mip maps: the anti-aliasing of the reference is its many samples.
#pragma once

#include <array>

#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_float4.hpp>

#include "lightwell/scene.h"

namespace lightwell {

using TexcoordSets = std::array<glm::vec2, kTexcoordSets>;

// Linear RGB and alpha, bilinear between texels that were decoded from sRGB first. (0, 0) is the outer corner of the
// first texel.
glm::vec4 sample_texture(const Texture& texture, glm::vec2 uv);

// Factor times texture; the factor alone where there is no texture.
glm::vec4 base_color(const Scene& scene, const Material& material, const TexcoordSets& texcoords);
glm::vec3 emitted_radiance(const Scene& scene, const Material& material, const TexcoordSets& texcoords);

// Whether light passes here: kMask below its cutoff, kBlend below 0.5. `vertex_alpha`: of the vertex colours.
bool is_cut_out(const Scene& scene, const Material& material, const TexcoordSets& texcoords, float vertex_alpha);

}  // namespace lightwell
