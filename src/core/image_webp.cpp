// WebP textures by libwebp: lossy and lossless, with or without alpha. Animations are none.
#include <webp/decode.h>

#include "core/image_formats.h"
#include "lightwell/error.h"

namespace lightwell {

bool is_webp(Bytes bytes) {
  const auto has = [&](std::size_t at, const char* letters) {
    for (std::size_t i = 0; i < 4; ++i)
      if (bytes[at + i] != static_cast<std::uint8_t>(letters[i])) return false;
    return true;
  };
  return bytes.size() >= 12 && has(0, "RIFF") && has(8, "WEBP");
}

ImageSize webp_size(const std::string& subject, Bytes bytes) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK)
    throw InputError(subject, "damaged WebP file: bad header");
  if (features.has_animation) throw InputError(subject, "animated WebP files are not supported");
  check_image_size(subject, features.width, features.height, bytes.size());
  return {features.width, features.height};
}

Image8 decode_webp8(const std::string& subject, Bytes bytes) {
  const ImageSize size = webp_size(subject, bytes);
  const std::size_t row_bytes = static_cast<std::size_t>(size.width) * 4;
  Image8 image{size.width, size.height, std::vector<unsigned char>(row_bytes * static_cast<std::size_t>(size.height))};
  if (!WebPDecodeRGBAInto(bytes.data(), bytes.size(), image.rgba.data(), image.rgba.size(),
                          static_cast<int>(row_bytes)))
    throw InputError(subject, "damaged WebP file: it is cut off or cannot be decoded");
  return image;
}

}  // namespace lightwell
