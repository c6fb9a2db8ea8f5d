#include "lightwell/image.h"

#include <gtest/gtest.h>
#include <half.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStdIO.h>
#include <ImfTiledOutputPart.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>
#include <random>

#include <glm/ext/vector_float3.hpp>

#include "core/files.h"
#include "core/image_formats.h"
#include "core/log.h"
#include "core/shrink.h"
#include "core/test_folder.h"
#include "lightwell/error.h"
#include "lightwell/metrics.h"

namespace lightwell {
namespace {

namespace fs = std::filesystem;

class ImageTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
  }

  TestFolder folder_;
};

Image random_image(int width, int height, int channels, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0.0f, 3.0f);
  Image image(width, height, channels);
  for (float& value : image.pixels) value = uniform(random);
  return image;
}

TEST_F(ImageTest, ExrKeepsEveryBitOfRgb) {
  Image image = random_image(37, 21, 3, 1);
  image.at(3, 4)[0] = -2.5f;
  image.at(5, 6)[1] = 1e30f;
  image.at(7, 8)[2] = std::numeric_limits<float>::infinity();
  save_exr(path("a.exr"), image);
  const Image back = load_image(path("a.exr"));
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.height, 21);
  EXPECT_EQ(back.pixels, image.pixels);
}

TEST_F(ImageTest, ExrOfOneChannelComesBackAsGray) {
  const Image image = random_image(5, 3, 1, 2);
  save_exr(path("y.exr"), image);
  const Image back = load_image(path("y.exr"));
  ASSERT_EQ(back.channels, 3);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(back.at(4, 2)[c], image.at(4, 2)[0]);
}

