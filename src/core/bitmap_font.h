// Capitals, digits and a few signs of 5x7 pixels: enough for labels in pictures.
#pragma once

#include <string_view>

#include "lightwell/image.h"

namespace lightwell {

inline constexpr int kGlyphWidth = 5;
inline constexpr int kGlyphHeight = 7;
inline constexpr int kGlyphAdvance = 6;

// Draws `text` in white with its upper left corner at (x, y), each glyph pixel `scale` pixels wide, and stops before
// x_end. Unknown characters are blank; letters are drawn as capitals. What lies outside the image is not drawn.
void draw_text(Image& image, std::string_view text, int x, int y, int scale, int x_end);

}  // namespace lightwell
