// How far long work has come, on stderr: a bar on a terminal, a plain line every few seconds in a log.
#pragma once

#include <chrono>
#include <string>

namespace lightwell {

class Progress {
 public:
  // `what` is being done, "path-tracer". Says nothing if the log is quiet.
  explicit Progress(std::string what);
  ~Progress();  // removes the bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // `done` in [0,1]. From any thread, one call at a time.
  void update(float done);

  // Removes the bar, if one is on the terminal. May be called at any moment, by signal handlers too.
  static void erase_bar() noexcept;

 private:
  using Clock = std::chrono::steady_clock;

  std::string what_;
  bool quiet_;
  bool terminal_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace lightwell
