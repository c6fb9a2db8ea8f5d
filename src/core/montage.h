// Pictures side by side, with names above them.
#pragma once

#include <string>
#include <vector>

#include "lightwell/image.h"

namespace lightwell {

struct MontageTile {
  Image image;        // display-ready, 3 channels, values in [0,1]
  std::string label;  // shown in capitals; what does not fit is cut
};

// Tiles in rows of `columns` (0: all in one row). If any tile has a label, every tile gets a strip for it. Throws
// InputError if there are no tiles, sizes differ, or the result is larger than an image may be.
Image make_montage(const std::vector<MontageTile>& tiles, int columns = 0);

}  // namespace lightwell
