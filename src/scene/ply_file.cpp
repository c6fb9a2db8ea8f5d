#include "scene/ply_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "scene/text_scanner.h"

namespace lightwell {

namespace {

std::size_t size_of(PlyScalar type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

constexpr std::size_t kMaxHeaderLine = 10000;

}  // namespace

PlyFile::PlyFile(const std::string& path, const SceneFiles& files) : path_(path), bytes_(files.read(path)) {
  body_ = without_byte_order_mark({reinterpret_cast<const char*>(bytes_.data()), bytes_.size()});
  read_header();
}

PlyScalar PlyFile::parse_type(std::string_view name) const {
  struct Name {
    std::string_view name;
    PlyScalar type;
  };
  constexpr std::array<Name, 16> kNames = {{{"char", PlyScalar::kInt8},
                                            {"int8", PlyScalar::kInt8},
                                            {"uchar", PlyScalar::kUint8},
                                            {"uint8", PlyScalar::kUint8},
                                            {"short", PlyScalar::kInt16},
                                            {"int16", PlyScalar::kInt16},
                                            {"ushort", PlyScalar::kUint16},
                                            {"uint16", PlyScalar::kUint16},
                                            {"int", PlyScalar::kInt32},
                                            {"int32", PlyScalar::kInt32},
                                            {"uint", PlyScalar::kUint32},
                                            {"uint32", PlyScalar::kUint32},
                                            {"float", PlyScalar::kFloat},
                                            {"float32", PlyScalar::kFloat},
                                            {"double", PlyScalar::kDouble},
                                            {"float64", PlyScalar::kDouble}}};
  for (const Name& known : kNames)
    if (name == known.name) return known.type;
  fail("unknown PLY type '" + std::string(name.substr(0, 20)) + "'");
}

void PlyFile::header_line(std::string_view line) {
  const std::string_view key = take_word(line);
  if (key == "format") {
    const std::string_view format = take_word(line);
    ascii_ = format == "ascii";
    if (!ascii_ && format != "binary_little_endian" && format != "binary_big_endian") fail("unknown PLY format");
    swap_ = (format == "binary_big_endian") != (std::endian::native == std::endian::big);
  } else if (key == "element") {
    PlyElement element;
    element.name = take_word(line);
    const auto count = parse_integer(take_word(line));
    if (!count || *count < 0) fail("malformed PLY header: element count");
    element.count = static_cast<std::uint64_t>(*count);
    elements_.push_back(std::move(element));
  } else if (key == "property") {
    if (elements_.empty()) fail("malformed PLY header: property before any element");
    PlyProperty property;
    std::string_view type = take_word(line);
    property.is_list = type == "list";
    if (property.is_list) {
      property.count_type = parse_type(take_word(line));
      type = take_word(line);
    }
    property.type = parse_type(type);
    property.name = take_word(line);
    elements_.back().properties.push_back(std::move(property));
  } else if (key == "comment") {
    comment(line);
  } else if (!key.empty() && key != "obj_info") {
    fail("malformed PLY header: '" + std::string(key.substr(0, 20)) + "'");
  }
}

// MeshLab names textures so.
void PlyFile::comment(std::string_view text) {
  if (take_word(text) == "TextureFile") texture_files_.emplace_back(trimmed(text));
}

void PlyFile::read_header() {
  if (!body_.starts_with("ply")) fail("not a PLY file");
  // One kind of line end in the whole header: a body may begin with bytes that look like another.
  const std::size_t first = std::min(body_.find_first_of("\r\n"), body_.size());
  const char line_end = body_.substr(first).starts_with('\r') && !body_.substr(first).starts_with("\r\n") ? '\r' : '\n';
  const auto take_line = [&] {
    const std::size_t end = body_.find(line_end);
    if (end == std::string_view::npos || end > kMaxHeaderLine) fail("malformed PLY header");
    const std::string_view line = trimmed(body_.substr(0, end));
    body_.remove_prefix(end + 1);
    return line;
  };
  if (take_line() != "ply") fail("not a PLY file");
  for (std::string_view line = take_line(); line != "end_header"; line = take_line()) header_line(line);
}

// An element takes at least this much of the file.
void PlyFile::check_count(const PlyElement& element) const {
  std::uint64_t least = 0;
  for (const PlyProperty& p : element.properties) least += ascii_ ? 1 : size_of(p.is_list ? p.count_type : p.type);
  if (least > 0 && element.count > body_.size() / least + 1)
    fail("truncated: " + std::to_string(element.count) + " of '" + element.name.substr(0, 40) + "' promised");
  if (element.count > std::numeric_limits<std::uint32_t>::max())
    fail("too many of '" + element.name.substr(0, 40) + "'");
}

template <typename T>
double PlyFile::binary_scalar() {
  if (body_.size() < sizeof(T)) fail("truncated");
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), body_.data(), sizeof(T));
  if (swap_) std::reverse(raw.begin(), raw.end());
  body_.remove_prefix(sizeof(T));
  return static_cast<double>(std::bit_cast<T>(raw));
}

double PlyFile::scalar(PlyScalar type) {
  if (ascii_) {
    constexpr std::string_view kBlanks = " \t\r\n\v\f";
    body_.remove_prefix(std::min(body_.find_first_not_of(kBlanks), body_.size()));
    const std::string_view word = body_.substr(0, body_.find_first_of(kBlanks));
    if (word.empty()) fail("truncated");
    body_.remove_prefix(word.size());
    return parse_double(word).value_or(std::numeric_limits<double>::quiet_NaN());
  }
  switch (type) {
    case PlyScalar::kInt8:
      return binary_scalar<std::int8_t>();
    case PlyScalar::kUint8:
      return binary_scalar<std::uint8_t>();
    case PlyScalar::kInt16:
      return binary_scalar<std::int16_t>();
    case PlyScalar::kUint16:
      return binary_scalar<std::uint16_t>();
    case PlyScalar::kInt32:
      return binary_scalar<std::int32_t>();
    case PlyScalar::kUint32:
      return binary_scalar<std::uint32_t>();
    case PlyScalar::kFloat:
      return binary_scalar<float>();
    case PlyScalar::kDouble:
      break;
  }
  return binary_scalar<double>();
}

std::uint64_t PlyFile::take_size(const PlyProperty& property) {
  if (!property.is_list) return 1;
  const double size = scalar(property.count_type);
  if (!(size >= 0.0) || size != std::floor(size) || size > static_cast<double>(body_.size()))
    fail("a list has an impossible length");
  return static_cast<std::uint64_t>(size);
}

void PlyFile::skip(const PlyElement& element) {
  if (element.properties.empty()) return;
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const PlyProperty& property : element.properties)
      for (std::uint64_t n = take_size(property); n > 0; --n) scalar(property.type);
}

}  // namespace lightwell
