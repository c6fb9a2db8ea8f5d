#include "scene/uri.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "lightwell/error.h"

namespace lightwell {

namespace {

constexpr std::uint8_t kNotBase64 = 0xff;

std::array<std::uint8_t, 256> base64_digits() {
  constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::uint8_t, 256> digits;
  digits.fill(kNotBase64);
  for (std::size_t i = 0; i < kAlphabet.size(); ++i)
    digits[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::uint8_t>(i);
  return digits;
}

std::vector<std::uint8_t> decode_base64(const std::string& subject, std::string_view text) {
  static const std::array<std::uint8_t, 256> kDigits = base64_digits();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size() * 3 / 4);
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : text) {
    const std::uint8_t digit = kDigits[static_cast<unsigned char>(c)];
    if (digit == kNotBase64) throw InputError(subject, "invalid base64 in a data URI");
    bits = (bits << 6 | digit) & 0xffffff;
    bit_count += 6;
    if (bit_count >= 8) {
      bit_count -= 8;
      bytes.push_back(static_cast<std::uint8_t>(bits >> bit_count));
    }
  }
  return bytes;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string percent_decode(const std::string& text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = text[i] == '%' && i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(text[i + 2]) : -1;
    if (low >= 0) i += 2;
    decoded += low >= 0 ? static_cast<char>(high * 16 + low) : text[i];
  }
  return decoded;
}

std::string beside(const std::string& base, const std::string& name) {
  if (name.find('\0') != std::string::npos) throw InputError(base, "a file name in it holds a zero byte");
  return (std::filesystem::path(base).parent_path() / name).string();
}

}  // namespace

std::optional<std::vector<std::uint8_t>> decode_data_uri(const std::string& subject, std::string_view uri) {
  if (!uri.starts_with("data:")) return std::nullopt;
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64"))
    throw InputError(subject, "a data URI in it is not base64");
  return decode_base64(subject, uri.substr(comma + 1));
}

std::string resolve_uri(const std::string& base, const std::string& uri) {
  const std::size_t colon = uri.find(':');
  if (colon != std::string::npos && colon < uri.find('/'))
    throw InputError(base, "unsupported URI '" + uri.substr(0, 80) + "'; expected a relative file name");
  return beside(base, percent_decode(uri));
}

std::string resolve_name(const std::string& base, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return beside(base, name);
}

std::string image_name(const std::string& uri) {
  const std::string name = percent_decode(uri);
  constexpr std::string_view kFile = "file://";
  return name.starts_with(kFile) ? name.substr(kFile.size()) : name;
}

std::string last_part(std::string name) {
  if (name.find("://") != std::string::npos) name = name.substr(0, name.find_first_of("?#"));
  return name.substr(name.find_last_of("/\\") + 1);
}

}  // namespace lightwell
