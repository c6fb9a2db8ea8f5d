#include "reference/flat_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/ext/matrix_float3x3.hpp>
#include <glm/geometric.hpp>

namespace lightwell {
namespace {

// sum over targets of weight * offset, added to `base` (glTF 2.0, Sec. 3.7.2.2).
void add_morph_offsets(std::vector<glm::vec3>& base, const Primitive& primitive, const std::vector<float>& weights,
                       std::vector<glm::vec3> MorphTarget::*offsets) {
  for (std::size_t t = 0; t < std::min(weights.size(), primitive.morph_targets.size()); ++t) {
    const std::vector<glm::vec3>& offset = primitive.morph_targets[t].*offsets;
    for (std::size_t i = 0; i < std::min(base.size(), offset.size()); ++i) base[i] += weights[t] * offset[i];
  }
}

glm::vec3 normalize_or_zero(const glm::vec3& v) {
  const float length = glm::length(v);
  return length > 0.0f && std::isfinite(length) ? v / length : glm::vec3{0.0f};
}

// Normals transform with the cofactors of the matrix: its inverse transpose times its determinant, which unlike the
// inverse exists for flattening transforms too.
glm::mat3 cofactors(const glm::mat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

class Flattener {
 public:
  Flattener(const Scene& scene, FlatScene& flat) : scene_(scene), flat_(flat) {}

  void add_instance(const MeshInstance& instance) {
    const Mesh& mesh = scene_.meshes[static_cast<std::size_t>(instance.mesh)];
    const std::vector<float>* weights = &mesh.morph_weights;
    if (instance.node >= 0) {
      const Node& node = scene_.nodes[static_cast<std::size_t>(instance.node)];
      if (!node.morph_weights.empty()) weights = &node.morph_weights;
    }
    for (const Primitive& primitive : mesh.primitives) add_primitive(primitive, instance.to_world, *weights);
  }

  // Opaque triangles first, each kind in scene order.
  void finish() {
    flat_.opaque_count = flat_.triangles.size();
    flat_.triangles.insert(flat_.triangles.end(), masked_.begin(), masked_.end());
  }

 private:
  void add_primitive(const Primitive& primitive, const glm::mat4& to_world, const std::vector<float>& weights) {
    const auto first_vertex = static_cast<std::uint32_t>(flat_.vertices.size());
    add_vertices(primitive, to_world, weights);
    const bool mirrored = glm::determinant(glm::mat3{to_world}) < 0.0f;
    const std::size_t material =
        primitive.material >= 0 ? static_cast<std::size_t>(primitive.material) : flat_.materials.size() - 1;
    const bool masked = flat_.materials[material].alpha_mode != AlphaMode::kOpaque;
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
      FlatTriangle triangle{{first_vertex + primitive.indices[i], first_vertex + primitive.indices[i + 1],
                             first_vertex + primitive.indices[i + 2]},
                            static_cast<std::uint32_t>(material)};
      if (mirrored) std::swap(triangle.vertices[1], triangle.vertices[2]);
      if (has_area(triangle)) (masked ? masked_ : flat_.triangles).push_back(triangle);
    }
  }

  void add_vertices(const Primitive& primitive, const glm::mat4& to_world, const std::vector<float>& weights) {
    std::vector<glm::vec3> positions = primitive.positions;
    std::vector<glm::vec3> normals = primitive.normals;
    add_morph_offsets(positions, primitive, weights, &MorphTarget::positions);
    add_morph_offsets(normals, primitive, weights, &MorphTarget::normals);
    const glm::mat3 linear{to_world};
    const glm::mat3 normal_matrix = (glm::determinant(linear) < 0.0f ? -1.0f : 1.0f) * cofactors(linear);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      FlatVertex vertex{glm::vec3{to_world * glm::vec4{positions[i], 1.0f}},
                        i < normals.size() ? normalize_or_zero(normal_matrix * normals[i]) : glm::vec3{0.0f},
                        {}};
      for (std::size_t set = 0; set < vertex.texcoords.size(); ++set) {
        const std::vector<glm::vec2>& texcoords = primitive.texcoords[set];
        vertex.texcoords[set] = i < texcoords.size() ? texcoords[i] : glm::vec2{0.0f};
      }
      flat_.vertices.push_back(vertex);
    }
  }

  bool has_area(const FlatTriangle& triangle) const {
    const glm::vec3& a = flat_.vertices[triangle.vertices[0]].position;
    const glm::vec3 normal = glm::cross(flat_.vertices[triangle.vertices[1]].position - a,
                                        flat_.vertices[triangle.vertices[2]].position - a);
    const float length = glm::length(normal);
    return length > 0.0f && std::isfinite(length);
  }

  const Scene& scene_;
  FlatScene& flat_;
  std::vector<FlatTriangle> masked_;
};

}  // namespace

glm::vec3 FlatScene::area_normal(std::size_t triangle) const {
  const glm::vec3& a = corner(triangle, 0).position;
  return glm::cross(corner(triangle, 1).position - a, corner(triangle, 2).position - a);
}

glm::vec3 FlatScene::position(std::size_t triangle, float u, float v) const {
  return (1.0f - u - v) * corner(triangle, 0).position + u * corner(triangle, 1).position +
         v * corner(triangle, 2).position;
}

TexcoordSets FlatScene::texcoords(std::size_t triangle, float u, float v) const {
  const TexcoordSets& a = corner(triangle, 0).texcoords;
  const TexcoordSets& b = corner(triangle, 1).texcoords;
  const TexcoordSets& c = corner(triangle, 2).texcoords;
  const float w = 1.0f - u - v;
  return {w * a[0] + u * b[0] + v * c[0], w * a[1] + u * b[1] + v * c[1]};
}

FlatScene flatten(const Scene& scene, const SceneSnapshot& snapshot) {
  FlatScene flat;
  flat.scene = &scene;
  flat.materials = scene.materials;
  flat.materials.emplace_back();
  Flattener flattener(scene, flat);
  for (const MeshInstance& instance : snapshot.instances) flattener.add_instance(instance);
  flattener.finish();
  return flat;
}

}  // namespace lightwell
