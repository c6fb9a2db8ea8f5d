// Line and token reading for OBJ, MTL and ASCII PLY. Independent of the locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lightwell {

// Logical lines of a text: "\n", "\r\n" and "\r" end lines; a backslash before the end joins it to the next one, but
// not in a comment; comments ("#" at the start of a word), surrounding blanks and byte order marks at the start of a
// line are removed.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : text_(text) {}
  // False at the end. `line` is valid until the next call.
  bool next(std::string_view& line);
  // The line that next() returned, but with its comment: names may hold "#". Valid until the next call.
  std::string_view with_comment() const { return with_comment_; }
  // Of the line that next() returned, counted from 1.
  long line_number() const { return first_line_; }

 private:
  std::string_view take_physical_line();

  std::string_view text_;
  std::string joined_;
  std::string_view with_comment_;
  long first_line_ = 0;
  long next_line_ = 1;
};

// A UTF-8 byte order mark is removed where `text` begins with one: joined files have them in their middle too.
std::string_view without_byte_order_mark(std::string_view text);

// Removes the first word from `line` and returns it; empty at the end.
std::string_view take_word(std::string_view& line);

std::string_view trimmed(std::string_view text);

// The whole of `word` as a finite number or an integer.
std::optional<float> parse_float(std::string_view word);
std::optional<double> parse_double(std::string_view word);
std::optional<std::int64_t> parse_integer(std::string_view word);

}  // namespace lightwell
