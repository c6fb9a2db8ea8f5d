#include "core/log.h"

#include <atomic>
#include <cstdio>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/printable.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

// All that the library keeps for the process.
std::atomic<LogLevel> g_level{LogLevel::kWarning};
std::mutex g_mutex;                                  // of those below
LogSink g_sink;                                      // empty: stderr
std::optional<std::vector<std::string>> g_captured;  // holds a value while a WarningCapture lives

void write(LogLevel level, std::string_view message) {
  const std::lock_guard lock(g_mutex);
  if (level == LogLevel::kWarning && g_captured) {
    g_captured->emplace_back(message);
    return;
  }
  if (level > g_level.load(std::memory_order_relaxed)) return;
  const std::string text = printable(message);
  if (g_sink) return g_sink(level, text);
  std::string line = level == LogLevel::kWarning ? "lightwell: warning: " : "lightwell: ";
  line.append(text).push_back('\n');
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace

void set_log_level(LogLevel level) {
  g_level.store(level, std::memory_order_relaxed);
}
LogLevel log_level() {
  return g_level.load(std::memory_order_relaxed);
}

void set_log_sink(LogSink sink) {
  const std::lock_guard lock(g_mutex);
  g_sink = std::move(sink);
}

void log_warning(std::string_view message) {
  write(LogLevel::kWarning, message);
}
void log_info(std::string_view message) {
  write(LogLevel::kInfo, message);
}
void log_verbose(std::string_view message) {
  write(LogLevel::kVerbose, message);
}

WarningCapture::WarningCapture() {
  const std::lock_guard lock(g_mutex);
  LW_ASSERT(!g_captured, std::string("warnings are captured already"));
  g_captured.emplace();
}

WarningCapture::~WarningCapture() {
  const std::lock_guard lock(g_mutex);
  g_captured.reset();
}

std::vector<std::string> WarningCapture::warnings() const {
  const std::lock_guard lock(g_mutex);
  return *g_captured;
}

}  // namespace lightwell