// Blender's layer names, half floats, and a data window that reaches out of a display window away from the origin.
TEST_F(ImageTest, ExrFindsCombinedAndShowsItsDisplayWindow) {
  const Imath::Box2i window({-3, 10}, {0, 11});
  Imf::Header header(Imath::Box2i({-2, 9}, {3, 11}), window);
  std::vector<half> red(8), green(8), blue(8), depth(8);
  for (std::size_t i = 0; i < 8; ++i) {
    red[i] = static_cast<float>(i);
    green[i] = static_cast<float>(i) + 100.0f;
    blue[i] = 0.5f;
    depth[i] = 7.0f;
  }
  Imf::FrameBuffer frame;
  const auto add = [&](const char* name, std::vector<half>& values) {
    header.channels().insert(name, Imf::Channel(Imf::HALF));
    frame.insert(name, Imf::Slice::Make(Imf::HALF, values.data(), window));
  };
  add("View Layer.Combined.R", red);
  add("View Layer.Combined.G", green);
  add("View Layer.Combined.B", blue);
  add("View Layer.Depth.Z", depth);
  {
    Imf::OutputFile file(path("blender.exr").c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(2);
  }
  const Image image = load_image(path("blender.exr"));
  ASSERT_EQ(image.width, 6);
  ASSERT_EQ(image.height, 3);
  EXPECT_EQ(image.at(0, 2)[0], 5.0f);
  EXPECT_EQ(image.at(0, 2)[1], 105.0f);
  EXPECT_EQ(image.at(2, 1)[2], 0.5f);
  EXPECT_EQ(image.at(0, 0)[2], 0.0f);
  EXPECT_EQ(image.at(3, 1)[2], 0.0f);
}

// One part of a file: the names of its channels, each filled with a value, as halves in tiles or floats in lines.
struct ExrPart {
  std::vector<std::pair<std::string, float>> channels;
  bool tiled = false;
};

std::string exr_of(const std::vector<ExrPart>& parts) {
  std::vector<Imf::Header> headers;
  for (const ExrPart& part : parts) {
    Imf::Header& header = headers.emplace_back(5, 3);
    header.setName("part " + std::to_string(headers.size()));
    header.setType(part.tiled ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
    if (part.tiled) header.setTileDescription(Imf::TileDescription(2, 2, Imf::MIPMAP_LEVELS));
    for (const auto& [name, value] : part.channels)
      header.channels().insert(name, Imf::Channel(part.tiled ? Imf::HALF : Imf::FLOAT));
  }
  Imf::StdOSStream stream;
  {
    Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(headers.size()));
    for (std::size_t p = 0; p < parts.size(); ++p) {
      Imf::FrameBuffer frame;
      std::vector<std::vector<float>> floats;
      std::vector<std::vector<half>> halves;
      for (const auto& [name, value] : parts[p].channels) {
        floats.emplace_back(15, value);
        halves.emplace_back(15, half(value));
      }
      for (std::size_t c = 0; c < floats.size(); ++c) {
        char* first =
            parts[p].tiled ? reinterpret_cast<char*>(halves[c].data()) : reinterpret_cast<char*>(floats[c].data());
        const std::size_t size = parts[p].tiled ? sizeof(half) : sizeof(float);
        frame.insert(parts[p].channels[c].first,
                     Imf::Slice(parts[p].tiled ? Imf::HALF : Imf::FLOAT, first, size, 5 * size));
      }
      if (parts[p].tiled) {
        Imf::TiledOutputPart part(file, static_cast<int>(p));
        part.setFrameBuffer(frame);
        for (int level = 0; level < part.numLevels(); ++level)
          part.writeTiles(0, part.numXTiles(level) - 1, 0, part.numYTiles(level) - 1, level);
      } else {
        Imf::OutputPart part(file, static_cast<int>(p));
        part.setFrameBuffer(frame);
        part.writePixels(3);
      }
    }
  }
  return stream.str();
}

TEST_F(ImageTest, ExrOfPartsLayersTilesAndSingleChannels) {
  struct Case {
    std::vector<ExrPart> parts;
    glm::vec3 expected;
    std::size_t warnings;
  };
  const std::vector<Case> cases = {
      {{{{{"R", 1}, {"G", 2}, {"B", 3}}, true}}, {1, 2, 3}, 0},
      {{{{{"Z", 9}}}, {{{"R", 1}, {"G", 2}, {"B", 3}}}}, {1, 2, 3}, 0},
      {{{{{"diffuse.R", 4}, {"diffuse.G", 5}, {"diffuse.B", 6}, {"depth.Z", 9}}}}, {4, 5, 6}, 1},
      {{{{{"density", 7}}, true}}, {7, 7, 7}, 1},
      {{{{{"Y", 8}, {"RY", 0}, {"BY", 0}}}}, {8, 8, 8}, 1},
      {{{{{"a.X", 1}, {"a.Y", 2}}}}, {1, 1, 1}, 1}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const WarningCapture capture;
    write("a.exr", exr_of(cases[i].parts));
    const Image image = load_image(path("a.exr"));
    ASSERT_EQ(image.width, 5) << i;
    for (int c = 0; c < 3; ++c) EXPECT_EQ(image.at(4, 2)[c], cases[i].expected[c]) << i;
    EXPECT_EQ(capture.warnings().size(), cases[i].warnings) << i;
  }
}

TEST_F(ImageTest, ShrinkingKeepsTheMean) {
  const Image image = random_image(19, 7, 3, 9);
  const Image small = shrink(image, 8, 3);
  const auto mean = [](const Image& of) {
    return std::accumulate(of.pixels.begin(), of.pixels.end(), 0.0) / static_cast<double>(of.pixels.size());
  };
  EXPECT_NEAR(mean(small), mean(image), 1e-6 * std::abs(mean(image)));
  EXPECT_EQ(shrink(image, 19, 7).pixels, image.pixels);
}

TEST_F(ImageTest, PngHoldsTheEightBitCodesOfDisplayValues) {
  Image display(256, 1, 3);
  for (int x = 0; x < 256; ++x)
    for (int c = 0; c < 3; ++c) display.at(x, 0)[c] = static_cast<float>(x) / 255.0f;
  save_png(path("ramp.png"), display);
  const Image linear = load_image(path("ramp.png"));
  for (int x = 0; x < 256; ++x) EXPECT_NEAR(linear.at(x, 0)[1], srgb_decode(static_cast<float>(x) / 255.0f), 1e-6) << x;
  const std::vector<std::uint8_t> bytes = read_file(path("ramp.png"));
  const Image8 codes = decode_image8("ramp", bytes.data(), bytes.size());
  for (int x = 0; x < 256; ++x) EXPECT_EQ(codes.rgba[static_cast<std::size_t>(x) * 4 + 2], x);
  EXPECT_EQ(codes.rgba[3], 255);
}

TEST_F(ImageTest, PngClampsAndTakesNanAsBlack) {
  Image display(3, 1, 1);
  display.pixels = {-1.0f, 2.0f, std::numeric_limits<float>::quiet_NaN()};
  save_png(path("clamp.png"), display);
  const Image back = load_image(path("clamp.png"));
  EXPECT_EQ(back.at(0, 0)[0], 0.0f);
  EXPECT_EQ(back.at(1, 0)[0], 1.0f);
  EXPECT_EQ(back.at(2, 0)[0], 0.0f);
}

TEST_F(ImageTest, HdrReadsFlatPixelsAndHeaderInAnyOrder) {
  const std::string pixels("\x80\x40\x00\x81\x00\x00\x00\x00", 8);  // 2^(129-136) = 1/128
  write("flat.hdr", "#?RGBE\nEXPOSURE=2\n# comment\nFORMAT=32-bit_rle_rgbe\nVIEW=x\n\n-Y 1 +X 2\n" + pixels);
  const Image image = load_image(path("flat.hdr"));
  EXPECT_EQ(image.at(0, 0)[0], 0.5f);  // 128/128 over the exposure of 2
  EXPECT_EQ(image.at(0, 0)[1], 0.25f);
  EXPECT_EQ(image.at(1, 0)[0], 0.0f);
}

TEST_F(ImageTest, HdrReadsOldRunsAcrossByteCounts) {
  // One pixel, then 1 + 256 repeats, then another pixel.
  const std::string pixels("\x80\x80\x80\x80\x01\x01\x01\x01\x01\x01\x01\x01\x40\x40\x40\x80", 16);
  write("old.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 259\n" + pixels);
  const Image image = load_image(path("old.hdr"));
  EXPECT_EQ(image.at(257, 0)[0], 0.5f);
  EXPECT_EQ(image.at(258, 0)[0], 0.25f);
}

TEST_F(ImageTest, HdrReadsNewRunsAndFlippedRows) {
  std::string pixels;
  for (int row = 0; row < 2; ++row) {
    pixels += std::string("\x02\x02\x00\x08", 4);
    pixels += std::string("\x88", 1) + static_cast<char>(row == 0 ? 0x80 : 0x40);  // run of 8
    pixels += std::string("\x08\x01\x02\x03\x04\x05\x06\x07\x08", 9);              // 8 literals
    pixels += std::string("\x88\x00", 2) + std::string("\x88\x80", 2);
  }
  write("new.hdr", "#?RADIANCE\n\n+Y 2 +X 8\n" + pixels);
  const Image image = load_image(path("new.hdr"));
  EXPECT_EQ(image.at(0, 1)[0], 0.5f);  // the file's first row is the bottom one
  EXPECT_EQ(image.at(0, 0)[0], 0.25f);
  EXPECT_EQ(image.at(7, 0)[1], 8.0f / 256.0f);
}

// EXR file whose header promises `width` x `height` pixels of `channels` half floats, with its pixels left out.
std::string exr_header(int width, int height, int channels) {
  Imf::Header header(width, height, 1.0f, Imath::V2f(0, 0), 1.0f, Imf::INCREASING_Y, Imf::ZIP_COMPRESSION);
  for (int c = 0; c < channels; ++c)
    header.channels().insert(c < 3 ? std::string(1, "RGB"[c]) : std::string("c").append(std::to_string(c)),
                             Imf::Channel(Imf::HALF));
  Imf::StdOSStream stream;
  { const Imf::OutputFile file(stream, header); }
  return stream.str();
}

void expect_input_error(const std::function<void()>& action, const std::string& part) {
  try {
    action();
    ADD_FAILURE() << "no error, expected: " << part;
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

TEST_F(ImageTest, RefusesWhatItCannotRead) {
  expect_input_error([&] { load_image(path("none.exr")); }, "no such file");
  write("text.exr", "hello");
  expect_input_error([&] { load_image(path("text.exr")); }, "not an image");
  write("huge.hdr", "#?RADIANCE\n\n-Y 16384 +X 16384\n");
  expect_input_error([&] { load_image(path("huge.hdr")); }, "can hardly hold");
  write("absurd.hdr", "#?RADIANCE\n\n-Y 100000 +X 100000\n");
  expect_input_error([&] { load_image(path("absurd.hdr")); }, "too large");
  write("xyz.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n");
  expect_input_error([&] { load_image(path("xyz.hdr")); }, "pixel format");
  expect_input_error([] { decode_image8("texture 3", nullptr, 0); }, "texture 3");
}

// Unfolding all channels is what takes the time, whichever are wanted: known before it begins.
TEST_F(ImageTest, RefusesExrFilesThatUnfoldIntoMuch) {
  write("many.exr", exr_header(1024, 1024, 1000));
  expect_input_error([&] { load_image(path("many.exr")); }, "unfolds into 2000 MiB");
  write("wide.exr", exr_header(16384, 1, 1000));  // one block of lines
  EXPECT_THROW(load_image(path("wide.exr")), InputError);
  write("far.exr", exr_header(8192, 8192, 3));
  expect_input_error([&] { load_image(path("far.exr")); }, "can hardly hold");
  Image honest = random_image(300, 200, 3, 4);
  save_exr(path("honest.exr"), honest);
  EXPECT_EQ(load_image(path("honest.exr")).pixels, honest.pixels);
}

// Truncation at every length and random changes: an image or an InputError, nothing else.
TEST_F(ImageTest, SurvivesDamagedFiles) {
  const Image image = random_image(19, 17, 3, 3);
  std::string rle = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 8\n";
  for (int row = 0; row < 2; ++row) rle += std::string("\x02\x02\x00\x08\x88\x80\x88\x40\x88\x20\x88\x80", 12);
  const std::vector<std::vector<std::uint8_t>> originals = {encode_exr(image), encode_png(image),
                                                            std::vector<std::uint8_t>(rle.begin(), rle.end())};
  const auto decode = [](const std::vector<std::uint8_t>& bytes) {
    try {
      if (is_exr(bytes)) decode_exr("damaged", bytes);
      if (is_hdr(bytes)) decode_hdr("damaged", bytes);
      if (is_png(bytes)) decode_png("damaged", bytes);
      decode_image8("damaged", bytes.data(), bytes.size());
    } catch (const InputError&) {
    }
  };
  const unsigned seed = std::random_device()();
  std::mt19937 random(seed);
  SCOPED_TRACE("seed " + std::to_string(seed));
  for (const auto& original : originals) {
    for (std::size_t size = 0; size < original.size(); size += 7)
      decode({original.begin(), original.begin() + static_cast<std::ptrdiff_t>(size)});
    for (int i = 0; i < 500; ++i) {
      std::vector<std::uint8_t> damaged = original;
      const std::size_t reach = i % 2 ? damaged.size() : std::min<std::size_t>(damaged.size(), 400);  // headers first
      for (int k = 0; k < 1 + i % 4; ++k) damaged[random() % reach] = static_cast<std::uint8_t>(random());
      decode(damaged);
    }
  }
}

TEST_F(ImageTest, ReadsTheSharedReferences) {
  const std::string reference = std::string(LIGHTWELL_SHARED_DIR) + "/references/cornell_original/cam0_direct.exr";
  if (!fs::exists(reference)) GTEST_SKIP() << "no " << reference;
  const Image image = load_image(reference);
  double sum = 0;
  for (float value : image.pixels) sum += value;
  EXPECT_GT(image.width, 0);
  EXPECT_GT(sum, 0);
}

}  // namespace
}  // namespace lightwell
