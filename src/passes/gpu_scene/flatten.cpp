#include "passes/gpu_scene/flatten.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace lightwell {
namespace {

constexpr std::uint32_t kNoTexture = 0xffffffffu;

// sum over targets of weight * offset, added to `base` (glTF 2.0, Sec. 3.7.2.2).
std::vector<glm::vec3> morph(std::vector<glm::vec3> base, const Primitive& primitive, const std::vector<float>& weights,
                             std::vector<glm::vec3> MorphTarget::*offsets) {
  for (std::size_t t = 0; t < std::min(weights.size(), primitive.morph_targets.size()); ++t) {
    const std::vector<glm::vec3>& offset = primitive.morph_targets[t].*offsets;
    for (std::size_t i = 0; i < std::min(base.size(), offset.size()); ++i) base[i] += weights[t] * offset[i];
  }
  return base;
}

void append_vertices(const Primitive& primitive, const std::vector<float>& morph_weights,
                     std::vector<glsl::ObjectVertex>& vertices) {
  const auto positions = morph(primitive.positions, primitive, morph_weights, &MorphTarget::positions);
  const auto normals = morph(primitive.normals, primitive, morph_weights, &MorphTarget::normals);
  const auto uv = [&](std::size_t set, std::size_t i) {
    return i < primitive.texcoords[set].size() ? primitive.texcoords[set][i] : glm::vec2(0.0f);
  };
  for (std::size_t i = 0; i < positions.size(); ++i) {
    vertices.push_back({positions[i], uv(0, i).x, i < normals.size() ? normals[i] : glm::vec3(0.0f), uv(0, i).y,
                        glm::vec4(uv(1, i), 0.0f, 0.0f)});
  }
}

// Packs transform and sampling flags of a texture use as gpu_scene_types.h says.
void pack_texture(const Scene& scene, const TextureRef& ref, const std::vector<std::uint32_t>& slots, glm::vec4& row_0,
                  glm::vec4& row_1, std::uint32_t& slot) {
  slot = ref.texture < 0 ? kNoTexture : slots[static_cast<std::size_t>(ref.texture)];
  float flags = 0.0f;
  if (ref.texture >= 0) {
    const Texture& texture = scene.textures[static_cast<std::size_t>(ref.texture)];
    flags = static_cast<float>(ref.texcoord + 2 * static_cast<int>(texture.wrap_u) +
                               8 * static_cast<int>(texture.wrap_v) + (texture.nearest ? 32 : 0));
  }
  const glm::mat3x2& m = ref.transform;
  row_0 = {m[0].x, m[1].x, m[2].x, flags};
  row_1 = {m[0].y, m[1].y, m[2].y, 0.0f};
}

bool has_holes(const Scene& scene, const Primitive& primitive) {
  return primitive.material >= 0 &&
         scene.materials[static_cast<std::size_t>(primitive.material)].alpha_mode != AlphaMode::kOpaque;
}

float alpha_cutoff(const Material& material) {
  switch (material.alpha_mode) {
    case AlphaMode::kOpaque:
      return 0.0f;
    case AlphaMode::kMask:
      return material.alpha_cutoff;
    case AlphaMode::kBlend:
      return 0.5f;
  }
  return 0.0f;
}

}  // namespace

PrimitiveMaterials list_primitive_materials(const Scene& scene) {
  PrimitiveMaterials materials(scene.meshes.size());
  for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    for (const Primitive& primitive : scene.meshes[mesh].primitives) {
      materials[mesh].push_back(static_cast<std::uint32_t>(
          primitive.material < 0 ? scene.materials.size() : static_cast<std::size_t>(primitive.material)));
    }
  }
  return materials;
}

std::vector<glsl::Part> make_parts(const PrimitiveMaterials& materials, const std::vector<MeshInstance>& instances) {
  std::vector<glsl::Part> parts;
  for (const MeshInstance& instance : instances) {
    const glm::mat4 rows = glm::transpose(instance.to_world);
    const float handedness = glm::determinant(glm::mat3(instance.to_world)) < 0.0f ? -1.0f : 1.0f;
    for (const std::uint32_t material : materials[static_cast<std::size_t>(instance.mesh)]) {
      parts.push_back({rows[0], rows[1], rows[2], material, handedness, 0, 0});
    }
  }
  return parts;
}

FlatGeometry flatten_geometry(const Scene& scene, const std::vector<MeshInstance>& instances) {
  FlatGeometry flat;
  // First object vertex of a primitive by mesh, primitive and morph weights: instances of one shape share it.
  std::map<std::tuple<std::size_t, std::size_t, std::vector<float>>, std::uint32_t> shapes;
  std::vector<std::uint32_t> masked;
  std::uint32_t part = 0;
  for (const MeshInstance& instance : instances) {
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    std::vector<float> weights = mesh.morph_weights;
    if (instance.node >= 0 && !scene.nodes[static_cast<std::size_t>(instance.node)].morph_weights.empty()) {
      weights = scene.nodes[static_cast<std::size_t>(instance.node)].morph_weights;
    }
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p, ++part) {
      const Primitive& primitive = mesh.primitives[p];
      const auto [shape, added] = shapes.try_emplace({static_cast<std::size_t>(instance.mesh), p, weights},
                                                     static_cast<std::uint32_t>(flat.object_vertices.size()));
      if (added) append_vertices(primitive, weights, flat.object_vertices);
      const auto base = static_cast<std::uint32_t>(flat.sources.size());
      for (std::uint32_t i = 0; i < primitive.positions.size(); ++i) {
        flat.sources.push_back({shape->second + i, part});
      }
      std::vector<std::uint32_t>& indices = has_holes(scene, primitive) ? masked : flat.indices;
      for (const std::uint32_t index : primitive.indices) indices.push_back(base + index);
    }
  }
  flat.opaque_triangle_count = static_cast<std::uint32_t>(flat.indices.size() / 3);
  flat.indices.insert(flat.indices.end(), masked.begin(), masked.end());
  return flat;
}

std::vector<glsl::GpuMaterial> flatten_materials(const Scene& scene, const std::vector<std::uint32_t>& slots) {
  std::vector<Material> all = scene.materials;
  all.emplace_back();  // of primitives without one
  std::vector<glsl::GpuMaterial> flat;
  for (const Material& material : all) {
    glsl::GpuMaterial& out = flat.emplace_back();
    out.base_color = material.base_color;
    out.emission = glm::vec4(material.emission, material.double_sided ? 1.0f : 0.0f);
    out.alpha_cutoff = alpha_cutoff(material);
    out.unused = 0;
    pack_texture(scene, material.base_color_texture, slots, out.base_transform_0, out.base_transform_1,
                 out.base_texture);
    pack_texture(scene, material.emission_texture, slots, out.emission_transform_0, out.emission_transform_1,
                 out.emission_texture);
  }
  return flat;
}

}  // namespace lightwell
