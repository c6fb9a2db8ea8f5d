#include "core/log.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace lightwell {
namespace {

class LogTest : public ::testing::Test {
 protected:
  void SetUp() override {
    set_log_sink([this](LogLevel level, std::string_view message) { lines_.emplace_back(level, message); });
  }
  void TearDown() override {
    set_log_sink({});
    set_log_level(LogLevel::kWarning);
  }

  std::vector<std::pair<LogLevel, std::string>> lines_;
};

TEST_F(LogTest, ASinkGetsTheLinesThatTheLevelLetsThrough) {
  log_warning("careful");
  log_info("not asked for");
  set_log_level(LogLevel::kVerbose);
  log_info("done");
  log_verbose("in detail");
  set_log_level(LogLevel::kQuiet);
  log_warning("not heard");
  const std::vector<std::pair<LogLevel, std::string>> expected = {
      {LogLevel::kWarning, "careful"}, {LogLevel::kInfo, "done"}, {LogLevel::kVerbose, "in detail"}};
  EXPECT_EQ(lines_, expected);
}

TEST_F(LogTest, ASinkGetsOneLineWhateverAFileIsCalled) {
  log_warning("a\n\x1b[31m.png");
  ASSERT_EQ(lines_.size(), 1u);
  EXPECT_EQ(lines_[0].second, "a\\n\\x1b[31m.png");
}

TEST_F(LogTest, WithoutASinkLinesGoToStderr) {
  set_log_sink({});
  ::testing::internal::CaptureStderr();
  log_warning("careful");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "lightwell: warning: careful\n");
}

TEST_F(LogTest, CapturedWarningsReachNoSinkHoweverQuiet) {
  set_log_level(LogLevel::kQuiet);
  const WarningCapture capture;
  log_warning("careful");
  EXPECT_EQ(capture.warnings(), std::vector<std::string>{"careful"});
  EXPECT_TRUE(lines_.empty());
}

}  // namespace
}  // namespace lightwell
