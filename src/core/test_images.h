// Image files of every kind for tests. The libraries' own encoders make them.
#pragma once

#include <png.h>

#include <array>
#include <cstdint>
#include <cstdio>  // jpeglib.h needs FILE
#include <cstdlib>
#include <string>
#include <vector>

#include <gif_lib.h>
#include <jpeglib.h>
#include <webp/encode.h>

namespace lightwell::test {

using File = std::vector<std::uint8_t>;

struct JpegKind {
  J_COLOR_SPACE color = JCS_RGB;  // of the pixels given
  bool progressive = false;
  bool adobe = true;                  // CMYK: inks stored inverted, and a marker that says so
  std::vector<jpeg_scan_info> scans;  // empty: the library's
};

// Three samples a pixel (gray 1, CMYK 4), rows from the top, at full quality without subsampling.
inline File encode_jpeg(int width, int height, const std::vector<JSAMPLE>& samples, const JpegKind& kind = {}) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &buffer, &size);
  jpeg.image_width = static_cast<JDIMENSION>(width);
  jpeg.image_height = static_cast<JDIMENSION>(height);
  jpeg.in_color_space = kind.color;
  jpeg.input_components = kind.color == JCS_GRAYSCALE ? 1 : kind.color == JCS_CMYK ? 4 : 3;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 100, TRUE);
  for (int c = 0; c < jpeg.num_components; ++c) jpeg.comp_info[c].h_samp_factor = jpeg.comp_info[c].v_samp_factor = 1;
  if (kind.progressive) jpeg_simple_progression(&jpeg);
  if (!kind.scans.empty()) {
    jpeg.scan_info = kind.scans.data();
    jpeg.num_scans = static_cast<int>(kind.scans.size());
  }
  if (kind.color == JCS_CMYK) jpeg.write_Adobe_marker = kind.adobe ? TRUE : FALSE;
  jpeg_start_compress(&jpeg, TRUE);
  const auto row_size = static_cast<std::size_t>(width * jpeg.input_components);
  for (int y = 0; y < height; ++y) {
    auto* row = const_cast<JSAMPLE*>(samples.data()) + static_cast<std::size_t>(y) * row_size;
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  File file(buffer, buffer + size);
  std::free(buffer);
  return file;
}

// Smooth, so that little is lost.
inline std::vector<JSAMPLE> ramp(int width, int height, int channels) {
  std::vector<JSAMPLE> samples;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c)
        samples.push_back(static_cast<JSAMPLE>(40 + c * 30 + x * 100 / width + y * 40 / height));
  return samples;
}

struct PngKind {
  int color_type = PNG_COLOR_TYPE_RGB;
  int bit_depth = 8;
  int interlace = PNG_INTERLACE_NONE;
  std::vector<png_color> palette;
};

// `rows` as the file stores them, bit_depth bits a sample.
inline File encode_png_kind(int width, int height, const std::vector<std::uint8_t>& rows, const PngKind& kind) {
  File file;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &file,
      [](png_structp p, png_bytep data, png_size_t size) {
        auto* out = static_cast<File*>(png_get_io_ptr(p));
        out->insert(out->end(), data, data + size);
      },
      [](png_structp) {});
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), kind.bit_depth,
               kind.color_type, kind.interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!kind.palette.empty()) png_set_PLTE(png, info, kind.palette.data(), static_cast<int>(kind.palette.size()));
  png_write_info(png, info);
  std::vector<png_bytep> pointers;
  const std::size_t row_size = png_get_rowbytes(png, info);
  for (int y = 0; y < height; ++y)
    pointers.push_back(const_cast<png_bytep>(rows.data()) + static_cast<std::size_t>(y) * row_size);
  png_write_image(png, pointers.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return file;
}

