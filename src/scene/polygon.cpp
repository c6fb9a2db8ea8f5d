#include "scene/polygon.h"

#include <algorithm>
#include <cmath>

#include <glm/ext/vector_double2.hpp>
#include <glm/geometric.hpp>

namespace lightwell {

namespace {

constexpr std::uint64_t kWorkPerCorner = 256;  // that every corner adds to what is left

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

// Twice the area of a triangle; positive if it turns left.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return cross(b - a, c - a);
}

// Corners as seen along the polygon's normal, which they turn left about.
std::vector<glm::dvec2> project(std::span<const glm::vec3> corners, const glm::dvec3& normal) {
  const glm::dvec3 size = glm::abs(normal);
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<glm::dvec2> flat;
  flat.reserve(corners.size());
  for (const glm::vec3& corner : corners) {
    const glm::dvec3 from_first = glm::dvec3(corner) - glm::dvec3(corners[0]);
    flat.push_back(normal[axis] < 0.0 ? glm::dvec2(from_first[v], from_first[u])
                                      : glm::dvec2(from_first[u], from_first[v]));
  }
  return flat;
}

// No corner turns right, and all of them together turn once: edges change their vertical direction twice.
bool is_convex(const std::vector<glm::dvec2>& flat) {
  const std::size_t count = flat.size();
  int changes = 0;
  double last = 0.0, first = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec2& a = flat[i];
    const glm::dvec2& b = flat[(i + 1) % count];
    if (turn(a, b, flat[(i + 2) % count]) < 0.0) return false;
    const double rise = b.y - a.y;
    if (rise == 0.0) continue;
    if (last == 0.0) first = rise;
    changes += last != 0.0 && (rise > 0.0) != (last > 0.0);
    last = rise;
  }
  changes += last != 0.0 && (first > 0.0) != (last > 0.0);
  return changes <= 2;
}

// A ring of the corners that are left.
class EarCutter {
 public:
  EarCutter(const std::vector<glm::dvec2>& flat, std::vector<std::uint32_t>& triangles, std::uint64_t& work_left)
      : flat_(flat), triangles_(triangles), work_left_(work_left), next_(flat.size()), previous_(flat.size()) {
    const auto count = static_cast<std::uint32_t>(flat.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      next_[i] = (i + 1) % count;
      previous_[i] = (i + count - 1) % count;
    }
  }

  // False if there was too much work: the rest became a fan.
  bool cut() {
    std::size_t left = flat_.size();
    std::size_t tried = 0;
    std::uint32_t corner = 0;
    while (left > 3) {
      if (work_left_ == 0) break;
      // Where a ring crosses itself no corner may be an ear; any will do then.
      if (tried < left && !is_ear(corner)) {
        corner = next_[corner];
        ++tried;
        continue;
      }
      take(corner);
      remove(corner);
      --left;
      tried = 0;
      // Not the neighbour next: cutting one corner after the other makes slivers.
      corner = next_[next_[corner]];
    }
    const bool finished = left == 3;
    const std::uint32_t first = corner;
    for (std::uint32_t i = next_[first]; next_[i] != first; i = next_[i])
      triangles_.insert(triangles_.end(), {first, i, next_[i]});
    return finished;
  }

 private:
  bool is_ear(std::uint32_t corner) {
    const std::uint32_t before = previous_[corner], after = next_[corner];
    const glm::dvec2 &a = flat_[before], &b = flat_[corner], &c = flat_[after];
    const double area = turn(a, b, c);
    if (!(area >= 0.0)) return false;
    if (area == 0.0) return true;  // on the edge between its neighbours, or at the end of a spike
    for (std::uint32_t i = next_[after]; i != before; i = next_[i]) {
      if (work_left_ > 0) --work_left_;
      const glm::dvec2& p = flat_[i];
      // Corners that lie on one another bridge a hole: they are no obstacle.
      if (p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
    }
    return true;
  }

  void take(std::uint32_t corner) { triangles_.insert(triangles_.end(), {previous_[corner], corner, next_[corner]}); }
  void remove(std::uint32_t corner) {
    next_[previous_[corner]] = next_[corner];
    previous_[next_[corner]] = previous_[corner];
  }

  const std::vector<glm::dvec2>& flat_;
  std::vector<std::uint32_t>& triangles_;
  std::uint64_t& work_left_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> previous_;
};

}  // namespace

glm::dvec3 polygon_area_vector(std::span<const glm::vec3> corners) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += glm::cross(glm::dvec3(corners[i]) - glm::dvec3(corners[0]),
                      glm::dvec3(corners[i + 1]) - glm::dvec3(corners[0]));
  return sum;
}

void Triangulator::triangulate(std::span<const glm::vec3> corners, std::vector<std::uint32_t>& triangles) {
  if (corners.size() < 3) return;
  const auto count = static_cast<std::uint32_t>(corners.size());
  const glm::dvec3 normal = corners.size() > 3 ? polygon_area_vector(corners) : glm::dvec3(0.0);
  const bool has_normal = std::isfinite(normal.x + normal.y + normal.z) && normal != glm::dvec3(0.0);
  const std::vector<glm::dvec2> flat = has_normal ? project(corners, normal) : std::vector<glm::dvec2>{};
  if (!has_normal || is_convex(flat)) {
    for (std::uint32_t i = 1; i + 1 < count; ++i) triangles.insert(triangles.end(), {0, i, i + 1});
    return;
  }
  work_left_ += kWorkPerCorner * count;
  if (!EarCutter(flat, triangles, work_left_).cut()) ++unfinished_;
}

}  // namespace lightwell
