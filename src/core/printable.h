// Text from files and file names, made fit for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace lightwell {

// Control characters (line breaks and terminal commands among them) and what is not UTF-8 become "\n" or "\x1b"; all
// other text, and so the result itself, comes out unchanged.
std::string printable(std::string_view text);

}  // namespace lightwell
