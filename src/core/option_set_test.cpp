#include "core/option_set.h"

#include <array>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "lightwell/error.h"

namespace lightwell {
namespace {

struct Sample {
  int steps = 8;
  float decay = 0.1f;
  bool shadows = true;
  int filter = 1;

  void describe(OptionVisitor& visitor) {
    static constexpr std::array<std::string_view, 3> kFilters = {"none", "box", "gauss"};
    visitor.visit({"steps", "Propagation steps.", "", "time, linearly"}, steps, 1, 64);
    visitor.visit({"decay", "Light lost per metre.", "1/m", ""}, decay, 0.0f, 2.5f);
    visitor.visit({"shadows", "Traces shadow rays.", "", "a ray a pixel"}, shadows);
    visitor.visit({"filter", "Kernel of the last pass.", "", ""}, filter, std::span<const std::string_view>(kFilters));
  }
  DescribeOptions visitable() {
    return [this](OptionVisitor& visitor) { describe(visitor); };
  }
};

std::string error_of(Sample& sample, const std::string& assignment) {
  try {
    set_option(sample.visitable(), assignment);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(OptionSet, SetsEveryType) {
  Sample sample;
  set_option(sample.visitable(), "steps=64");
  set_option(sample.visitable(), "decay", "1e-3");
  set_option(sample.visitable(), "shadows=off");
  set_option(sample.visitable(), "filter=gauss");
  EXPECT_EQ(sample.steps, 64);
  EXPECT_EQ(sample.decay, 1e-3f);
  EXPECT_FALSE(sample.shadows);
  EXPECT_EQ(sample.filter, 2);
}

TEST(OptionSet, ErrorsNameOptionValueAndRange) {
  Sample sample;
  EXPECT_EQ(error_of(sample, "steps=65"), "--steps: '65' is not a whole number, 1 to 64");
  EXPECT_EQ(error_of(sample, "steps=1.5"), "--steps: '1.5' is not a whole number, 1 to 64");
  EXPECT_EQ(error_of(sample, "steps="), "--steps: '' is not a whole number, 1 to 64");
  EXPECT_EQ(error_of(sample, "steps=99999999999999999999"),
            "--steps: '99999999999999999999' is not a whole number, 1 to 64");
  EXPECT_EQ(error_of(sample, "decay=nan"), "--decay: 'nan' is not a number, 0 to 2.5 1/m");
  EXPECT_EQ(error_of(sample, "shadows=maybe"), "--shadows: 'maybe' is not on or off");
  EXPECT_EQ(error_of(sample, "filter=bilinear"), "--filter: 'bilinear' is not one of none, box, gauss");
  EXPECT_EQ(error_of(sample, "stepps=2"), "--stepps: unknown option; known: --steps, --decay, --shadows, --filter");
  EXPECT_EQ(error_of(sample, "steps"), "--set: 'steps' is not name=value");
  EXPECT_EQ(sample.steps, 8);
}

TEST(OptionSet, ListsAsJson) {
  Sample sample;
  const nlohmann::json list = nlohmann::json::parse(options_as_json(sample.visitable()));
  ASSERT_EQ(list.size(), 4u);
  EXPECT_EQ(list[0]["default"], 8);
  EXPECT_EQ(list[0]["maximum"], 64);
  EXPECT_EQ(list[0]["cost"], "time, linearly");
  EXPECT_EQ(list[1]["default"].dump(), "0.1");
  EXPECT_EQ(list[1]["unit"], "1/m");
  EXPECT_EQ(list[2]["default"], true);
  EXPECT_EQ(list[3]["choices"], nlohmann::json({"none", "box", "gauss"}));
}

TEST(OptionSet, ListsForPeople) {
  Sample sample;
  EXPECT_NE(options_as_markdown(sample.visitable())
                .find("| `--decay` | 0.1 | 0 to 2.5 1/m | Light lost per metre. | nothing |"),
            std::string::npos);
  EXPECT_NE(options_as_help(sample.visitable())
                .find("  --steps    Propagation steps. (1 to 64; default 8); costs time, linearly\n"),
            std::string::npos);
}

}  // namespace
}  // namespace lightwell
