// Boxes round parts in the world, in any pose, without visiting their vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "lightwell/scene.h"

namespace lightwell {

// What bounds a primitive in any pose: its vertices' object-space bounds, and what may move them apart.
struct ShapeBounds {
  struct Joint {
    std::uint32_t joint = 0;  // of the instance's
    Bounds bounds;            // of the vertices that it influences
  };
  Bounds vertices;
  std::vector<Joint> joints;          // those that influence a vertex, rising
  std::vector<Bounds> morph_offsets;  // of all vertices, one a morph target
  // How far the weights of a vertex's joints are from a weighted mean, whose weights are not negative and sum to 1.
  float weight_error = 0.0f;
};

ShapeBounds bound_shape(const Primitive& primitive);

// Holds every vertex of the part that `instance` shows of the primitive, with its shader's rounding; usually larger
// than needed where parts turn or are deformed. Infinite where a coordinate is not finite.
Bounds bound_part(const ShapeBounds& shape, const MeshInstance& instance);

}  // namespace lightwell
