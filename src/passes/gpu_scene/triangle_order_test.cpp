#include "passes/gpu_scene/triangle_order.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

// Part i is one triangle of the indices 3i, 3i + 1, 3i + 2.
std::vector<FlatPart> one_triangle_parts(const std::vector<bool>& has_holes) {
  std::vector<FlatPart> parts;
  for (std::uint32_t i = 0; i < has_holes.size(); ++i)
    parts.push_back({.has_holes = has_holes[i], .first_index = 3 * i, .index_count = 3});
  return parts;
}

TEST(TriangleOrder, OpaqueFirstAndMovingTogether) {
  std::vector<std::uint32_t> indices(24);
  for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
  const std::vector<bool> has_holes{true, false, true, false, false, true, false, false};
  const std::vector<bool> moving{true, true, false, false, true, true, false, false};
  const OrderedTriangles ordered = order_triangles(one_triangle_parts(has_holes), indices, moving);
  EXPECT_EQ(ordered.opaque_triangle_count, 5u);
  EXPECT_EQ(ordered.moving_first, 3u);
  EXPECT_EQ(ordered.moving_count, 4u);
  EXPECT_EQ(ordered.parts, (std::vector<std::uint32_t>{3, 6, 7, 1, 4, 0, 5, 2}));
  std::vector<std::uint32_t> parts;
  for (std::size_t i = 0; i < ordered.indices.size(); i += 3) parts.push_back(ordered.indices[i] / 3);
  EXPECT_EQ(parts, ordered.parts);
}

TEST(TriangleOrder, EmissiveTrianglesAreListedWhereTheyCameToLie) {
  std::vector<FlatPart> parts = one_triangle_parts({true, false, false, false});
  parts[1].emits = parts[0].emits = true;
  std::vector<std::uint32_t> indices(12);
  for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
  EXPECT_EQ(order_triangles(parts, indices, {false, false, false, false}).emissive, (std::vector<std::uint32_t>{0, 3}));
  EXPECT_EQ(order_triangles(parts, indices, {false, true, false, false}).emissive, (std::vector<std::uint32_t>{2, 3}));
}

TEST(TriangleOrder, WithoutMovementTheRangeIsEmpty) {
  const OrderedTriangles ordered =
      order_triangles(one_triangle_parts({false, true}), {0, 1, 2, 3, 4, 5}, {false, false});
  EXPECT_EQ(ordered.moving_count, 0u);
  EXPECT_EQ(ordered.indices, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
}

}  // namespace
}  // namespace lightwell
