// Log lines on stderr: "lightwell: warning: ...". Results go to stdout, never here.
#pragma once

#include <string_view>

namespace lightwell {

enum class LogLevel { kQuiet, kWarning, kInfo, kVerbose };

// Process-wide threshold, kWarning at start. The only process-wide setting the library has.
void set_log_level(LogLevel level);
LogLevel log_level();

void log_warning(std::string_view message);
void log_info(std::string_view message);
void log_verbose(std::string_view message);

}  // namespace lightwell
