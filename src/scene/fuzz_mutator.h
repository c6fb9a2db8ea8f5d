// Random damage to files, made so that much of it gets past the first checks.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lightwell::test {

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }

  std::string mutate(std::string content) {
    for (std::size_t steps = 1 + below(6) / 4; steps > 0; --steps) mutate_once(content);
    if (content.starts_with("\x89PNG") && below(4) > 0) mend_checksums(content);
    return content;
  }

 private:
  // First byte and end.
  using Span = std::pair<std::size_t, std::size_t>;

  void mutate_once(std::string& content) {
    if (content.empty()) return;
    const bool is_json = content.starts_with('{');
    if (content.starts_with("glTF") && below(2) == 0) return mutate_json_chunk(content);
    switch (below(10)) {
      case 0:
        content.resize(below(content.size()));
        break;
      case 1:
        for (std::size_t n = 1 + below(8); n > 0; --n)
          content[below(content.size())] ^= static_cast<char>(1 << below(8));
        break;
      case 2:
        overwrite_word(content);
        break;
      case 3: {
        const std::string chunk = some_chunk(content);
        content.insert(below(content.size()), chunk);
        break;
      }
      case 4: {
        const std::size_t at = below(content.size());
        content.erase(at, 1 + below(32));
        break;
      }
      case 5:
        if (is_json) return replace_json_string(content);
        [[fallthrough]];
      case 6:
      case 7:
        if (is_json) return replace_json_number(content);
        [[fallthrough]];
      default:
        replace_number(content);
    }
  }

  std::string some_chunk(const std::string& content) { return content.substr(below(content.size()), 1 + below(64)); }

  // Of GLB: values of the JSON; the lengths are mended, so that the rest is read.
  void mutate_json_chunk(std::string& content) {
    constexpr std::size_t kHead = 20;  // of the file and of its first chunk
    std::uint32_t length = 0;
    if (content.size() < kHead) return;
    std::memcpy(&length, content.data() + 12, 4);
    if (length > content.size() - kHead) return;
    std::string json = content.substr(kHead, length);
    below(3) == 0 ? replace_json_string(json) : replace_json_number(json);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    content.replace(kHead, length, json);
    put_word(content, 12, static_cast<std::uint32_t>(json.size()));
    put_word(content, 8, static_cast<std::uint32_t>(content.size()));
  }

  // Numbers outside of strings, where base64 has none; strings with their quotes.
  struct JsonParts {
    std::vector<Span> numbers;
    std::vector<Span> strings;
  };
  static JsonParts parts_of(const std::string& json) {
    JsonParts parts;
    for (std::size_t i = 0; i < json.size(); ++i) {
      if (json[i] == '"') {
        const std::size_t first = i++;
        while (i < json.size() && json[i] != '"') i += json[i] == '\\' ? 2 : 1;
        if (i < json.size()) parts.strings.emplace_back(first, i + 1);
      } else if (std::string_view("-0123456789").find(json[i]) != std::string_view::npos) {
        const std::size_t end = std::min(json.find_first_not_of("+-.eE0123456789", i), json.size());
        parts.numbers.emplace_back(i, end);
        i = end - 1;
      }
    }
    return parts;
  }

  // A number becomes its neighbour, its negative, another of the file, or something else.
  void replace_json_number(std::string& json) {
    constexpr const char* kValues[] = {"0",    "-1",   "1e-7",  "0.99999994", "1.0000001",  "-0.0",
                                       "1e38", "1e39", "1e400", "-1e38",      "4294967295", "18446744073709551616",
                                       "0.5",  "2",    "3",     "255",        "65536",      "5120",
                                       "5121", "5122", "5123",  "5125",       "5126",       "null",
                                       "true", "[]",   "{}",    "\"x\"",      "[1,2]",      "9007199254740991",
                                       "4",    "7",    "1000",  "2147483648"};
    const std::vector<Span> numbers = parts_of(json).numbers;
    if (numbers.empty()) return;
    const auto [first, end] = numbers[below(numbers.size())];
    const std::string old = json.substr(first, end - first);
    const bool is_integer = old.find_first_of(".eE") == std::string::npos;
    std::string value;
    switch (below(6)) {
      case 0: {
        const double step = below(2) == 0 ? 1.0 : -1.0;
        value = is_integer ? std::to_string(std::atoll(old.c_str()) + static_cast<long long>(step))
                           : std::to_string(std::atof(old.c_str()) + step);
        break;
      }
      case 1:
        value = old[0] == '-' ? old.substr(1) : "-" + old;
        break;
      case 2: {
        const auto [other, other_end] = numbers[below(numbers.size())];
        value = json.substr(other, other_end - other);
        break;
      }
      default:
        value = kValues[below(std::size(kValues))];
    }
    json.replace(first, end - first, value);
  }

  // A name or word becomes another of the file, or something else.
  void replace_json_string(std::string& json) {
    constexpr const char* kValues[] = {"\"\"", "\"x\"", "\"\\u0000\"", "\"../p.png\"", "\"data:,\"", "\"VEC4\"", "0"};
    const std::vector<Span> strings = parts_of(json).strings;
    if (strings.empty()) return;
    const auto [first, end] = strings[below(strings.size())];
    const auto [other, other_end] = strings[below(strings.size())];
    const std::string value =
        below(2) == 0 ? kValues[below(std::size(kValues))] : json.substr(other, other_end - other);
    json.replace(first, end - first, value);
  }

  // A number written in digits becomes one that is likely to be trouble.
  void replace_number(std::string& content) {
    constexpr const char* kNumbers[] = {"0",     "-1",         "1",
                                        "2",     "3",          "255",
                                        "65535", "2147483647", "2147483648",
                                        "0.5",   "4294967295", "9007199254740993",
                                        "1e38",  "1e39",       "18446744073709551616",
                                        "nan",   "inf",        "-9223372036854775808",
                                        "5126",  "5123",       "-1e-45",
                                        "5121",  "1000000",    "1e400",
                                        ""};
    const std::size_t first = content.find_first_of("0123456789", below(content.size()));
    if (first == std::string::npos) return;
    const std::size_t end = std::min(content.find_first_not_of("0123456789.", first), content.size());
    content.replace(first, end - first, kNumbers[below(std::size(kNumbers))]);
  }

  void overwrite_word(std::string& content) {
    constexpr std::uint32_t kWords[] = {0,          1,          0x7fffffff, 0x80000000, 0xffffffff,
                                        0x7fc00000, 0x7f800000, 0xffff,     0x01000000};
    const std::uint32_t word = kWords[below(std::size(kWords))];
    const std::size_t width = std::size_t{1} << below(3);
    const std::size_t at = below(content.size());
    content.replace(at, std::min(width, content.size() - at), reinterpret_cast<const char*>(&word), width);
  }

  static void put_word(std::string& content, std::size_t at, std::uint32_t value) {
    std::memcpy(content.data() + at, &value, 4);
  }

  // Of PNG: the checksum of every chunk, so that the decoder sees the damage.
  static void mend_checksums(std::string& png) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(png[i])); };
    for (std::size_t at = 8; at + 12 <= png.size();) {
      const std::size_t length = byte(at) << 24 | byte(at + 1) << 16 | byte(at + 2) << 8 | byte(at + 3);
      if (length > png.size() - at - 12) return;
      const auto sum = static_cast<std::uint32_t>(
          crc32(0, reinterpret_cast<const Bytef*>(png.data()) + at + 4, static_cast<uInt>(length + 4)));
      for (std::size_t k = 0; k < 4; ++k) png[at + 8 + length + k] = static_cast<char>(sum >> (24 - 8 * k));
      at += 12 + length;
    }
  }

  std::mt19937_64 random_;
};

}  // namespace lightwell::test
