// GIF textures by giflib: the first frame, on its canvas.
#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

#include "core/image_formats.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

// Of LZW: strings of up to 4096 pixels in codes of 12 bits.
constexpr std::int64_t kMaxPixelsPerByte = 4096;

struct GifCloser {
  void operator()(GifFileType* gif) const { DGifCloseFile(gif, nullptr); }
};
using Gif = std::unique_ptr<GifFileType, GifCloser>;

[[noreturn]] void fail(const std::string& subject, const char* reason) {
  throw InputError(subject, std::string("damaged GIF file: ") + (reason ? reason : "it cannot be decoded"));
}

int read_gif(GifFileType* gif, GifByteType* out, int wanted) {
  auto& rest = *static_cast<Bytes*>(gif->UserData);
  const std::size_t count = std::min(static_cast<std::size_t>(std::max(wanted, 0)), rest.size());
  if (count > 0) std::memcpy(out, rest.data(), count);
  rest = rest.subspan(count);
  return static_cast<int>(count);
}

// `rest` outlives the result.
Gif open_gif(const std::string& subject, Bytes& rest) {
  const std::size_t file_bytes = rest.size();
  int error = 0;
  Gif gif(DGifOpen(&rest, read_gif, &error));
  if (!gif) fail(subject, GifErrorString(error));
  check_image_size(subject, gif->SWidth, gif->SHeight, file_bytes, kMaxPixelsPerByte);
  return gif;
}

// Moves to the first frame. Returns the colour of it that is transparent, -1 if none is.
int find_frame(const std::string& subject, GifFileType& gif) {
  int transparent = -1;
  for (;;) {
    GifRecordType type = UNDEFINED_RECORD_TYPE;
    if (DGifGetRecordType(&gif, &type) != GIF_OK) fail(subject, GifErrorString(gif.Error));
    if (type == TERMINATE_RECORD_TYPE) fail(subject, "it holds no picture");
    if (type == IMAGE_DESC_RECORD_TYPE) {
      if (DGifGetImageDesc(&gif) != GIF_OK) fail(subject, GifErrorString(gif.Error));
      return transparent;
    }
    if (type != EXTENSION_RECORD_TYPE) continue;
    int code = 0;
    GifByteType* block = nullptr;
    if (DGifGetExtension(&gif, &code, &block) != GIF_OK) fail(subject, GifErrorString(gif.Error));
    while (block) {
      GraphicsControlBlock control;
      if (code == GRAPHICS_EXT_FUNC_CODE && DGifExtensionToGCB(block[0], block + 1, &control) == GIF_OK)
        transparent = control.TransparentColor;
      if (DGifGetExtensionNext(&gif, &block) != GIF_OK) fail(subject, GifErrorString(gif.Error));
    }
  }
}

// Rows of a frame in the order in which the file has them.
std::vector<int> row_order(int height, bool interlaced) {
  constexpr std::array<std::array<int, 2>, 4> kPasses = {{{0, 8}, {4, 8}, {2, 4}, {1, 2}}};  // first row, step
  std::vector<int> rows;
  if (!interlaced)
    for (int y = 0; y < height; ++y) rows.push_back(y);
  else
    for (const auto& [first, step] : kPasses)
      for (int y = first; y < height; y += step) rows.push_back(y);
  return rows;
}

}  // namespace

bool is_gif(Bytes bytes) {
  return bytes.size() >= 6 &&
         (std::memcmp(bytes.data(), "GIF87a", 6) == 0 || std::memcmp(bytes.data(), "GIF89a", 6) == 0);
}

ImageSize gif_size(const std::string& subject, Bytes bytes) {
  const Gif gif = open_gif(subject, bytes);
  return {gif->SWidth, gif->SHeight};
}

Image8 decode_gif8(const std::string& subject, Bytes bytes) {
  const std::size_t file_bytes = bytes.size();
  const Gif gif = open_gif(subject, bytes);
  const int transparent = find_frame(subject, *gif);
  const GifImageDesc& frame = gif->Image;
  const ColorMapObject* colors = frame.ColorMap ? frame.ColorMap : gif->SColorMap;
  if (!colors) fail(subject, "it has no colours");
  check_image_size(subject, frame.Width, frame.Height, file_bytes, kMaxPixelsPerByte);

  Image8 image{gif->SWidth, gif->SHeight, {}};
  image.rgba.resize(std::size_t{4} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  std::vector<GifPixelType> line(static_cast<std::size_t>(frame.Width));
  for (const int row : row_order(frame.Height, frame.Interlace)) {
    if (DGifGetLine(gif.get(), line.data(), frame.Width) != GIF_OK) fail(subject, GifErrorString(gif->Error));
    const int y = frame.Top + row;
    if (y >= image.height) continue;
    for (int i = 0; i < frame.Width && frame.Left + i < image.width; ++i) {
      const int index = line[static_cast<std::size_t>(i)];
      if (index >= colors->ColorCount) fail(subject, "a pixel has a colour that the file lacks");
      const std::size_t at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                  static_cast<std::size_t>(frame.Left + i));
      const GifColorType& color = colors->Colors[index];
      const unsigned char alpha = index == transparent ? 0 : 255;
      const std::array<unsigned char, 4> rgba = {color.Red, color.Green, color.Blue, alpha};
      std::copy(rgba.begin(), rgba.end(), image.rgba.begin() + static_cast<std::ptrdiff_t>(at));
    }
  }
  return image;
}

}  // namespace lightwell
