#pragma once

#include <cstdint>

namespace lightwell {

// The smallest multiple of `alignment` that is not below `value`.
constexpr std::uint64_t align_up(std::uint64_t value, std::uint64_t alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

}  // namespace lightwell
