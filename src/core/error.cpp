#include "lightwell/error.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace lightwell {

namespace {

std::string single_line(std::string_view subject, std::string_view cause) {
  std::string line = std::string(subject) + ": " + std::string(cause);
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

}  // namespace

InputError::InputError(std::string_view subject, std::string_view cause)
    : std::runtime_error(single_line(subject, cause)) {}

void detail::assertion_failed(const char* expression, const char* file, int line, const std::string& message) {
  std::fprintf(stderr, "%s:%d: assertion failed: %s: %s\n", file, line, expression, message.c_str());
  std::abort();
}

}  // namespace lightwell
