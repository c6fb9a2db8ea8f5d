#include "core/printable.h"

#include <gtest/gtest.h>

#include "core/log.h"
#include "lightwell/error.h"

namespace lightwell {
namespace {

TEST(Printable, KeepsTextAndEscapesTheRest) {
  EXPECT_EQ(printable("K\u00fcche \u2013 \U0001f4a1 \\ \"x\""), "K\u00fcche \u2013 \U0001f4a1 \\ \"x\"");
  EXPECT_EQ(printable("a\nb\r\tc"), "a\\nb\\r\\tc");
  EXPECT_EQ(printable("\x1b[2J\x7f"), "\\x1b[2J\\x7f");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m");                                                 // a C1 control, which terminals obey
  EXPECT_EQ(printable("\xff\xe4"), "\\xff\\xe4");                             // Latin-1
  EXPECT_EQ(printable("\xc0\x8a\xe0\x80\x8a"), "\\xc0\\x8a\\xe0\\x80\\x8a");  // line breaks in disguise
  EXPECT_EQ(printable("\xe2\x80"), "\\xe2\\x80");                             // cut off
}

TEST(Printable, ErrorsAndWarningsAreOneLine) {
  const InputError error("a\x1b[31m\n.gltf", "two\nlines\x07");
  EXPECT_STREQ(error.what(), "a\\x1b[31m\\n.gltf: two lines\\x07");
  testing::internal::CaptureStderr();
  log_warning("b\n\x1b[31m.png: texture not found");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "lightwell: warning: b\\n\\x1b[31m.png: texture not found\n");
}

}  // namespace
}  // namespace lightwell
