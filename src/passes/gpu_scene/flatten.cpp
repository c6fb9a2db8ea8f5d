#include "passes/gpu_scene/flatten.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "lightwell/error.h"
#include "passes/gpu_scene/texture_buckets.h"

namespace lightwell {
namespace {

// What the colour changes of WorldVertex's two packed words (gpu_scene_types.h); 0 for white.
glm::vec2 pack_color(const glm::vec4& color) {
  const auto missing = [](float value, float most) {
    return static_cast<std::uint32_t>(std::lround((1.0f - std::clamp(value, 0.0f, 1.0f)) * most));
  };
  const std::uint32_t red = missing(std::sqrt(color.r), 4095.0f);
  const std::uint32_t green = missing(std::sqrt(color.g), 4095.0f);
  const std::uint32_t blue = missing(std::sqrt(color.b), 4095.0f);
  const std::uint32_t alpha = missing(color.a, 255.0f);
  return {std::bit_cast<float>((blue >> 6 | alpha << 6) << 16),
          std::bit_cast<float>(red | green << 12 | (blue & 63u) << 24)};
}

// With the sets of texture coordinates that its material uses.
void append_vertices(const Scene& scene, const Primitive& primitive, std::vector<glsl::ObjectVertex>& vertices) {
  static const Material kDefault;
  const Material& material =
      primitive.material < 0 ? kDefault : scene.materials[static_cast<std::size_t>(primitive.material)];
  const auto uv = [&](const TextureRef& ref, std::size_t i) {
    const std::vector<glm::vec2>& set = primitive.texcoords[static_cast<std::size_t>(ref.texcoord)];
    return i < set.size() ? set[i] : glm::vec2(0.0f);
  };
  for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
    const glm::vec2 base = uv(material.base_color_texture, i);
    const glm::vec2 color = primitive.colors.empty() ? glm::vec2(0.0f) : pack_color(primitive.colors[i]);
    vertices.push_back({primitive.positions[i], base.x,
                        i < primitive.normals.size() ? primitive.normals[i] : glm::vec3(0.0f), base.y,
                        glm::vec4(uv(material.emission_texture, i), color)});
  }
}

void append_morph_offsets(const Primitive& primitive, std::vector<glsl::MorphOffset>& offsets) {
  const auto offset = [](const std::vector<glm::vec3>& of, std::size_t i) {
    return glm::vec4(i < of.size() ? of[i] : glm::vec3(0.0f), 0.0f);
  };
  for (const MorphTarget& target : primitive.morph_targets) {
    for (std::size_t i = 0; i < primitive.positions.size(); ++i)
      offsets.push_back({offset(target.positions, i), offset(target.normals, i)});
  }
}

// Appends what all instances of the primitive share.
FlatShape append_shape(const Scene& scene, const Primitive& primitive, FlatGeometry& flat) {
  FlatShape shape;
  shape.bounds = static_cast<std::uint32_t>(flat.shape_bounds.size());
  shape.first_object_vertex = static_cast<std::uint32_t>(flat.object_vertices.size());
  shape.first_influence = static_cast<std::uint32_t>(flat.influences.size());
  shape.first_morph_offset = static_cast<std::uint32_t>(flat.morph_offsets.size());
  shape.morph_target_count = static_cast<std::uint32_t>(primitive.morph_targets.size());
  flat.shape_bounds.push_back(bound_shape(primitive));
  append_vertices(scene, primitive, flat.object_vertices);
  flat.has_colors = flat.has_colors || !primitive.colors.empty();
  append_morph_offsets(primitive, flat.morph_offsets);
  for (std::size_t i = 0; i < primitive.joints.size(); ++i) {
    const glm::uvec4 joints(primitive.joints[i]);
    for (int k = 0; k < 4; ++k) shape.joint_count = std::max(shape.joint_count, joints[k] + 1);
    flat.influences.push_back({primitive.weights[i], joints});
  }
  return shape;
}

// Packs transform and sampling flags of a texture use as gpu_scene_types.h says. `pair`: 0 base colour, 1 emission.
void pack_texture(const Scene& scene, const TextureRef& ref, int pair, const std::vector<std::uint32_t>& slots,
                  glm::vec4& row_0, glm::vec4& row_1, std::uint32_t& slot) {
  slot = ref.texture < 0 ? glsl::kNoTexture : slots[static_cast<std::size_t>(ref.texture)];
  float flags = 0.0f;
  float texels = 0.0f;
  if (ref.texture >= 0) {
    const Texture& texture = scene.textures[static_cast<std::size_t>(ref.texture)];
    flags = static_cast<float>(pair + 2 * static_cast<int>(texture.wrap_u) + 8 * static_cast<int>(texture.wrap_v) +
                               (texture.nearest ? 32 : 0));
    constexpr auto kLargest = static_cast<int>(kTextureSides.back());
    texels = static_cast<float>(std::min(texture.width, kLargest) + 4096 * std::min(texture.height, kLargest));
  }
  const glm::mat3x2& m = ref.transform;
  row_0 = {m[0].x, m[1].x, m[2].x, flags};
  row_1 = {m[0].y, m[1].y, m[2].y, texels};
}

bool emits(const Scene& scene, const Primitive& primitive) {
  return primitive.material >= 0 &&
         scene.materials[static_cast<std::size_t>(primitive.material)].emission != glm::vec3(0.0f);
}

bool has_holes(const Scene& scene, const Primitive& primitive) {
  return primitive.material >= 0 &&
         scene.materials[static_cast<std::size_t>(primitive.material)].alpha_mode != AlphaMode::kOpaque;
}

// Parts without their places among world vertices and indices; appends their shapes.
std::vector<FlatPart> list_parts(const Scene& scene, const std::vector<MeshInstance>& instances, FlatGeometry& flat) {
  std::vector<FlatPart> parts;
  std::map<std::pair<int, std::size_t>, FlatShape> shapes;  // by mesh and primitive
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instances[i].mesh)];
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      const Primitive& primitive = mesh.primitives[p];
      const auto [shape, added] = shapes.try_emplace({instances[i].mesh, p});
      if (added) shape->second = append_shape(scene, primitive, flat);
      FlatPart& part = parts.emplace_back();
      part.shape = shape->second;
      part.instance = static_cast<std::uint32_t>(i);
      part.primitive = static_cast<std::uint32_t>(p);
      part.material = static_cast<std::uint32_t>(primitive.material < 0 ? scene.materials.size()
                                                                        : static_cast<std::size_t>(primitive.material));
      part.has_holes = has_holes(scene, primitive);
      part.emits = emits(scene, primitive);
      part.vertex_count = static_cast<std::uint32_t>(primitive.positions.size());
      part.index_count = static_cast<std::uint32_t>(primitive.indices.size());
    }
  }
  return parts;
}

