// Textures held in memory, told apart by their first bytes: libpng, libjpeg-turbo, libwebp, giflib, and stb_image for
// BMP and TGA.
#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <string_view>

#include "core/image_formats.h"
#include "lightwell/error.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_MAX_DIMENSIONS lightwell::kMaxImageSide
#include <stb_image.h>

namespace lightwell {

namespace {

// Gives stb_image its bytes and notices when it asks for more than there are: it takes no notice, and hands out pixels
// that nobody wrote. It fills a small buffer of its own ahead, where fewer bytes than asked for are fine; whatever goes
// elsewhere is a part of the picture.
struct StbInput {
  Bytes bytes;
  std::size_t position = 0;
  const char* ahead = nullptr;  // its buffer, which the first call fills
  bool ran_out = false;

  static int read(void* user, char* out, int wanted) {
    auto* input = static_cast<StbInput*>(user);
    if (!input->ahead) input->ahead = out;
    const std::size_t count = std::min(static_cast<std::size_t>(wanted), input->bytes.size() - input->position);
    input->ran_out |= out == input->ahead ? count == 0 : count < static_cast<std::size_t>(wanted);
    if (count > 0) std::memcpy(out, input->bytes.data() + input->position, count);
    input->position += count;
    return static_cast<int>(count);
  }
  static void skip(void* user, int count) {
    auto* input = static_cast<StbInput*>(user);
    if (count > 0) input->position += std::min(static_cast<std::size_t>(count), input->bytes.size() - input->position);
  }
  static int at_end(void* user) {
    const auto* input = static_cast<StbInput*>(user);
    return input->position == input->bytes.size();
  }
};

constexpr stbi_io_callbacks kStbCallbacks = {StbInput::read, StbInput::skip, StbInput::at_end};

// Formats that are known by their first bytes but not read.
struct Unread {
  std::size_t offset;
  std::string_view signature;
  const char* name;
};
constexpr std::array<Unread, 15> kUnread = {{{0, "DDS ", "DDS"},
                                             {0, "\xabKTX 20\xbb", "KTX2"},
                                             {0, "\xabKTX 11\xbb", "KTX"},
                                             {0, "sB", "Basis Universal"},
                                             {0, "II*", "TIFF"},
                                             {0, {"MM\0*", 4}, "TIFF"},
                                             {0, "8BPS", "Photoshop"},
                                             {4, "jP  ", "JPEG 2000"},
                                             {0, "\xff\x0a", "JPEG XL"},
                                             {4, "JXL ", "JPEG XL"},
                                             {4, "ftyp", "AVIF or HEIF"},
                                             {0, "\x76\x2f\x31\x01", "OpenEXR"},
                                             {0, "#?", "Radiance HDR"},
                                             {0, "<", "SVG, HTML or other text"},
                                             {0, "version https://git-lfs", "Git LFS pointer"}}};

[[noreturn]] void refuse(const std::string& subject, Bytes bytes) {
  if (bytes.empty()) throw InputError(subject, "empty file");
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const Unread& format : kUnread)
    if (text.size() > format.offset && text.substr(format.offset).starts_with(format.signature))
      throw InputError(subject, std::string("textures of the kind ") + format.name + " are not supported");
  throw InputError(subject, "not an image that can be read (PNG, JPEG, WebP, GIF, TGA or BMP)");
}

// A run of TGA's packs 128 pixels into two bytes.
constexpr std::int64_t kMaxPixelsPerByte = 64;

ImageSize stb_size(const std::string& subject, Bytes bytes) {
  StbInput input{bytes};
  int width = 0, height = 0, channels = 0;
  if (bytes.empty() || !stbi_info_from_callbacks(&kStbCallbacks, &input, &width, &height, &channels))
    refuse(subject, bytes);
  check_image_size(subject, width, height, bytes.size(), kMaxPixelsPerByte);
  return {width, height};
}

Image8 decode_stb(const std::string& subject, Bytes bytes) {
  const ImageSize size = stb_size(subject, bytes);
  StbInput input{bytes};
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> rgba(
      stbi_load_from_callbacks(&kStbCallbacks, &input, &width, &height, &channels, 4), stbi_image_free);
  if (!rgba || width != size.width || height != size.height) {
    const char* reason = stbi_failure_reason();
    throw InputError(subject, std::string("damaged image: ") + (reason ? reason : "it cannot be decoded"));
  }
  if (input.ran_out) throw InputError(subject, "damaged image: unexpected end of file");
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4;
  return {width, height, std::vector<unsigned char>(rgba.get(), rgba.get() + count)};
}

}  // namespace

ImageSize image8_size(const std::string& subject, const unsigned char* bytes, std::size_t size) {
  const Bytes file{bytes, size};
  if (is_png(file)) return png_size(subject, file);
  if (is_jpeg(file)) return jpeg_size(subject, file);
  if (is_webp(file)) return webp_size(subject, file);
  if (is_gif(file)) return gif_size(subject, file);
  return stb_size(subject, file);
}

Image8 decode_image8(const std::string& subject, const unsigned char* bytes, std::size_t size) {
  const Bytes file{bytes, size};
  if (is_png(file)) return decode_png8(subject, file);
  if (is_jpeg(file)) return decode_jpeg8(subject, file);
  if (is_webp(file)) return decode_webp8(subject, file);
  if (is_gif(file)) return decode_gif8(subject, file);
  return decode_stb(subject, file);
}

}  // namespace lightwell
