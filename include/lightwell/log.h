// The log: warnings about files and devices, and what is being done. It is the process's, not a device's: set it once,
// before the threads that use Lightwell start or from any of them.
#pragma once

#include <functional>
#include <string_view>

namespace lightwell {

enum class LogLevel { kQuiet, kWarning, kInfo, kVerbose };

// Lines of a level up to this one are logged: kWarning at first.
void set_log_level(LogLevel level);
LogLevel log_level();

// Where the lines go instead of stderr, each without prefix, newline or other control characters; called by one thread
// at a time. It must neither log nor set a sink. Empty: stderr again, as "lightwell: warning: ...".
using LogSink = std::function<void(LogLevel level, std::string_view message)>;
void set_log_sink(LogSink sink);

}  // namespace lightwell
