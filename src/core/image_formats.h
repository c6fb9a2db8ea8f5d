// The file formats behind load_image() and save_*(), one .cpp each. All of them work on bytes in memory: files are read
// whole beforehand and written whole afterwards, so that a full disk is noticed in one place (core/files.h).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lightwell/image.h"

namespace lightwell {

using Bytes = std::span<const std::uint8_t>;

bool is_exr(Bytes bytes);
bool is_hdr(Bytes bytes);
bool is_png(Bytes bytes);
bool is_jpeg(Bytes bytes);
bool is_webp(Bytes bytes);
bool is_gif(Bytes bytes);

// What load_image() does, with a file's content.
Image decode_image(const std::string& subject, Bytes bytes);

// Whether the format can hold light brighter than white: OpenEXR and Radiance HDR.
bool has_high_range(Bytes bytes);

// Each throws InputError naming `subject`. PNG's alpha is dropped.
Image decode_exr(const std::string& subject, Bytes bytes);
Image decode_hdr(const std::string& subject, Bytes bytes);
Image decode_png(const std::string& subject, Bytes bytes);
Image8 decode_png8(const std::string& subject, Bytes bytes);
Image8 decode_jpeg8(const std::string& subject, Bytes bytes);
Image8 decode_webp8(const std::string& subject, Bytes bytes);
Image8 decode_gif8(const std::string& subject, Bytes bytes);

// From the header alone. Throws InputError as check_image_size() does.
ImageSize png_size(const std::string& subject, Bytes bytes);
ImageSize jpeg_size(const std::string& subject, Bytes bytes);
ImageSize webp_size(const std::string& subject, Bytes bytes);
ImageSize gif_size(const std::string& subject, Bytes bytes);

std::vector<std::uint8_t> encode_exr(const Image& image);
std::vector<std::uint8_t> encode_png(const Image& image);

// Deflate packs at most 1032:1, so a byte can stand for 8 x 1032 pixels of one bit.
inline constexpr std::int64_t kPixelsPerDeflatedByte = 8 * 1032;

// Of floats, which take twelve bytes a pixel: what files of one colour reach, and no more.
inline constexpr std::int64_t kFloatPixelsPerByte = 256;

// Throws InputError if an image that a file of `file_bytes` bytes announces is empty, larger than kMaxImageSide, or so
// large that no compression could have made the file that small: a few hostile bytes must not cost gigabytes.
void check_image_size(const std::string& subject, std::int64_t width, std::int64_t height, std::size_t file_bytes,
                      std::int64_t max_pixels_per_byte = kPixelsPerDeflatedByte);

}  // namespace lightwell
