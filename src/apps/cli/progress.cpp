#include "apps/cli/progress.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <string_view>

#include "core/log.h"

namespace lightwell {

namespace {

constexpr std::chrono::milliseconds kBarInterval{100};
constexpr std::chrono::seconds kLineInterval{5};
constexpr int kBarWidth = 40;

std::atomic<bool> g_bar_shown{false};  // there is one terminal

}  // namespace

Progress::Progress(std::string what)
    : what_(std::move(what)), quiet_(log_level() == LogLevel::kQuiet), terminal_(::isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  erase_bar();
}

void Progress::erase_bar() noexcept {
  constexpr std::string_view kErase = "\r\x1b[K";
  if (!g_bar_shown.exchange(false)) return;
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, kErase.data(), kErase.size());
}

void Progress::update(float done) {
  const Clock::time_point now = Clock::now();
  const Clock::duration interval = terminal_ ? Clock::duration(kBarInterval) : Clock::duration(kLineInterval);
  if (quiet_ || now - last_ < interval) return;
  last_ = now;
  const double part = std::clamp(static_cast<double>(done), 1e-6, 1.0);
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double left = elapsed * (1.0 - part) / part;
  if (terminal_) {
    g_bar_shown = true;
    const std::string bar(static_cast<std::size_t>(part * kBarWidth), '#');
    std::fprintf(stderr, "\r%s [%-*s] %3.0f %%, %.0f s left\x1b[K", what_.c_str(), kBarWidth, bar.c_str(), 100 * part,
                 left);
  } else {
    std::fprintf(stderr, "lightwell: %s: %.0f %%, %.0f s left\n", what_.c_str(), 100 * part, left);
  }
}

}  // namespace lightwell
