#include "core/montage.h"

#include <algorithm>
#include <cstdint>

#include "core/bitmap_font.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

// Label pixels grow with the tile, as far as the longest label fits, and never further than for 20 letters.
int label_scale(int tile_width, const std::vector<MontageTile>& tiles) {
  std::size_t letters = 20;
  for (const MontageTile& tile : tiles) letters = std::max(letters, tile.label.size());
  return std::max(1, (tile_width - 4) / (static_cast<int>(letters) * kGlyphAdvance));
}

void copy_into(Image& into, const Image& tile, int x0, int y0) {
  for (int y = 0; y < tile.height; ++y)
    std::copy_n(tile.at(0, y), static_cast<std::size_t>(tile.width) * 3, into.at(x0, y0 + y));
}

}  // namespace

Image make_montage(const std::vector<MontageTile>& tiles, int columns) {
  if (tiles.empty()) throw InputError("montage", "no pictures given");
  const int width = tiles[0].image.width;
  const int height = tiles[0].image.height;
  for (const MontageTile& tile : tiles) {
    LW_ASSERT(tile.image.channels == 3, "channels: " + std::to_string(tile.image.channels));
    if (tile.image.width != width || tile.image.height != height)
      throw InputError("montage", "pictures of different sizes: " + std::to_string(width) + "x" +
                                      std::to_string(height) + " and " + std::to_string(tile.image.width) + "x" +
                                      std::to_string(tile.image.height));
  }

  const auto count = static_cast<std::int64_t>(tiles.size());
  const std::int64_t across = columns > 0 ? std::min<std::int64_t>(columns, count) : count;
  const std::int64_t down = (count + across - 1) / across;
  const bool labelled = std::ranges::any_of(tiles, [](const MontageTile& tile) { return !tile.label.empty(); });
  const int scale = label_scale(width, tiles);
  const int strip = labelled ? (kGlyphHeight + 4) * scale : 0;
  if (across * width > kMaxImageSide || down * (height + strip) > kMaxImageSide)
    throw InputError("montage",
                     "larger than " + std::to_string(kMaxImageSide) + " pixels a side; use more columns, or fewer");

  Image result(static_cast<int>(across) * width, static_cast<int>(down) * (height + strip));
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const int x = static_cast<int>(static_cast<std::int64_t>(i) % across) * width;
    const int y = static_cast<int>(static_cast<std::int64_t>(i) / across) * (height + strip);
    draw_text(result, tiles[i].label, x + 2 * scale, y + 2 * scale, scale, x + width);
    copy_into(result, tiles[i].image, x, y + strip);
  }
  return result;
}

}  // namespace lightwell
