#include "reference/flat_scene.h"

#include <cmath>
#include <utility>

#include <glm/ext/matrix_float3x3.hpp>
#include <glm/geometric.hpp>

#include "scene/pose.h"

namespace lightwell {
namespace {

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
    for (const Primitive& primitive : mesh.primitives) {
      const auto first_vertex = static_cast<std::uint32_t>(flat_.vertices.size());
      const bool is_deformed = is_skinned(primitive, instance) || !primitive.morph_targets.empty();
      add_vertices(primitive, is_deformed ? pose_primitive(primitive, instance) : place(primitive, instance.to_world));
      add_triangles(primitive, first_vertex, is_mirrored(primitive, instance));
    }
  }

  // Opaque triangles first, each kind in scene order.
  void finish() {
    flat_.opaque_count = flat_.triangles.size();
    flat_.triangles.insert(flat_.triangles.end(), masked_.begin(), masked_.end());
  }

 private:
  static PosedVertices place(const Primitive& primitive, const glm::mat4& to_world) {
    PosedVertices placed{primitive.positions, primitive.normals};
    const glm::mat3 linear{to_world};
    const glm::mat3 normal_matrix = (glm::determinant(linear) < 0.0f ? -1.0f : 1.0f) * cofactors(linear);
    for (glm::vec3& position : placed.positions) position = glm::vec3{to_world * glm::vec4{position, 1.0f}};
    for (glm::vec3& normal : placed.normals) normal = normalize_or_zero(normal_matrix * normal);
    return placed;
  }

  void add_vertices(const Primitive& primitive, const PosedVertices& posed) {
    const auto texcoord = [&](std::size_t set, std::size_t i) {
      return i < primitive.texcoords[set].size() ? primitive.texcoords[set][i] : glm::vec2{0.0f};
    };
    for (std::size_t i = 0; i < posed.positions.size(); ++i) {
      flat_.vertices.push_back(
          {posed.positions[i], posed.normals[i], {texcoord(0, i), texcoord(1, i), texcoord(2, i), texcoord(3, i)}});
    }
    if (primitive.colors.empty() && flat_.colors.empty()) return;
    flat_.colors.resize(flat_.vertices.size() - posed.positions.size(), glm::vec4{1.0f});
    flat_.colors.insert(flat_.colors.end(), primitive.colors.begin(), primitive.colors.end());
    flat_.colors.resize(flat_.vertices.size(), glm::vec4{1.0f});
  }

  void add_triangles(const Primitive& primitive, std::uint32_t first_vertex, bool mirrored) {
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
  TexcoordSets mixed;
  for (std::size_t set = 0; set < mixed.size(); ++set) mixed[set] = w * a[set] + u * b[set] + v * c[set];
  return mixed;
}

glm::vec4 FlatScene::color(std::size_t triangle, float u, float v) const {
  if (colors.empty()) return glm::vec4{1.0f};
  const std::array<std::uint32_t, 3>& corners = triangles[triangle].vertices;
  return (1.0f - u - v) * colors[corners[0]] + u * colors[corners[1]] + v * colors[corners[2]];
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
