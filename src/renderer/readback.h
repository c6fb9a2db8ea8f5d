// Bytes that came back from the GPU, as images.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "graph/frame_graph.h"
#include "lightwell/picture.h"

namespace lightwell {

// The first three channels of an image's texels (the missing ones 0; one channel fills all three).
Image decode_texels(const ImageDesc& desc, const std::vector<std::byte>& bytes);

// The picture from the sums of `samples` frames (passes/combine/combine.h: Film). `eye_behind`: DeclaredView's.
Picture develop_film(const std::array<std::vector<std::byte>, 5>& film, int width, int height, int samples,
                     float eye_behind);

}  // namespace lightwell
