// Log lines: to stderr or the sink of lightwell/log.h. Results go to stdout, never here.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightwell/log.h"

namespace lightwell {

void log_warning(std::string_view message);
void log_info(std::string_view message);
void log_verbose(std::string_view message);

// While one lives, warnings of all threads are kept here instead of going to the sink. One at a time.
class WarningCapture {
 public:
  WarningCapture();
  ~WarningCapture();
  WarningCapture(const WarningCapture&) = delete;
  WarningCapture& operator=(const WarningCapture&) = delete;

  std::vector<std::string> warnings() const;
};

}  // namespace lightwell
