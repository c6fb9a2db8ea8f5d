#include "core/shrink.h"

#include <algorithm>
#include <vector>

#include "lightwell/error.h"

namespace lightwell {

namespace {

// The share of one old pixel in a new one.
struct Share {
  int from;
  int to;
  float weight;
};

// Along one axis. The weights of each new pixel sum to 1.
std::vector<Share> shares(int old_size, int new_size) {
  std::vector<Share> all;
  const double ratio = static_cast<double>(old_size) / new_size;
  for (int to = 0; to < new_size; ++to) {
    const double first = to * ratio, last = (to + 1) * ratio;
    for (int from = static_cast<int>(first); from < old_size && from < last; ++from) {
      const double covered = std::min(last, from + 1.0) - std::max(first, static_cast<double>(from));
      if (covered > 0.0) all.push_back({from, to, static_cast<float>(covered / ratio)});
    }
  }
  return all;
}

}  // namespace

Image shrink(const Image& image, int width, int height) {
  LW_ASSERT(width > 0 && height > 0 && width <= image.width && height <= image.height,
            std::to_string(width) + "x" + std::to_string(height));
  Image result(width, height, image.channels);
  const std::vector<Share> columns = shares(image.width, width);
  for (const Share& row : shares(image.height, height))
    for (const Share& column : columns) {
      const float* from = image.at(column.from, row.from);
      float* to = result.at(column.to, row.to);
      for (int c = 0; c < image.channels; ++c) to[c] += row.weight * column.weight * from[c];
    }
  return result;
}

}  // namespace lightwell
