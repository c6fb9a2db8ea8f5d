// Errors. Three kinds, three answers (docs/architecture.md):
//   a programmer's mistake   -> LW_ASSERT: prints the operands and aborts, in release builds too
//   bad input or environment -> InputError: one line for the user, exit code 2
//   an expected absence      -> a return value
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace lightwell {

// Bad input or environment: `subject` names the file, option or device, `cause` says what is wrong with it.
// what() is "subject: cause", always a single line.
class InputError : public std::runtime_error {
 public:
  InputError(std::string_view subject, std::string_view cause);
};

namespace detail {
[[noreturn]] void assertion_failed(const char* expression, const char* file, int line, const std::string& message);
}

}  // namespace lightwell

// Checks what only a programmer can get wrong. `message` is a std::string expression, evaluated on failure only.
#define LW_ASSERT(expression, message) \
  ((expression) ? void() : ::lightwell::detail::assertion_failed(#expression, __FILE__, __LINE__, (message)))
