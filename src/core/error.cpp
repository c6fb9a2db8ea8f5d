#include "lightwell/error.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "core/printable.h"

namespace lightwell {

namespace {

std::string single_line(std::string_view subject, std::string_view cause) {
  // Libraries break their messages into lines, and end them with one.
  std::string text(cause);
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return printable(std::string(subject) + ": " + text);
}

}  // namespace

InputError::InputError(std::string_view subject, std::string_view cause)
    : std::runtime_error(single_line(subject, cause)) {}

void detail::assertion_failed(const char* expression, const char* file, int line, const std::string& message) {
  std::fprintf(stderr, "%s:%d: assertion failed: %s: %s\n", file, line, expression, message.c_str());
  std::abort();
}

}  // namespace lightwell