// Gives each part its world vertices: rigid ones first, and those of either kind that `may_move` together.
void place_vertices(std::vector<FlatPart>& parts, const std::vector<bool>& may_move) {
  std::uint32_t first_vertex = 0;
  const auto place = [&](bool deforms, bool moves) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (is_deformable(parts[i]) != deforms || may_move[i] != moves) continue;
      parts[i].first_vertex = first_vertex;
      first_vertex += parts[i].vertex_count;
    }
  };
  place(false, false);
  place(false, true);
  place(true, true);
  place(true, false);
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

bool is_deformable(const FlatPart& part) {
  return part.shape.joint_count > 0 || part.shape.morph_target_count > 0;
}

FlatGeometry flatten_geometry(const Scene& scene, const std::vector<MeshInstance>& instances,
                              const std::vector<bool>& may_move) {
  FlatGeometry flat;
  flat.parts = list_parts(scene, instances, flat);
  place_vertices(flat.parts, may_move);
  flat.sources.resize(count_vertices(flat.parts));
  for (std::uint32_t p = 0; p < flat.parts.size(); ++p) {
    FlatPart& part = flat.parts[p];
    for (std::uint32_t i = 0; i < part.vertex_count; ++i) {
      flat.sources[part.first_vertex + i] = {part.shape.first_object_vertex + i, p};
    }
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instances[part.instance].mesh)];
    part.first_index = static_cast<std::uint32_t>(flat.indices.size());
    for (const std::uint32_t index : mesh.primitives[part.primitive].indices) {
      flat.indices.push_back(part.first_vertex + index);
    }
  }
  return flat;
}

std::vector<glsl::GpuMaterial> flatten_materials(const Scene& scene, const std::vector<std::uint32_t>& slots) {
  if (scene.materials.size() > glsl::kMaxMaterials)
    throw InputError("scene", std::to_string(scene.materials.size()) + " materials; there may be " +
                                  std::to_string(glsl::kMaxMaterials));
  std::vector<Material> all = scene.materials;
  all.emplace_back();  // of primitives without one
  std::vector<glsl::GpuMaterial> flat;
  for (const Material& material : all) {
    glsl::GpuMaterial& out = flat.emplace_back();
    out.base_color = material.base_color;
    out.emission = glm::vec4(material.emission, material.double_sided ? 1.0f : 0.0f);
    out.alpha_cutoff = alpha_cutoff(material);
    out.unused = 0;
    pack_texture(scene, material.base_color_texture, 0, slots, out.base_transform_0, out.base_transform_1,
                 out.base_texture);
    pack_texture(scene, material.emission_texture, 1, slots, out.emission_transform_0, out.emission_transform_1,
                 out.emission_texture);
  }
  return flat;
}

}  // namespace lightwell
