// Images in CPU memory and the files they live in.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lightwell {

// width x height x channels floats, row 0 on top, channels interleaved. Unless said otherwise: linear, sRGB primaries.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 3;
  std::vector<float> pixels;

  Image() = default;
  Image(int width_, int height_, int channels_ = 3)
      : width(width_),
        height(height_),
        channels(channels_),
        pixels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) *
               static_cast<std::size_t>(channels_)) {}

  float* at(int x, int y) {
    return pixels.data() +
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(channels);
  }
  const float* at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
};

// Largest side of any image that is read or rendered.
inline constexpr int kMaxImageSide = 16384;

// Reads an image file as 3 linear channels; the format follows from its content. OpenEXR: its display window, black
// where the file has no pixels; R, G, B of the first part and layer that have them (Blender's Combined before others),
// else one channel for all three. Radiance HDR; PNG of 8 or 16 bits and all that decode_image8() reads, from sRGB to
// linear. Throws InputError.
Image load_image(const std::string& path);

// Decodes an image file held in memory (PNG, JPEG, WebP, GIF's first frame, TGA or BMP, told apart by content), 8 bits
// a channel, without any colour conversion: what glTF and MTL textures are. Returns RGBA in [0,255], or throws
// InputError naming `subject`.
struct Image8 {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgba;
};
Image8 decode_image8(const std::string& subject, const unsigned char* bytes, std::size_t size);

// What decode_image8() would return, from the header alone. Throws InputError naming `subject`, also for sizes that
// the file is too small to hold.
struct ImageSize {
  int width = 0;
  int height = 0;
};
ImageSize image8_size(const std::string& subject, const unsigned char* bytes, std::size_t size);

// Writes linear 32-bit float RGB (3 channels) or Y (1 channel), unclamped, ZIP compressed. Throws InputError.
void save_exr(const std::string& path, const Image& image);

// Writes display-ready values in [0,1] (clamped) as 8-bit RGB. Use tone_map() of lightwell/metrics.h first.
void save_png(const std::string& path, const Image& image);

}  // namespace lightwell
