// Log lines on stderr: "lightwell: warning: ...". Results go to stdout, never here.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

enum class LogLevel { kQuiet, kWarning, kInfo, kVerbose };

// Process-wide threshold, kWarning at start. Log settings are the only process-wide ones that the library has.
void set_log_level(LogLevel level);
LogLevel log_level();

void log_warning(std::string_view message);
void log_info(std::string_view message);
void log_verbose(std::string_view message);

// While one lives, warnings of all threads are kept here instead of going to stderr. One at a time.
class WarningCapture {
 public:
  WarningCapture();
  ~WarningCapture();
  WarningCapture(const WarningCapture&) = delete;
  WarningCapture& operator=(const WarningCapture&) = delete;

  std::vector<std::string> warnings() const;
};

}  // namespace lightwell
