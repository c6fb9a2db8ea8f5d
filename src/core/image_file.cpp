// Images by file name: the format of an input follows from its first bytes, that of an output from the function.
#include <algorithm>
#include <array>

#include "core/color.h"
#include "core/files.h"
#include "core/image_formats.h"
#include "lightwell/error.h"

namespace lightwell {

void check_image_size(const std::string& subject, std::int64_t width, std::int64_t height, std::size_t file_bytes,
                      std::int64_t max_pixels_per_byte) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  if (width <= 0 || height <= 0) throw InputError(subject, "empty image of " + size + " pixels");
  if (width > kMaxImageSide || height > kMaxImageSide)
    throw InputError(
        subject, "image of " + size + " pixels is too large (at most " + std::to_string(kMaxImageSide) + " a side)");
  constexpr std::int64_t kAlwaysAllowed = 4096 * 4096;
  if (width * height > kAlwaysAllowed && width * height / max_pixels_per_byte > static_cast<std::int64_t>(file_bytes))
    throw InputError(subject, "file of " + std::to_string(file_bytes) + " bytes can hardly hold " + size + " pixels");
}

bool has_high_range(Bytes bytes) {
  return is_exr(bytes) || is_hdr(bytes);
}

Image decode_image(const std::string& subject, Bytes bytes) {
  if (is_exr(bytes)) return decode_exr(subject, bytes);
  if (is_hdr(bytes)) return decode_hdr(subject, bytes);
  if (is_png(bytes)) return decode_png(subject, bytes);
  const Image8 encoded = decode_image8(subject, bytes.data(), bytes.size());
  std::array<float, 256> linear;
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[i] = static_cast<float>(linear_from_srgb(static_cast<double>(i) / 255.0));
  Image image(encoded.width, encoded.height, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = linear[encoded.rgba[i / 3 * 4 + i % 3]];
  return image;
}

Image load_image(const std::string& path) {
  return decode_image(path, read_file(path));
}

void save_exr(const std::string& path, const Image& image) {
  write_file_atomically(path, encode_exr(image));
}

void save_png(const std::string& path, const Image& image) {
  write_file_atomically(path, encode_png(image));
}

}  // namespace lightwell
