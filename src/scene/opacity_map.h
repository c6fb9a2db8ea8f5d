// Alpha that a file of its own gives (MTL's map_d).
#pragma once

#include "lightwell/image.h"
#include "lightwell/scene.h"

namespace lightwell {

bool has_alpha_below(const Texture& texture, int below);

// Of with_mask()'s result: whichever is larger.
ImageSize masked_size(const Texture* color, const Texture& mask);

// The colours of a texture (null: white) with what `channel` of a mask holds as alpha, named as the mask: 'r', 'g',
// 'b', 'm' (alpha), 'l' (the mean of r, g and b); else its alpha where that is not 255 all over, and 'l' where it is.
Texture with_mask(const Texture* color, const Texture& mask, char channel);

}  // namespace lightwell
