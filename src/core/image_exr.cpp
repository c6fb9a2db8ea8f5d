#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfIO.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfTileDescription.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "core/image_formats.h"
#include "core/log.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

class MemoryInput : public Imf::IStream {
 public:
  MemoryInput(const std::string& name, Bytes bytes) : IStream(name.c_str()), bytes_(bytes) {}

  bool read(char out[], int count) override {
    if (count < 0 || static_cast<std::uint64_t>(count) > bytes_.size() - position_)
      throw std::runtime_error("unexpected end of file");
    std::memcpy(out, bytes_.data() + position_, static_cast<std::size_t>(count));
    position_ += static_cast<std::uint64_t>(count);
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override {
    if (position > bytes_.size()) throw std::runtime_error("offset beyond the end of the file");
    position_ = position;
  }

 private:
  Bytes bytes_;
  std::uint64_t position_ = 0;
};

class MemoryOutput : public Imf::OStream {
 public:
  MemoryOutput() : OStream("memory") {}

  void write(const char data[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (bytes.size() < position_ + size) bytes.resize(position_ + size);
    std::memcpy(bytes.data() + position_, data, size);
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  std::vector<std::uint8_t> bytes;

 private:
  std::uint64_t position_ = 0;
};

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// Channels of a part that can be read as R, G and B.
struct Choice {
  std::array<std::string, 3> names;
  int rank = -1;        // the more, the likelier what is meant; -1: there are none
  std::string warning;  // of what is left out
};

bool has_channels(const Imf::ChannelList& channels, const std::string& prefix) {
  return channels.findChannel((prefix + "R").c_str()) && channels.findChannel((prefix + "G").c_str()) &&
         channels.findChannel((prefix + "B").c_str());
}

Choice colors_of(const std::string& prefix, int rank, const std::string& warning = "") {
  return {{prefix + "R", prefix + "G", prefix + "B"}, rank, warning};
}

// Blender's Combined, R, G and B, those of the first layer that has them, Y, or any channel.
Choice find_channels(const Imf::ChannelList& channels) {
  std::string layer, single;
  for (auto c = channels.begin(); c != channels.end(); ++c) {
    const std::string name = c.name();
    const std::string prefix = name.substr(0, name.size() - 1);
    if (ends_with(name, ".Combined.R") && has_channels(channels, prefix)) return colors_of(prefix, 4);
    if (layer.empty() && ends_with(name, ".R") && has_channels(channels, prefix)) layer = prefix;
    if (single.empty()) single = name;
  }
  if (has_channels(channels, "")) return colors_of("", 4);
  if (!layer.empty()) return colors_of(layer, 3, "of its layers '" + layer.substr(0, layer.size() - 1) + "' is read");
  if (channels.findChannel("Y")) {
    const bool has_color = channels.findChannel("RY") || channels.findChannel("BY");
    return {{"Y", "Y", "Y"}, 2, has_color ? "colour beside luminance (RY, BY) is not read: grey" : ""};
  }
  if (single.empty()) return {};
  return {{single, single, single}, 1, "no colours; channel '" + single + "' is read as grey"};
}

void check_sampling(const std::string& subject, const Imf::ChannelList& channels, const Choice& choice) {
  for (const std::string& name : choice.names) {
    const Imf::Channel* channel = channels.findChannel(name.c_str());
    if (channel->xSampling != 1 || channel->ySampling != 1)
      throw InputError(subject, "EXR channel " + name + " is subsampled");
  }
}

// Bytes that the library unfolds: all channels of whole blocks, whichever are wanted.
std::uint64_t unfolded_bytes(const Imf::Header& header, std::uint64_t width, std::uint64_t height) {
  std::uint64_t pixel_bytes = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
    pixel_bytes += c.channel().type == Imf::HALF ? 2 : 4;
  std::uint64_t block_width = 1, block_height = 256;  // the most lines that are compressed together (DWAB)
  if (header.hasTileDescription()) {
    block_width = header.tileDescription().xSize;
    block_height = header.tileDescription().ySize;
  }
  const auto whole = [](std::uint64_t size, std::uint64_t block) { return (size + block - 1) / block * block; };
  return whole(width, block_width) * whole(height, block_height) * pixel_bytes;
}

// Everything that decides how much memory and time the library will take, before it does.
void check_header(const std::string& subject, const Imf::Header& header, std::size_t file_bytes) {
  if (header.hasType() && Imf::isDeepData(header.type())) throw InputError(subject, "deep EXR files are not supported");
  const Imath::Box2i window = header.dataWindow();
  check_image_size(subject, std::int64_t{window.max.x} - window.min.x + 1,
                   std::int64_t{window.max.y} - window.min.y + 1, file_bytes, kFloatPixelsPerByte);
  constexpr unsigned kMaxTileSide = 4096;
  if (header.hasTileDescription() &&
      (header.tileDescription().xSize > kMaxTileSide || header.tileDescription().ySize > kMaxTileSide))
    throw InputError(subject, "EXR tiles larger than 4096 pixels a side");
  // A file of many layers, most of them empty, is honest; 1 GiB of them takes about two seconds. Deflate packs at most
  // 1032:1.
  const std::uint64_t allowed =
      std::min((std::uint64_t{256} << 20) + 1032 * file_bytes, (std::uint64_t{1} << 30) + 64 * file_bytes);
  const auto width = static_cast<std::uint64_t>(window.max.x - window.min.x) + 1;
  const auto height = static_cast<std::uint64_t>(window.max.y - window.min.y) + 1;
  const std::uint64_t used = width * height * 3 * sizeof(float);
  const std::uint64_t unfolded = unfolded_bytes(header, width, height);
  if (unfolded > used + allowed)
    throw InputError(subject, "EXR file of " + std::to_string(file_bytes) + " bytes unfolds into " +
                                  std::to_string(unfolded >> 20) + " MiB, most of it in channels that are not used");
}

Imath::V2i size_of(const Imath::Box2i& window) {
  return window.max - window.min + Imath::V2i(1, 1);
}

// Pixels where the file has them, black elsewhere; those beyond the display window are cut off.
Image crop(const Image& data, const Imath::Box2i& window, const Imath::Box2i& display) {
  const Imath::V2i size = size_of(display);
  Image image(size.x, size.y, data.channels);
  const int first = std::max(window.min.x, display.min.x), last = std::min(window.max.x, display.max.x);
  for (int y = std::max(window.min.y, display.min.y); y <= std::min(window.max.y, display.max.y); ++y)
    if (first <= last)
      std::copy_n(data.at(first - window.min.x, y - window.min.y), (last - first + 1) * data.channels,
                  image.at(first - display.min.x, y - display.min.y));
  return image;
}

Image read_part(const std::string& subject, Imf::MultiPartInputFile& file, int index, const Choice& choice) {
  const Imath::Box2i window = file.header(index).dataWindow();
  const Imath::V2i size = size_of(window);
  Image image(size.x, size.y, 3);
  const std::size_t x_stride = 3 * sizeof(float);
  const std::size_t y_stride = x_stride * static_cast<std::size_t>(image.width);
  Imf::FrameBuffer frame;
  const int distinct = choice.names[0] == choice.names[1] ? 1 : 3;
  for (int c = 0; c < distinct; ++c)
    frame.insert(choice.names[static_cast<std::size_t>(c)],
                 Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, window, x_stride, y_stride));
  Imf::InputPart part(file, index);
  part.setFrameBuffer(frame);
  part.readPixels(window.min.y, window.max.y);
  if (distinct == 1)
    for (std::size_t i = 0; i < image.pixels.size(); i += 3)
      image.pixels[i + 1] = image.pixels[i + 2] = image.pixels[i];
  if (!choice.warning.empty()) log_warning(subject + ": " + choice.warning);
  return image;
}

// Of the part that most likely holds what is meant; of several, the first.
Image read_image(const std::string& subject, Bytes bytes) {
  MemoryInput stream(subject, bytes);
  Imf::MultiPartInputFile file(stream, 0);
  int best_part = 0;
  Choice best;
  for (int i = 0; i < file.parts(); ++i) {
    const Imf::Header& header = file.header(i);
    if (header.hasType() && Imf::isDeepData(header.type())) continue;
    Choice choice = find_channels(header.channels());
    if (choice.rank <= best.rank) continue;
    best = std::move(choice);
    best_part = i;
  }
  const Imf::Header& header = file.header(best_part);
  check_header(subject, header, bytes.size());
  if (best.rank < 0) throw InputError(subject, "EXR file without channels");
  check_sampling(subject, header.channels(), best);
  const Imath::Box2i window = header.dataWindow(), display = header.displayWindow();
  if (window == display) return read_part(subject, file, best_part, best);
  check_image_size(subject, std::int64_t{display.max.x} - display.min.x + 1,
                   std::int64_t{display.max.y} - display.min.y + 1, bytes.size(), kFloatPixelsPerByte);
  if (!window.intersects(display)) log_warning(subject + ": no pixels within its display window: black");
  return crop(read_part(subject, file, best_part, best), window, display);
}

}  // namespace

bool is_exr(Bytes bytes) {
  return bytes.size() >= 4 && bytes[0] == 0x76 && bytes[1] == 0x2f && bytes[2] == 0x31 && bytes[3] == 0x01;
}

Image decode_exr(const std::string& subject, Bytes bytes) {
  try {
    return read_image(subject, bytes);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError(subject, std::string("damaged EXR file: ") + e.what());
  }
}

std::vector<std::uint8_t> encode_exr(const Image& image) {
  LW_ASSERT(image.channels == 1 || image.channels == 3, std::to_string(image.channels) + " channels");
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  const std::size_t x_stride = static_cast<std::size_t>(image.channels) * sizeof(float);
  const std::size_t y_stride = x_stride * static_cast<std::size_t>(image.width);
  Imf::FrameBuffer frame;
  const auto add_channel = [&](const char* name, int c) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    float* first = const_cast<float*>(image.pixels.data()) + c;  // the library only reads
    frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(first), x_stride, y_stride));
  };
  if (image.channels == 1) {
    add_channel("Y", 0);
  } else {
    add_channel("R", 0);
    add_channel("G", 1);
    add_channel("B", 2);
  }
  MemoryOutput stream;
  {
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
  }  // writes the table of lines
  return std::move(stream.bytes);
}

}  // namespace lightwell
