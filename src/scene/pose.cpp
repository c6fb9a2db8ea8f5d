#include "scene/pose.h"

#include <algorithm>
#include <cmath>

#include <glm/ext/matrix_float3x3.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

namespace lightwell {

namespace {

glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& fallback) {
  const float length = glm::length(v);
  return length > 0.0f ? v / length : fallback;
}

float largest_entry(const glm::mat3& m) {
  float largest = 0.0f;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(m[column][row]));
  return largest;
}

// Cofactor matrix: as the inverse transpose up to a factor, and defined for flattening transforms too. The factor's
// sign matters: mirroring must not turn normals inside out. Its size does not: entries are brought near 1 first, so
// that products stay within single precision.
glm::mat3 normal_matrix(const glm::mat4& m) {
  const float largest = largest_entry(glm::mat3(m));
  if (largest == 0.0f) return glm::mat3(1.0f);
  const glm::vec3 x = glm::vec3(m[0]) / largest, y = glm::vec3(m[1]) / largest, z = glm::vec3(m[2]) / largest;
  const glm::mat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
  return glm::dot(x, cofactors[0]) < 0.0f ? -cofactors : cofactors;
}

// Adds weight * offset of every morph target to `values` (glTF 2.0, 3.7.2.2).
std::vector<glm::vec3> morph(std::vector<glm::vec3> values, const Primitive& primitive,
                             const std::vector<float>& weights, std::vector<glm::vec3> MorphTarget::*offsets) {
  const std::size_t count = std::min(weights.size(), primitive.morph_targets.size());
  for (std::size_t t = 0; t < count; ++t) {
    const std::vector<glm::vec3>& offset = primitive.morph_targets[t].*offsets;
    if (weights[t] == 0.0f) continue;
    for (std::size_t v = 0; v < offset.size(); ++v) values[v] += weights[t] * offset[v];
  }
  return values;
}

// Linear blend skinning (glTF 2.0, 3.7.3.3).
glm::mat4 blend_joints(const Primitive& primitive, const MeshInstance& instance, std::size_t vertex) {
  glm::mat4 blend(0.0f);
  for (int k = 0; k < 4; ++k) blend += primitive.weights[vertex][k] * instance.joints[primitive.joints[vertex][k]];
  return blend;
}

glm::vec3 turned(const glm::mat3& normal_matrix, const glm::vec3& normal) {
  return unit_or(normal_matrix * normal, glm::vec3(0.0f, 0.0f, 1.0f));
}

}  // namespace

glm::dmat4 local_transform(const Node& node) {
  if (node.matrix) return *node.matrix;
  const glm::dquat rotation = glm::normalize(glm::dquat(node.rotation));
  return glm::scale(glm::translate(glm::dmat4(1.0), node.translation) * glm::mat4_cast(rotation),
                    glm::dvec3(node.scale));
}

std::vector<glm::dmat4> world_transforms(const std::vector<Node>& nodes, const glm::dvec3& origin) {
  std::vector<glm::dmat4> world;
  world.reserve(nodes.size());
  for (const Node& node : nodes) {
    const glm::dmat4 local = local_transform(node);
    if (node.parent < 0) {
      world.push_back(local);
      world.back()[3] -= glm::dvec4(origin, 0.0);
    } else {
      world.push_back(world[static_cast<std::size_t>(node.parent)] * local);
    }
  }
  return world;
}

MeshInstance make_instance(const Scene& scene, const std::vector<Node>& nodes, const std::vector<glm::dmat4>& world,
                           int node_index) {
  const Node& node = nodes[static_cast<std::size_t>(node_index)];
  MeshInstance instance{
      node.mesh, node_index, glm::mat4(world[static_cast<std::size_t>(node_index)]), {}, node.morph_weights};
  if (instance.morph_weights.empty())
    instance.morph_weights = scene.meshes[static_cast<std::size_t>(node.mesh)].morph_weights;
  if (node.skin < 0) return instance;

  const Skin& skin = scene.skins[static_cast<std::size_t>(node.skin)];
  instance.joints.reserve(skin.joints.size());
  for (std::size_t i = 0; i < skin.joints.size(); ++i)
    instance.joints.emplace_back(world[static_cast<std::size_t>(skin.joints[i])] *
                                 glm::dmat4(skin.inverse_bind_matrices[i]));
  return instance;
}

bool is_skinned(const Primitive& primitive, const MeshInstance& instance) {
  return !primitive.joints.empty() && !instance.joints.empty();
}

bool is_mirrored(const Primitive& primitive, const MeshInstance& instance) {
  const glm::mat4& matrix = is_skinned(primitive, instance) ? instance.joints.front() : instance.to_world;
  return glm::determinant(glm::mat3(matrix)) < 0.0f;
}

std::vector<glm::vec3> pose_positions(const Primitive& primitive, const MeshInstance& instance) {
  std::vector<glm::vec3> positions =
      morph(primitive.positions, primitive, instance.morph_weights, &MorphTarget::positions);
  const bool skinned = is_skinned(primitive, instance);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const glm::mat4 matrix = skinned ? blend_joints(primitive, instance, v) : instance.to_world;
    positions[v] = glm::vec3(matrix * glm::vec4(positions[v], 1.0f));
  }
  return positions;
}

PosedVertices pose_primitive(const Primitive& primitive, const MeshInstance& instance) {
  PosedVertices posed;
  posed.positions = pose_positions(primitive, instance);
  posed.normals = morph(primitive.normals, primitive, instance.morph_weights, &MorphTarget::normals);
  if (is_skinned(primitive, instance)) {
    for (std::size_t v = 0; v < posed.normals.size(); ++v)
      posed.normals[v] = turned(normal_matrix(blend_joints(primitive, instance, v)), posed.normals[v]);
    return posed;
  }
  const glm::mat3 matrix = normal_matrix(instance.to_world);
  for (glm::vec3& normal : posed.normals) normal = turned(matrix, normal);
  return posed;
}

}  // namespace lightwell
