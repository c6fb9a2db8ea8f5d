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

// All but where their indices lie.
std::vector<FlatPart> list_parts(const Scene& scene, const std::vector<MeshInstance>& instances,
                                 const std::vector<bool>& may_move) {
  std::vector<FlatPart> parts;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(instances[i].mesh)].primitives) {
      FlatPart& part = parts.emplace_back();
      part.instance = static_cast<std::uint32_t>(i);
      part.material = static_cast<std::uint32_t>(primitive.material < 0 ? scene.materials.size()
                                                                        : static_cast<std::size_t>(primitive.material));
      part.has_holes = has_holes(scene, primitive);
      part.vertex_count = static_cast<std::uint32_t>(primitive.positions.size());
      part.index_count = static_cast<std::uint32_t>(primitive.indices.size());
    }
  }
  std::uint32_t first_vertex = 0;
  for (const bool moves : {false, true}) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (may_move[i] != moves) continue;
      parts[i].first_vertex = first_vertex;
      first_vertex += parts[i].vertex_count;
    }
  }
  return parts;
}

std::size_t count_vertices(const std::vector<FlatPart>& parts) {
  std::size_t count = 0;
  for (const FlatPart& part : parts) count += part.vertex_count;
  return count;
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

FlatGeometry flatten_geometry(const Scene& scene, const std::vector<MeshInstance>& instances,
                              const std::vector<bool>& may_move) {
  FlatGeometry flat;
  flat.parts = list_parts(scene, instances, may_move);
  // First object vertex of a primitive by mesh, primitive and morph weights: instances of one shape share it.
  std::map<std::tuple<std::size_t, std::size_t, std::vector<float>>, std::uint32_t> shapes;
  flat.sources.resize(count_vertices(flat.parts));
  std::uint32_t part_index = 0;
  for (const MeshInstance& instance : instances) {
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    std::vector<float> weights = mesh.morph_weights;
    if (instance.node >= 0 && !scene.nodes[static_cast<std::size_t>(instance.node)].morph_weights.empty()) {
      weights = scene.nodes[static_cast<std::size_t>(instance.node)].morph_weights;
    }
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p, ++part_index) {
      const Primitive& primitive = mesh.primitives[p];
      FlatPart& part = flat.parts[part_index];
      const auto [shape, added] = shapes.try_emplace({static_cast<std::size_t>(instance.mesh), p, weights},
                                                     static_cast<std::uint32_t>(flat.object_vertices.size()));
      if (added) append_vertices(primitive, weights, flat.object_vertices);
      for (std::uint32_t i = 0; i < part.vertex_count; ++i) {
        flat.sources[part.first_vertex + i] = {shape->second + i, part_index};
      }
      part.first_index = static_cast<std::uint32_t>(flat.indices.size());
      for (const std::uint32_t index : primitive.indices) flat.indices.push_back(part.first_vertex + index);
    }
  }
  return flat;
}

std::vector<glsl::Part> make_parts(const std::vector<FlatPart>& parts, const std::vector<MeshInstance>& instances) {
  std::vector<glsl::Part> made;
  for (const FlatPart& part : parts) {
    const glm::mat4& to_world = instances[part.instance].to_world;
    const glm::mat4 rows = glm::transpose(to_world);
    const float handedness = glm::determinant(glm::mat3(to_world)) < 0.0f ? -1.0f : 1.0f;
    made.push_back({rows[0], rows[1], rows[2], part.material, handedness, 0, 0});
  }
  return made;
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
