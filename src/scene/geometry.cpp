#include "scene/geometry.h"

#include <cmath>
#include <numeric>

#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>

namespace lightwell {

namespace {

// Twice the area vector. In double precision: edges of any float length neither overflow nor cancel to nothing.
glm::dvec3 area_vector(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
}

// Zero if the vector has no direction.
glm::vec3 unit_or_zero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0.0 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0.0f);
}

template <typename T>
std::vector<T> gather(const std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
  std::vector<T> gathered;
  if (values.empty()) return gathered;
  gathered.reserve(indices.size());
  for (const std::uint32_t i : indices) gathered.push_back(values[i]);
  return gathered;
}

}  // namespace

glm::vec3 triangle_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::vec3 normal = unit_or_zero(area_vector(a, b, c));
  return normal == glm::vec3(0.0f) ? glm::vec3(0.0f, 0.0f, 1.0f) : normal;
}

namespace {

// One a vertex; every three vertices are a triangle.
std::vector<glm::vec3> flat_normals(const std::vector<glm::vec3>& positions) {
  std::vector<glm::vec3> normals(positions.size());
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
    const glm::vec3 normal = triangle_normal(positions[i], positions[i + 1], positions[i + 2]);
    for (std::size_t k = 0; k < 3; ++k) normals[i + k] = normal;
  }
  return normals;
}

}  // namespace

Primitive with_own_vertices(const Primitive& primitive, const std::vector<std::uint32_t>& indices) {
  Primitive own;
  own.material = primitive.material;
  own.positions = gather(primitive.positions, indices);
  own.normals = gather(primitive.normals, indices);
  for (std::size_t set = 0; set < own.texcoords.size(); ++set)
    own.texcoords[set] = gather(primitive.texcoords[set], indices);
  own.colors = gather(primitive.colors, indices);
  own.joints = gather(primitive.joints, indices);
  own.weights = gather(primitive.weights, indices);
  for (const MorphTarget& target : primitive.morph_targets)
    own.morph_targets.push_back({gather(target.positions, indices), gather(target.normals, indices)});
  own.indices.resize(indices.size());
  std::iota(own.indices.begin(), own.indices.end(), 0u);
  return own;
}

bool FarVertices::add(const glm::dvec3& position) {
  if (!std::isfinite(position.x + position.y + position.z)) return !near_;
  minimum_ = any_ ? glm::min(minimum_, position) : position;
  maximum_ = any_ ? glm::max(maximum_, position) : position;
  any_ = true;
  constexpr double kNear = 256.0;  // m: choose_origin() finds no scene far that has a vertex so near
  near_ = near_ || glm::length(position) < kNear;
  return !near_;
}

glm::dvec3 FarVertices::base() const {
  return any_ && !near_ ? choose_origin({glm::vec3(minimum_), glm::vec3(maximum_)}) : glm::dvec3(0.0);
}

void make_flat(Primitive& primitive) {
  primitive.normals.clear();
  for (MorphTarget& target : primitive.morph_targets) target.normals.clear();
  primitive = with_own_vertices(primitive, primitive.indices);
  primitive.normals = flat_normals(primitive.positions);
  for (MorphTarget& target : primitive.morph_targets) {
    if (target.positions.empty()) continue;
    std::vector<glm::vec3> moved = primitive.positions;
    for (std::size_t v = 0; v < moved.size(); ++v) moved[v] += target.positions[v];
    target.normals = flat_normals(moved);
    for (std::size_t v = 0; v < moved.size(); ++v) target.normals[v] -= primitive.normals[v];
  }
}

void repair_normals(Primitive& primitive) {
  bool complete = true;
  for (glm::vec3& normal : primitive.normals) {
    normal = unit_or_zero(glm::dvec3(normal));
    complete = complete && normal != glm::vec3(0.0f);
  }
  if (complete) return;

  std::vector<glm::dvec3> sums(primitive.normals.size(), glm::dvec3(0.0));
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    const std::uint32_t* t = &primitive.indices[i];
    const glm::dvec3 area =
        area_vector(primitive.positions[t[0]], primitive.positions[t[1]], primitive.positions[t[2]]);
    for (int k = 0; k < 3; ++k) sums[t[k]] += area;
  }
  for (std::size_t v = 0; v < sums.size(); ++v) {
    glm::vec3& normal = primitive.normals[v];
    if (normal == glm::vec3(0.0f)) normal = unit_or_zero(sums[v]);
    if (normal == glm::vec3(0.0f)) normal = glm::vec3(0.0f, 0.0f, 1.0f);
  }
}

std::vector<std::uint32_t> triangles_of_strip(const std::vector<std::uint32_t>& strip) {
  std::vector<std::uint32_t> triangles;
  if (strip.size() < 3) return triangles;
  triangles.reserve((strip.size() - 2) * 3);
  for (std::size_t i = 0; i + 2 < strip.size(); ++i) {
    const std::size_t odd = i % 2;
    triangles.insert(triangles.end(), {strip[i], strip[i + 1 + odd], strip[i + 2 - odd]});
  }
  return triangles;
}

std::vector<std::uint32_t> triangles_of_fan(const std::vector<std::uint32_t>& fan) {
  std::vector<std::uint32_t> triangles;
  if (fan.size() < 3) return triangles;
  triangles.reserve((fan.size() - 2) * 3);
  for (std::size_t i = 1; i + 1 < fan.size(); ++i) triangles.insert(triangles.end(), {fan[0], fan[i], fan[i + 1]});
  return triangles;
}

}  // namespace lightwell
