#include "scene/text_scanner.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace lightwell {

namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

std::string_view without_comment(std::string_view line) {
  for (std::size_t at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1))
    if (at == 0 || kBlanks.find(line[at - 1]) != std::string_view::npos) return line.substr(0, at);
  return line;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  while (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

std::string_view LineReader::take_physical_line() {
  const std::size_t end = std::min(text_.find_first_of("\r\n"), text_.size());
  const std::string_view line = text_.substr(0, end);
  text_.remove_prefix(end);
  text_.remove_prefix(text_.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, text_.size()));
  ++next_line_;
  return without_byte_order_mark(line);
}

bool LineReader::next(std::string_view& line) {
  if (text_.empty()) return false;
  first_line_ = next_line_;
  line = take_physical_line();
  const auto goes_on = [](std::string_view part) { return part.ends_with('\\') && without_comment(part) == part; };
  if (goes_on(line) && !text_.empty()) {
    joined_.assign(line.substr(0, line.size() - 1));
    bool more = true;
    while (more && !text_.empty()) {
      line = take_physical_line();
      more = goes_on(line);
      joined_.append(" ").append(more ? line.substr(0, line.size() - 1) : line);
    }
    line = joined_;
  }
  with_comment_ = trimmed(line);
  line = trimmed(without_comment(line));
  return true;
}

std::string_view take_word(std::string_view& line) {
  const std::size_t first = std::min(line.find_first_not_of(kBlanks), line.size());
  line.remove_prefix(first);
  const std::size_t end = std::min(line.find_first_of(kBlanks), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(end);
  return word;
}

std::optional<double> parse_double(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || end != word.data() + word.size()) return std::nullopt;
  // Too small for a double is as good as zero; too large is not a number.
  if (error == std::errc::result_out_of_range)
    return word.find('-', 1) == word.npos ? std::nullopt : std::optional(0.0);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<float> parse_float(std::string_view word) {
  const std::optional<double> value = parse_double(word);
  if (!value || std::abs(*value) > static_cast<double>(std::numeric_limits<float>::max())) return std::nullopt;
  return static_cast<float>(*value);
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace lightwell
