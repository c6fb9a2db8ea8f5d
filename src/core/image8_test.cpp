// Textures: every kind of PNG and JPEG, and damaged files of all formats. The libraries' own encoders make the files.
#include <png.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>

#include <gif_lib.h>
#include <jpeglib.h>
#include <webp/encode.h>

#include <gtest/gtest.h>

#include "core/image_formats.h"
#include "lightwell/error.h"

namespace lightwell {
namespace {

using File = std::vector<std::uint8_t>;

Image8 decode(const File& file) {
  return decode_image8("t", file.data(), file.size());
}

std::string error_of(const File& file) {
  try {
    decode(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

struct JpegKind {
  J_COLOR_SPACE color = JCS_RGB;  // of the pixels given
  bool progressive = false;
  bool adobe = true;                  // CMYK: inks stored inverted, and a marker that says so
  std::vector<jpeg_scan_info> scans;  // empty: the library's
};

// Three samples a pixel (gray 1, CMYK 4), rows from the top, at full quality without subsampling.
File encode_jpeg(int width, int height, const std::vector<JSAMPLE>& samples, const JpegKind& kind = {}) {
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
std::vector<JSAMPLE> ramp(int width, int height, int channels) {
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
File encode_png_kind(int width, int height, const std::vector<std::uint8_t>& rows, const PngKind& kind) {
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
File encode_tga(int width, int height, bool runs) {
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
File encode_bmp(int width, int height) {
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

File encode_webp(int width, int height, bool lossless) {
  const std::vector<JSAMPLE> samples = ramp(width, height, 3);
  std::uint8_t* bytes = nullptr;
  const std::size_t size = lossless ? WebPEncodeLosslessRGB(samples.data(), width, height, 3 * width, &bytes)
                                    : WebPEncodeRGB(samples.data(), width, height, 3 * width, 95.0f, &bytes);
  File file(bytes, bytes + size);
  WebPFree(bytes);
  return file;
}

// Two frames: colour i % 7 of a palette at pixel i, colour 3 transparent; then another picture.
File encode_gif(int width, int height, bool interlaced, int left = 0, int top = 0) {
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

void expect_pixels(const Image8& image, const std::vector<JSAMPLE>& samples, std::size_t channels, int tolerance) {
  ASSERT_EQ(image.rgba.size() / 4, samples.size() / channels);
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c)
      ASSERT_NEAR(image.rgba[i + c], samples[i / 4 * channels + (channels == 3 ? c : 0)], tolerance) << i;
    ASSERT_EQ(image.rgba[i + 3], 255);
  }
}

TEST(Textures, JpegBaselineAndProgressive) {
  const std::vector<JSAMPLE> color = ramp(35, 21, 3), gray = ramp(35, 21, 1);
  for (const bool progressive : {false, true}) {
    expect_pixels(decode(encode_jpeg(35, 21, color, {JCS_RGB, progressive})), color, 3, 4);
    expect_pixels(decode(encode_jpeg(35, 21, gray, {JCS_GRAYSCALE, progressive})), gray, 1, 2);
  }
}

// Inks take light away: R = (1 - C)(1 - K). Adobe's files store what is left instead.
TEST(Textures, JpegOfFourInks) {
  const std::vector<JSAMPLE> left = {200, 100, 50, 128};  // what each ink lets through
  std::vector<JSAMPLE> stored_left, stored_inks;
  for (int i = 0; i < 64; ++i)
    for (const JSAMPLE value : left) {
      stored_left.push_back(value);
      stored_inks.push_back(static_cast<JSAMPLE>(255 - value));
    }
  for (const File& file : {encode_jpeg(8, 8, stored_left, {JCS_CMYK, false, true}),
                           encode_jpeg(8, 8, stored_inks, {JCS_CMYK, false, false})}) {
    const Image8 image = decode(file);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(image.rgba[c], left[c] * left[3] / 255.0, 2);
    EXPECT_EQ(image.rgba[3], 255);
  }
}

TEST(Textures, PngOfSixteenBitsIsRounded) {
  std::vector<std::uint8_t> rows;
  std::vector<int> values;
  for (int v = 0; v < 65536; v += 257 / 5) {
    values.push_back(v);
    for (int c = 0; c < 3; ++c)
      rows.insert(rows.end(), {static_cast<std::uint8_t>(v >> 8), static_cast<std::uint8_t>(v)});
  }
  const Image8 image = decode(
      encode_png_kind(static_cast<int>(values.size()), 1, rows, {PNG_COLOR_TYPE_RGB, 16, PNG_INTERLACE_NONE, {}}));
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(image.rgba[4 * i], (values[i] + 128) / 257) << values[i];
}

TEST(Textures, PngPaletteGrayAndInterlaced) {
  const std::vector<std::uint8_t> indices = {0x1b, 0xe4};  // 0 1 2 3, 3 2 1 0 of two bits
  const PngKind palette{
      PNG_COLOR_TYPE_PALETTE, 2, PNG_INTERLACE_ADAM7, {{1, 2, 3}, {40, 50, 60}, {7, 8, 9}, {255, 0, 128}}};
  const Image8 colors = decode(encode_png_kind(4, 2, indices, palette));
  for (std::size_t i = 0; i < 8; ++i) {
    const png_color expected = palette.palette[i < 4 ? i : 7 - i];
    EXPECT_EQ(colors.rgba[4 * i], expected.red);
    EXPECT_EQ(colors.rgba[4 * i + 2], expected.blue);
  }
  const Image8 gray = decode(encode_png_kind(4, 2, indices, {PNG_COLOR_TYPE_GRAY, 2, PNG_INTERLACE_NONE, {}}));
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(gray.rgba[4 * i + 1], 85 * (i < 4 ? i : 7 - i));
}

TEST(Textures, BmpAndTga) {
  for (const File& file : {encode_tga(12, 9, false), encode_tga(12, 9, true), encode_bmp(12, 9)})
    expect_pixels(decode(file), ramp(12, 9, 3), 3, 0);
}

TEST(Textures, WebP) {
  expect_pixels(decode(encode_webp(24, 18, true)), ramp(24, 18, 3), 3, 0);
  expect_pixels(decode(encode_webp(24, 18, false)), ramp(24, 18, 3), 3, 12);
}

TEST(Textures, FirstFrameOfGif) {
  for (const bool interlaced : {false, true}) {
    const Image8 image = decode(encode_gif(20, 13, interlaced));
    ASSERT_EQ(image.width, 20);
    for (std::size_t i = 0; i < 20 * 13; ++i) {
      ASSERT_EQ(image.rgba[4 * i], 30 * (i % 7)) << i;
      ASSERT_EQ(image.rgba[4 * i + 1], 100);
      ASSERT_EQ(image.rgba[4 * i + 3], i % 7 == 3 ? 0 : 255);
    }
  }
  const Image8 placed = decode(encode_gif(4, 2, false, 3, 1));
  ASSERT_EQ(placed.width, 7);
  ASSERT_EQ(placed.height, 3);
  EXPECT_EQ(placed.rgba[4 * (7 + 2) + 3], 0);
  EXPECT_EQ(placed.rgba[4 * (7 + 4)], 30);
}

TEST(Textures, FormatsThatAreNotReadAreNamed) {
  for (const auto& [start, name] : {std::pair<std::string, std::string>{"DDS |\1\2\3", "DDS"},
                                    {"\xabKTX 20\xbb\r\n\x1a\n", "KTX2"},
                                    {"sB\x10\1", "Basis Universal"},
                                    {std::string("\0\0\0\x1c", 4) + "ftypavif", "AVIF"},
                                    {std::string("II*\0", 4), "TIFF"},
                                    {"#?RADIANCE\n", "Radiance HDR"},
                                    {"<html>404</html>", "HTML"}}) {
    const std::string error = error_of({start.begin(), start.end()});
    EXPECT_NE(error.find(name), std::string::npos) << error;
  }
  EXPECT_EQ(error_of({}), "t: empty file");
}

// Whatever is cut off was never written: none of it may be shown.
TEST(Textures, CutFilesAreErrorsAtEveryLength) {
  const std::vector<File> files = {encode_jpeg(20, 13, ramp(20, 13, 3)),
                                   encode_jpeg(20, 13, ramp(20, 13, 3), {JCS_RGB, true}),
                                   encode_png_kind(20, 13, ramp(20, 13, 3), {}),
                                   encode_tga(20, 13, false),
                                   encode_tga(20, 13, true),
                                   encode_bmp(20, 13),
                                   encode_webp(20, 13, true),
                                   encode_webp(20, 13, false)};
  for (std::size_t i = 0; i < files.size(); ++i) {
    ASSERT_EQ(error_of(files[i]), "") << i;
    for (std::size_t size = 0; size < files[i].size(); ++size)
      ASSERT_TRUE(error_of({files[i].begin(), files[i].begin() + static_cast<std::ptrdiff_t>(size)}).starts_with("t: "))
          << size << " bytes of file " << i;
  }
}

// A GIF's first frame is whole before the others begin.
TEST(Textures, CutGifs) {
  const File file = encode_gif(20, 13, true);
  int shown = 0;
  for (std::size_t size = 0; size < file.size(); ++size) {
    const std::string error = error_of({file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size)});
    if (size < file.size() / 2 - 20) {
      EXPECT_NE(error, "") << size;
    }
    shown += error.empty();
  }
  EXPECT_GT(shown, 0);
}

TEST(Textures, TheHeaderTellsTheSize) {
  for (const File& file :
       {encode_jpeg(20, 13, ramp(20, 13, 3)), encode_png_kind(20, 13, ramp(20, 13, 3), {}), encode_tga(20, 13, true),
        encode_bmp(20, 13), encode_webp(20, 13, true), encode_gif(20, 13, false)}) {
    const ImageSize size = image8_size("t", file.data(), file.size());
    EXPECT_EQ(size.width, 20);
    EXPECT_EQ(size.height, 13);
  }
}

// The frame header promises 16384 x 16384 pixels, which no JPEG packs into so few bytes.
TEST(Textures, JpegThatPromisesTooMuch) {
  File file = encode_jpeg(16, 16, ramp(16, 16, 3));
  for (std::size_t i = 0; i + 8 < file.size(); ++i)
    if (file[i] == 0xff && file[i + 1] == 0xc0) {
      file[i + 5] = file[i + 7] = 0x40;
      file[i + 6] = file[i + 8] = 0;
      break;
    }
  EXPECT_NE(error_of(file).find("cannot hold 16384x16384 pixels"), std::string::npos) << error_of(file);
}

// Each scan costs the whole picture: here one for each bit of each coefficient.
TEST(Textures, JpegOfVeryManyScans) {
  JpegKind kind{JCS_GRAYSCALE, true};
  kind.scans.push_back({1, {0}, 0, 0, 0, 0});
  for (int coefficient = 1; coefficient < 64; ++coefficient)
    for (int bit = 10; bit >= 0; --bit)
      kind.scans.push_back({1, {0}, coefficient, coefficient, bit == 10 ? 0 : bit + 1, bit});
  EXPECT_EQ(error_of(encode_jpeg(64, 64, ramp(64, 64, 1), kind)), "t: damaged JPEG file: more than 100 scans");
}

// Random changes: an image or an InputError with a reason, nothing else. The same every time.
TEST(Textures, DamagedFilesAreErrorsAndNothingWorse) {
  const std::vector<JSAMPLE> color = ramp(40, 24, 3), inks = ramp(40, 24, 4);
  const std::vector<File> files = {encode_jpeg(40, 24, color),
                                   encode_jpeg(40, 24, color, {JCS_RGB, true}),
                                   encode_jpeg(40, 24, inks, {JCS_CMYK, true}),
                                   encode_png_kind(40, 24, color, {}),
                                   encode_png_kind(40, 24, color, {PNG_COLOR_TYPE_RGB, 8, PNG_INTERLACE_ADAM7, {}}),
                                   encode_tga(40, 24, false),
                                   encode_tga(40, 24, true),
                                   encode_bmp(40, 24),
                                   encode_webp(40, 24, true),
                                   encode_webp(40, 24, false),
                                   encode_gif(40, 24, false),
                                   encode_gif(40, 24, true)};
  std::mt19937 random(7);
  int refused = 0;
  for (const File& original : files)
    for (int i = 0; i < 1500; ++i) {
      File damaged = original;
      const std::size_t reach = i % 2 ? damaged.size() : std::min<std::size_t>(damaged.size(), 200);  // headers first
      for (int k = 0; k < 1 + i % 5; ++k) damaged[random() % reach] = static_cast<std::uint8_t>(random());
      if (i % 7 == 0) damaged.resize(random() % damaged.size());
      const std::string error = error_of(damaged);
      EXPECT_TRUE(error.empty() || error.size() > 4) << error;
      refused += error.empty() ? 0 : 1;
    }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace lightwell
