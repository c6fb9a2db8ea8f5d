// "a, b, c"
#pragma once

#include <string>
#include <vector>

namespace lightwell {

std::string join(const std::vector<std::string>& parts);

}  // namespace lightwell
