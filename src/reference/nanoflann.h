// The one place that knows which nanoflann there is: 1.4 (Debian 12) or later, where the search parameters have
// another name.
#pragma once

#include <nanoflann.hpp>

namespace lightwell {

// Gives `neighbors` the points of `tree` that are nearer to `point` than neighbors.worstDist(), a squared distance, in
// no order: addPoint(squared distance, index) is called until it is false. Later versions want sort(), which is not
// called.
template <class Tree, class Neighbors>
void find_neighbors(const Tree& tree, Neighbors& neighbors, const float* point) {
#if NANOFLANN_VERSION >= 0x150
  tree.findNeighbors(neighbors, point, nanoflann::SearchParameters(0.0f, false));
#else
  tree.findNeighbors(neighbors, point, nanoflann::SearchParams(0, 0.0f, false));
#endif
}

}  // namespace lightwell
