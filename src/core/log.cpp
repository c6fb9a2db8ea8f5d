#include "core/log.h"

#include <atomic>
#include <cstdio>
#include <string>

namespace lightwell {

namespace {

std::atomic<LogLevel> g_level{LogLevel::kWarning};

void write(LogLevel level, std::string_view prefix, std::string_view message) {
  if (level > g_level.load(std::memory_order_relaxed)) return;
  std::string line = "lightwell: ";
  line.append(prefix).append(message).push_back('\n');
  std::fwrite(line.data(), 1, line.size(), stderr);  // one call a line: lines of threads do not mix
}

}  // namespace

void set_log_level(LogLevel level) {
  g_level.store(level, std::memory_order_relaxed);
}
LogLevel log_level() {
  return g_level.load(std::memory_order_relaxed);
}

void log_warning(std::string_view message) {
  write(LogLevel::kWarning, "warning: ", message);
}
void log_info(std::string_view message) {
  write(LogLevel::kInfo, "", message);
}
void log_verbose(std::string_view message) {
  write(LogLevel::kVerbose, "", message);
}

}  // namespace lightwell
