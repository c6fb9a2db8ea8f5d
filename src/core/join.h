// "a, b, c"
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lightwell {

std::string join(std::span<const std::string> parts);
std::string join(std::span<const std::string_view> parts);

}  // namespace lightwell
