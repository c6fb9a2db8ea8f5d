// Textures: every kind of PNG and JPEG, and damaged files of all formats. The libraries' own encoders make the files.
#include <functional>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "core/image_formats.h"
#include "core/test_images.h"
#include "lightwell/error.h"

namespace lightwell {
namespace {

using namespace test;

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
  EXPECT_NE(error_of(file).find("can hardly hold 16384x16384 pixels"), std::string::npos) << error_of(file);
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
