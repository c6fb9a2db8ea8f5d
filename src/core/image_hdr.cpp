// Radiance pictures (.hdr, .pic), Ward 1991: a text header, a resolution line, then RGBE pixels, flat or in one of two
// run-length codings.
#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "core/image_formats.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

class HdrReader {
 public:
  HdrReader(const std::string& subject, Bytes bytes) : subject_(subject), bytes_(bytes) {}

  Image read();

 private:
  // How the file's scanlines lie in the image: "-Y 10 +X 20" is ten rows from the top, left to right.
  struct Layout {
    int lines = 0;
    int line_length = 0;
    bool lines_are_columns = false;
    bool up = false;    // rows count upwards ("+Y")
    bool left = false;  // columns count leftwards ("-X")
  };

  [[noreturn]] void fail(const std::string& cause) const { throw InputError(subject_, "damaged HDR file: " + cause); }
  std::uint8_t next_byte();
  std::string_view next_text_line();
  void read_header();
  Layout read_layout();
  void read_line(std::vector<Rgbe>& line);
  void read_new_rle(std::vector<Rgbe>& line);
  void read_old_rle(std::vector<Rgbe>& line, Rgbe first);
  void store(const Layout& layout, int line_index, const std::vector<Rgbe>& line, Image& image) const;

  const std::string& subject_;
  Bytes bytes_;
  std::size_t position_ = 0;
  double exposure_ = 1.0;  // product of all EXPOSURE lines: what the pixels were multiplied by
};

std::uint8_t HdrReader::next_byte() {
  if (position_ >= bytes_.size()) fail("unexpected end of file");
  return bytes_[position_++];
}

std::string_view HdrReader::next_text_line() {
  constexpr std::size_t kMaxLine = 65536;
  const std::size_t start = position_;
  while (next_byte() != '\n')
    if (position_ - start > kMaxLine) fail("header line too long");
  std::string_view line(reinterpret_cast<const char*>(bytes_.data()) + start, position_ - 1 - start);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

// Variables in any order, unknown ones and comments ignored, up to an empty line.
void HdrReader::read_header() {
  next_text_line();  // "#?RADIANCE" or another program's name
  for (std::string_view line = next_text_line(); !line.empty(); line = next_text_line()) {
    if (line.starts_with("FORMAT=") && line.substr(7) != "32-bit_rle_rgbe")
      fail("unsupported pixel format " + std::string(line.substr(7)));
    if (line.starts_with("EXPOSURE=")) {
      const double value = std::strtod(std::string(line.substr(9)).c_str(), nullptr);
      if (!std::isfinite(value) || value <= 0) fail("EXPOSURE must be positive");
      exposure_ *= value;
    }
  }
}

HdrReader::Layout HdrReader::read_layout() {
  const std::string line(next_text_line());
  std::array<char, 2> sign{}, axis{};
  std::array<long, 2> size{};
  const char* at = line.c_str();
  for (std::size_t i = 0; i < 2; ++i) {
    while (*at == ' ') ++at;
    if ((at[0] != '+' && at[0] != '-') || (at[1] != 'X' && at[1] != 'Y')) fail("bad resolution line");
    sign[i] = at[0];
    axis[i] = at[1];
    char* end = nullptr;
    size[i] = std::strtol(at + 2, &end, 10);
    if (end == at + 2) fail("bad resolution line");
    at = end;
  }
  if (axis[0] == axis[1]) fail("bad resolution line");
  Layout layout;
  layout.lines_are_columns = axis[0] == 'X';
  const std::size_t y = layout.lines_are_columns ? 1 : 0;
  check_image_size(subject_, size[1 - y], size[y], bytes_.size(), kFloatPixelsPerByte);
  layout.lines = static_cast<int>(size[0]);
  layout.line_length = static_cast<int>(size[1]);
  layout.up = sign[y] == '+';
  layout.left = sign[1 - y] == '-';
  return layout;
}

void HdrReader::read_line(std::vector<Rgbe>& line) {
  Rgbe first;
  for (std::uint8_t& byte : first) byte = next_byte();
  const bool marked = first[0] == 2 && first[1] == 2 && first[2] < 128;
  if (!marked || line.size() < 8 || line.size() > 0x7fff) return read_old_rle(line, first);
  if (static_cast<std::size_t>(first[2]) * 256 + first[3] != line.size()) fail("scanline of wrong length");
  read_new_rle(line);
}

// Each component by itself: a count above 128 is a run, else so many literal bytes follow.
void HdrReader::read_new_rle(std::vector<Rgbe>& line) {
  for (std::size_t component = 0; component < 4; ++component) {
    std::size_t x = 0;
    while (x < line.size()) {
      std::size_t count = next_byte();
      const bool run = count > 128;
      if (run) count -= 128;
      if (count == 0 || count > line.size() - x) fail("run beyond the end of a scanline");
      std::uint8_t value = next_byte();
      for (std::size_t i = 0; i < count; ++i) {
        if (!run && i > 0) value = next_byte();
        line[x++][component] = value;
      }
    }
  }
}

// Whole pixels: (1,1,1,n) repeats the pixel before it n times; consecutive ones count in base 256.
void HdrReader::read_old_rle(std::vector<Rgbe>& line, Rgbe pixel) {
  std::size_t x = 0;
  unsigned shift = 0;
  for (bool first = true; x < line.size(); first = false) {
    if (!first)
      for (std::uint8_t& byte : pixel) byte = next_byte();
    if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      line[x++] = pixel;
      shift = 0;
      continue;
    }
    if (x == 0 || shift > 16) fail("run without a pixel");
    const std::size_t count = static_cast<std::size_t>(pixel[3]) << shift;
    if (count > line.size() - x) fail("run beyond the end of a scanline");
    for (std::size_t i = 0; i < count; ++i, ++x) line[x] = line[x - 1];
    shift += 8;
  }
}

void HdrReader::store(const Layout& layout, int line_index, const std::vector<Rgbe>& line, Image& image) const {
  for (int i = 0; i < layout.line_length; ++i) {
    int x = layout.lines_are_columns ? line_index : i;
    int y = layout.lines_are_columns ? i : line_index;
    if (layout.left) x = image.width - 1 - x;
    if (layout.up) y = image.height - 1 - y;
    const Rgbe& pixel = line[static_cast<std::size_t>(i)];
    const double scale = pixel[3] == 0 ? 0.0 : std::ldexp(1.0, pixel[3] - (128 + 8)) / exposure_;
    for (std::size_t c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<float>(pixel[c] * scale);
  }
}

Image HdrReader::read() {
  read_header();
  const Layout layout = read_layout();
  Image image(layout.lines_are_columns ? layout.lines : layout.line_length,
              layout.lines_are_columns ? layout.line_length : layout.lines, 3);
  std::vector<Rgbe> line(static_cast<std::size_t>(layout.line_length));
  for (int i = 0; i < layout.lines; ++i) {
    read_line(line);
    store(layout, i, line, image);
  }
  return image;
}

}  // namespace

bool is_hdr(Bytes bytes) {
  return bytes.size() >= 2 && bytes[0] == '#' && bytes[1] == '?';
}

Image decode_hdr(const std::string& subject, Bytes bytes) {
  return HdrReader(subject, bytes).read();
}

}  // namespace lightwell
