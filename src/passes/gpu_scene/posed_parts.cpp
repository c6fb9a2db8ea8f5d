#include "passes/gpu_scene/posed_parts.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include <glm/ext/matrix_float3x3.hpp>
#include <glm/matrix.hpp>

#include "lightwell/error.h"

namespace lightwell {
namespace {

glsl::Joint to_rows(const glm::mat4& matrix) {
  const glm::mat4 rows = glm::transpose(matrix);
  return {rows[0], rows[1], rows[2]};
}

void append_morphs(const FlatPart& part, const std::vector<float>& weights, std::vector<glsl::Morph>& morphs) {
  const std::size_t count = std::min<std::size_t>(weights.size(), part.shape.morph_target_count);
  for (std::size_t t = 0; t < count; ++t) {
    if (weights[t] == 0.0f) continue;
    morphs.push_back({weights[t], part.shape.first_morph_offset + static_cast<std::uint32_t>(t) * part.vertex_count});
  }
}

}  // namespace

bool is_skinned(const FlatPart& part, const MeshInstance& instance) {
  return part.shape.joint_count > 0 && !instance.joints.empty();
}

PosedParts pose_parts(const std::vector<FlatPart>& parts, const std::vector<MeshInstance>& instances) {
  PosedParts posed;
  std::size_t joints_of = instances.size();  // the instance whose joints were appended last
  std::uint32_t first_joint = 0;
  for (const FlatPart& part : parts) {
    const MeshInstance& instance = instances[part.instance];
    const bool skinned = is_skinned(part, instance);
    if (skinned && joints_of != part.instance) {
      LW_ASSERT(part.shape.joint_count <= instance.joints.size(),
                "instance " + std::to_string(part.instance) + " has " + std::to_string(instance.joints.size()) +
                    " joints, its mesh uses " + std::to_string(part.shape.joint_count));
      joints_of = part.instance;
      first_joint = static_cast<std::uint32_t>(posed.joints.size());
      for (const glm::mat4& joint : instance.joints) posed.joints.push_back(to_rows(joint));
    }
    // Skins are mirrored as their first joint is: see is_mirrored() of scene/pose.h.
    const glm::mat4& placing = skinned ? instance.joints.front() : instance.to_world;
    const glsl::Joint rows = to_rows(instance.to_world);
    const auto first_morph = static_cast<std::uint32_t>(posed.morphs.size());
    append_morphs(part, instance.morph_weights, posed.morphs);
    posed.parts.push_back({.row_0 = rows.row_0,
                           .row_1 = rows.row_1,
                           .row_2 = rows.row_2,
                           .material = part.material,
                           .handedness = glm::determinant(glm::mat3(placing)) < 0.0f ? -1.0f : 1.0f,
                           .skin_count = skinned ? 1u : 0u,
                           .morph_count = static_cast<std::uint32_t>(posed.morphs.size()) - first_morph,
                           .first_object_vertex = part.shape.first_object_vertex,
                           .first_influence = part.shape.first_influence,
                           .first_joint = first_joint,
                           .first_morph = first_morph});
  }
  return posed;
}

}  // namespace lightwell
