// Ranges of options, checked where a renderer of the reference is told them.
#pragma once

#include <limits>
#include <string>

#include "lightwell/error.h"

namespace lightwell {

inline constexpr int kMaxSamples = 1 << 20;
inline constexpr int kMaxBounces = 1024;
inline constexpr int kMaxThreads = 1024;
inline constexpr int kMaxSeed = std::numeric_limits<int>::max();

// Throws InputError naming `subject` and the option.
inline void check_range(const char* subject, const char* name, int value, int minimum, int maximum) {
  if (value >= minimum && value <= maximum) return;
  throw InputError(subject, std::string(name) + " " + std::to_string(value) + " is not in [" + std::to_string(minimum) +
                                ", " + std::to_string(maximum) + "]");
}

}  // namespace lightwell
