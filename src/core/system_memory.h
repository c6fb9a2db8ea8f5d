// How much memory this process may have.
#pragma once

#include <cstdint>
#include <string>

namespace lightwell {

// Bytes: the machine's, or fewer where a limit on the process or a control group of Linux (version 1 or 2) says so.
// Others may have taken some of it. `root` holds /proc and /sys/fs/cgroup; tests have their own.
std::uint64_t memory_limit(const std::string& root = "");

}  // namespace lightwell