// Uncompressed TGA of 32 bits a pixel, or run-length coded; the ramp, blue first.
inline File encode_tga(int width, int height, bool runs) {
  File file(18, 0);
  file[2] = runs ? 10 : 2;
  file[12] = static_cast<std::uint8_t>(width);
  file[14] = static_cast<std::uint8_t>(height);
  file[16] = 32;
  file[17] = 0x20 | 8;  // from the top, 8 bits of alpha
  const std::vector<JSAMPLE> samples = ramp(width, height, 3);
  for (std::size_t i = 0; i < samples.size(); i += 3) {
    if (runs) file.push_back(0);  // one literal pixel
    file.insert(file.end(), {samples[i + 2], samples[i + 1], samples[i], 255});
  }
  return file;
}

// Uncompressed BMP of 24 bits a pixel, rows from the bottom; width is a multiple of four.
inline File encode_bmp(int width, int height) {
  const std::vector<JSAMPLE> samples = ramp(width, height, 3);
  File file(54, 0);
  const auto put = [&](std::size_t at, std::uint32_t value) {
    for (std::size_t k = 0; k < 4; ++k) file[at + k] = static_cast<std::uint8_t>(value >> (8 * k));
  };
  file[0] = 'B';
  file[1] = 'M';
  put(2, static_cast<std::uint32_t>(54 + samples.size()));
  put(10, 54);
  put(14, 40);
  put(18, static_cast<std::uint32_t>(width));
  put(22, static_cast<std::uint32_t>(height));
  put(26, 1 | 24 << 16);
  const auto row = static_cast<std::size_t>(width) * 3;
  for (std::size_t y = samples.size() / row; y-- > 0;)
    for (std::size_t x = 0; x < row; x += 3)
      file.insert(file.end(), {samples[y * row + x + 2], samples[y * row + x + 1], samples[y * row + x]});
  return file;
}

inline File encode_webp(int width, int height, bool lossless) {
  const std::vector<JSAMPLE> samples = ramp(width, height, 3);
  std::uint8_t* bytes = nullptr;
  const std::size_t size = lossless ? WebPEncodeLosslessRGB(samples.data(), width, height, 3 * width, &bytes)
                                    : WebPEncodeRGB(samples.data(), width, height, 3 * width, 95.0f, &bytes);
  File file(bytes, bytes + size);
  WebPFree(bytes);
  return file;
}

// Two frames: colour i % 7 of a palette at pixel i, colour 3 transparent; then another picture.
inline File encode_gif(int width, int height, bool interlaced, int left = 0, int top = 0) {
  File file;
  int error = 0;
  GifFileType* gif = EGifOpen(
      &file,
      [](GifFileType* g, const GifByteType* data, int size) {
        auto* out = static_cast<File*>(g->UserData);
        out->insert(out->end(), data, data + size);
        return size;
      },
      &error);
  std::vector<GifColorType> colors(8);
  for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = {static_cast<GifByteType>(30 * i), 100, 7};
  ColorMapObject* map = GifMakeMapObject(8, colors.data());
  EGifSetGifVersion(gif, true);
  EGifPutScreenDesc(gif, width + left, height + top, 8, 0, map);
  const GraphicsControlBlock control{DISPOSAL_UNSPECIFIED, false, 0, 3};
  std::array<GifByteType, 4> extension{};
  EGifGCBToExtension(&control, extension.data());
  for (int frame = 0; frame < 2; ++frame) {
    EGifPutExtension(gif, GRAPHICS_EXT_FUNC_CODE, 4, extension.data());
    EGifPutImageDesc(gif, left, top, width, height, interlaced, nullptr);
    for (const int first : interlaced ? std::vector<int>{0, 4, 2, 1} : std::vector<int>{0})
      for (int y = first; y < height; y += interlaced ? (first == 0 || first == 4 ? 8 : 2 * first) : 1) {
        std::vector<GifPixelType> line;
        for (int x = 0; x < width; ++x) line.push_back(static_cast<GifPixelType>((y * width + x + frame) % 7));
        EGifPutLine(gif, line.data(), width);
      }
  }
  GifFreeMapObject(map);
  EGifCloseFile(gif, &error);
  return file;
}

}  // namespace lightwell::test
