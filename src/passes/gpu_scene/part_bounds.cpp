#include "passes/gpu_scene/part_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace lightwell {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
const Bounds kEmpty{glm::vec3(kInfinity), glm::vec3(-kInfinity)};

// Some sums of three or four products, each rounded.
constexpr float kRounding = 1e-6f;

void add_point(Bounds& bounds, const glm::vec3& point) {
  bounds = {glm::min(bounds.minimum, point), glm::max(bounds.maximum, point)};
}

Bounds bound_points(const std::vector<glm::vec3>& points) {
  Bounds bounds = points.empty() ? Bounds{} : kEmpty;
  for (const glm::vec3& point : points) add_point(bounds, point);
  return bounds;
}

// Sum |w| of negative weights, and what the others sum to beside 1.
float weight_error(const glm::vec4& weights) {
  float positive = 0.0f;
  float negative = 0.0f;
  for (int k = 0; k < 4; ++k) (weights[k] < 0.0f ? negative : positive) += std::abs(weights[k]);
  return std::abs(positive - 1.0f) + negative;
}

// The box of `vertices` as morphed: each offset adds something between its least and its largest, times its weight.
Bounds grow(const Bounds& vertices, const Bounds& offsets) {
  return {vertices.minimum + offsets.minimum, vertices.maximum + offsets.maximum};
}

Bounds bound_offsets(const ShapeBounds& shape, const std::vector<float>& weights) {
  Bounds sum;
  for (std::size_t t = 0; t < std::min(weights.size(), shape.morph_offsets.size()); ++t) {
    const glm::vec3 a = weights[t] * shape.morph_offsets[t].minimum;
    const glm::vec3 b = weights[t] * shape.morph_offsets[t].maximum;
    const glm::vec3 rounding = kRounding * glm::max(glm::abs(a), glm::abs(b));
    sum = grow(sum, {glm::min(a, b) - rounding, glm::max(a, b) + rounding});
  }
  return sum;
}

// A growing box in the world, and the largest sum of |terms| that any of its coordinates was computed from.
struct WorldBox {
  Bounds bounds = kEmpty;
  float magnitude = 0.0f;

  // The box round a transformed box: its centre is transformed, its half sides by the matrix' absolute values.
  void add(const glm::mat4& to_world, const Bounds& box) {
    const glm::vec3 center = 0.5f * (box.minimum + box.maximum);
    const glm::vec3 half = 0.5f * (box.maximum - box.minimum);
    const glm::mat3 linear(to_world);
    const glm::mat3 absolute(glm::abs(linear[0]), glm::abs(linear[1]), glm::abs(linear[2]));
    const glm::vec3 offset(to_world[3]);
    const glm::vec3 world_center = linear * center + offset;
    const glm::vec3 world_half = absolute * half;
    add_point(bounds, world_center - world_half);
    add_point(bounds, world_center + world_half);
    const glm::vec3 terms = absolute * (glm::abs(center) + half) + glm::abs(offset);
    magnitude = std::max({magnitude, terms.x, terms.y, terms.z});
    if (!std::isfinite(terms.x + terms.y + terms.z)) magnitude = kInfinity;
  }

  Bounds grown(float relative) const {
    if (!std::isfinite(magnitude)) return {glm::vec3(-kInfinity), glm::vec3(kInfinity)};
    return {bounds.minimum - relative * magnitude, bounds.maximum + relative * magnitude};
  }
};

}  // namespace

ShapeBounds bound_shape(const Primitive& primitive) {
  ShapeBounds shape;
  shape.vertices = bound_points(primitive.positions);
  for (const MorphTarget& target : primitive.morph_targets)
    shape.morph_offsets.push_back(bound_points(target.positions));
  std::map<std::uint32_t, Bounds> joints;
  for (std::size_t i = 0; i < primitive.joints.size(); ++i) {
    const glm::vec4& weights = primitive.weights[i];
    shape.weight_error = std::max(shape.weight_error, weight_error(weights));
    for (int k = 0; k < 4; ++k)
      if (weights[k] != 0.0f)
        add_point(joints.try_emplace(primitive.joints[i][k], kEmpty).first->second, primitive.positions[i]);
  }
  for (const auto& [joint, bounds] : joints) shape.joints.push_back({joint, bounds});
  return shape;
}

// A skinned vertex is a weighted mean of where its joints would place it, so it lies in the box round those places.
Bounds bound_part(const ShapeBounds& shape, const MeshInstance& instance) {
  const Bounds offsets = bound_offsets(shape, instance.morph_weights);
  WorldBox box;
  if (shape.joints.empty() || instance.joints.empty()) {
    box.add(instance.to_world, grow(shape.vertices, offsets));
    return box.grown(kRounding);
  }
  for (const ShapeBounds::Joint& joint : shape.joints)
    box.add(instance.joints[joint.joint], grow(joint.bounds, offsets));
  return box.grown(kRounding + shape.weight_error);
}

}  // namespace lightwell
