#include "core/log.h"

#include <atomic>
#include <cstdio>
#include <mutex>
#include <optional>
#include <string>

#include "core/printable.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

std::atomic<LogLevel> g_level{LogLevel::kWarning};
std::mutex g_capture_mutex;
std::optional<std::vector<std::string>> g_captured;  // holds a value while a WarningCapture lives

bool capture(std::string_view message) {
  const std::lock_guard lock(g_capture_mutex);
  if (!g_captured) return false;
  g_captured->emplace_back(message);
  return true;
}

void write(LogLevel level, std::string_view prefix, std::string_view message) {
  if (level > g_level.load(std::memory_order_relaxed)) return;
  std::string line = "lightwell: ";
  line.append(prefix).append(printable(message)).push_back('\n');
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
  if (!capture(message)) write(LogLevel::kWarning, "warning: ", message);
}
void log_info(std::string_view message) {
  write(LogLevel::kInfo, "", message);
}
void log_verbose(std::string_view message) {
  write(LogLevel::kVerbose, "", message);
}

WarningCapture::WarningCapture() {
  const std::lock_guard lock(g_capture_mutex);
  LW_ASSERT(!g_captured, std::string("warnings are captured already"));
  g_captured.emplace();
}

WarningCapture::~WarningCapture() {
  const std::lock_guard lock(g_capture_mutex);
  g_captured.reset();
}

std::vector<std::string> WarningCapture::warnings() const {
  const std::lock_guard lock(g_capture_mutex);
  return *g_captured;
}

}  // namespace lightwell
