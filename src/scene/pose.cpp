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

void apply_morph_targets(const Primitive& primitive, const std::vector<float>& weights, PosedVertices& posed) {
  const std::size_t count = std::min(weights.size(), primitive.morph_targets.size());
  for (std::size_t t = 0; t < count; ++t) {
    const MorphTarget& target = primitive.morph_targets[t];
    if (weights[t] == 0.0f) continue;
    for (std::size_t v = 0; v < target.positions.size(); ++v) posed.positions[v] += weights[t] * target.positions[v];
    for (std::size_t v = 0; v < target.normals.size(); ++v) posed.normals[v] += weights[t] * target.normals[v];
  }
}

void transform_vertex(const glm::mat4& matrix, const glm::mat3& normal_matrix, glm::vec3& position, glm::vec3& normal) {
  position = glm::vec3(matrix * glm::vec4(position, 1.0f));
  normal = unit_or(normal_matrix * normal, glm::vec3(0.0f, 0.0f, 1.0f));
}

}  // namespace

glm::mat4 local_transform(const Node& node) {
  if (node.matrix) return *node.matrix;
  return glm::scale(glm::translate(glm::mat4(1.0f), node.translation) * glm::mat4_cast(node.rotation), node.scale);
}

std::vector<glm::mat4> world_transforms(const std::vector<Node>& nodes) {
  std::vector<glm::mat4> world;
  world.reserve(nodes.size());
  for (const Node& node : nodes) {
    const glm::mat4 local = local_transform(node);
    world.push_back(node.parent < 0 ? local : world[static_cast<std::size_t>(node.parent)] * local);
  }
  return world;
}

MeshInstance make_instance(const Scene& scene, const std::vector<Node>& nodes, const std::vector<glm::mat4>& world,
                           int node_index) {
  const Node& node = nodes[static_cast<std::size_t>(node_index)];
  MeshInstance instance{node.mesh, node_index, world[static_cast<std::size_t>(node_index)], {}, node.morph_weights};
  if (instance.morph_weights.empty())
    instance.morph_weights = scene.meshes[static_cast<std::size_t>(node.mesh)].morph_weights;
  if (node.skin < 0) return instance;

  const Skin& skin = scene.skins[static_cast<std::size_t>(node.skin)];
  instance.joints.reserve(skin.joints.size());
  for (std::size_t i = 0; i < skin.joints.size(); ++i)
    instance.joints.push_back(world[static_cast<std::size_t>(skin.joints[i])] * skin.inverse_bind_matrices[i]);
  return instance;
}

bool is_skinned(const Primitive& primitive, const MeshInstance& instance) {
  return !primitive.joints.empty() && !instance.joints.empty();
}

bool is_mirrored(const Primitive& primitive, const MeshInstance& instance) {
  const glm::mat4& matrix = is_skinned(primitive, instance) ? instance.joints.front() : instance.to_world;
  return glm::determinant(glm::mat3(matrix)) < 0.0f;
}

PosedVertices pose_primitive(const Primitive& primitive, const MeshInstance& instance) {
  PosedVertices posed{primitive.positions, primitive.normals};
  apply_morph_targets(primitive, instance.morph_weights, posed);

  if (is_skinned(primitive, instance)) {
    for (std::size_t v = 0; v < posed.positions.size(); ++v) {
      glm::mat4 blend(0.0f);
      for (int k = 0; k < 4; ++k) blend += primitive.weights[v][k] * instance.joints[primitive.joints[v][k]];
      transform_vertex(blend, normal_matrix(blend), posed.positions[v], posed.normals[v]);
    }
    return posed;
  }
  const glm::mat3 normals = normal_matrix(instance.to_world);
  for (std::size_t v = 0; v < posed.positions.size(); ++v)
    transform_vertex(instance.to_world, normals, posed.positions[v], posed.normals[v]);
  return posed;
}

}  // namespace lightwell
