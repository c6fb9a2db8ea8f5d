// Textures held in memory. PNG goes to libpng; stb_image does the rest.
#include <memory>

#include "core/image_formats.h"
#include "lightwell/error.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_MAX_DIMENSIONS lightwell::kMaxImageSide
#include <stb_image.h>

namespace lightwell {

Image8 decode_image8(const std::string& subject, const unsigned char* bytes, std::size_t size) {
  if (is_png({bytes, size})) return decode_png8(subject, {bytes, size});
  const int length = static_cast<int>(size);
  int width = 0, height = 0, channels = 0;
  if (size > 0x7fffffff || !stbi_info_from_memory(bytes, length, &width, &height, &channels))
    throw InputError(subject, "not an image that can be read (PNG, JPEG, TGA or BMP)");
  check_image_size(subject, width, height, size);
  const std::unique_ptr<stbi_uc, void (*)(void*)> rgba(
      stbi_load_from_memory(bytes, length, &width, &height, &channels, 4), stbi_image_free);
  if (!rgba) throw InputError(subject, std::string("damaged image: ") + stbi_failure_reason());
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4;
  return {width, height, std::vector<unsigned char>(rgba.get(), rgba.get() + count)};
}

}  // namespace lightwell
