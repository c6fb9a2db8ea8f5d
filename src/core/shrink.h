// Smaller copies of images.
#pragma once

#include "lightwell/image.h"

namespace lightwell {

// `width` x `height` pixels, neither more than the image has: each the mean of what it covers, so that the image's mean
// stays.
Image shrink(const Image& image, int width, int height);

}  // namespace lightwell
