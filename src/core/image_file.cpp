// Images by file name: the format of an input follows from its first bytes, that of an output from the function.
#include <algorithm>

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
    throw InputError(subject, "file of " + std::to_string(file_bytes) + " bytes cannot hold " + size + " pixels");
}

Image load_image(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  if (is_exr(bytes)) return decode_exr(path, bytes);
  if (is_hdr(bytes)) return decode_hdr(path, bytes);
  if (is_png(bytes)) return decode_png(path, bytes);
  throw InputError(path, "not an image that can be read (EXR, Radiance HDR or PNG)");
}

void save_exr(const std::string& path, const Image& image) {
  write_file_atomically(path, encode_exr(image));
}

void save_png(const std::string& path, const Image& image) {
  write_file_atomically(path, encode_png(image));
}

}  // namespace lightwell
