#include "scene/json_document.h"

#include <gtest/gtest.h>

#include "lightwell/error.h"
#include "scene/json_view.h"

namespace lightwell {
namespace {

JsonDocument parse(std::string_view text) {
  return JsonDocument("a.json", {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

TEST(JsonDocument, HoldsEveryKindOfValue) {
  const JsonDocument document = parse(
      R"({"n":-1.5,"i":9007199254740992,"yes":true,"no":false,"nil":null,"s":"a\u00e9\n","a":[1,[2,3],{"b":[]}],"":7})");
  const JsonView root(document);
  EXPECT_EQ(root["n"].number(0.0f), -1.5f);
  EXPECT_EQ(root["i"].count(0), std::uint64_t{1} << 53);
  EXPECT_TRUE(root["yes"].boolean(false));
  EXPECT_FALSE(root["no"].boolean(true));
  EXPECT_FALSE(root["nil"].present());
  EXPECT_EQ(root["s"].string(""), "a\u00e9\n");
  EXPECT_EQ(root["a"].size(), 3u);
  EXPECT_EQ(root["a"][1][1].number(0.0f), 3.0f);
  EXPECT_EQ(root["a"][2]["b"].size(), 0u);
  EXPECT_EQ(root[""].number(0.0f), 7.0f);
  EXPECT_FALSE(root["b"]["c"].present());
}

TEST(JsonDocument, TheLastOfSeveralMembersCounts) {
  const JsonDocument document = parse(R"({"b":1,"a":2,"b":3,"c":4,"b":5})");
  EXPECT_EQ(JsonView(document)["b"].number(0.0f), 5.0f);
  EXPECT_EQ(JsonView(document)["a"].number(0.0f), 2.0f);
}

std::string error_of(const JsonView& view) {
  try {
    view.fail("x");
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(JsonDocument, ErrorsNameThePlace) {
  const JsonDocument document = parse(R"({"nodes":[{},{"mesh":{"x":[0,1]}}]})");
  const JsonView root(document);
  EXPECT_EQ(error_of(root), "a.json: x");
  EXPECT_EQ(error_of(root["nodes"][1]["mesh"]["x"][1]), "a.json: nodes[1].mesh.x[1]: x");
  EXPECT_EQ(error_of(root["nodes"][std::size_t{0}]["skin"]["joints"]), "a.json: nodes[0].skin.joints: x");
  EXPECT_EQ(error_of(root["none"]), "a.json: none: x");
}

TEST(JsonDocument, DeepNestingIsRefused) {
  EXPECT_NO_THROW(parse(std::string(64, '[') + std::string(64, ']')));
  EXPECT_THROW(parse(std::string(65, '[') + std::string(65, ']')), InputError);
}

}  // namespace
}  // namespace lightwell
