// Options described once: command line, JSON, manual tables and viewer widgets are all generated from describe().
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

// What an option decides: views whose options for the world are equal share what a technique keeps of the world.
enum class OptionScope { kView, kWorld };

struct OptionInfo {
  std::string_view name;  // as on the command line, lower case with dashes
  std::string_view help;  // one sentence
  std::string_view unit;  // "" if none
  std::string_view cost;  // what raising it costs; "" if nothing
  OptionScope scope = OptionScope::kView;
};

// Visits every option of a struct. The value passed in at the first visit is the default.
class OptionVisitor {
 public:
  virtual ~OptionVisitor() = default;
  virtual void visit(const OptionInfo& info, int& value, int minimum, int maximum) = 0;
  virtual void visit(const OptionInfo& info, float& value, float minimum, float maximum) = 0;
  virtual void visit(const OptionInfo& info, bool& value) = 0;
  // `value` indexes `choices`.
  virtual void visit(const OptionInfo& info, int& value, std::span<const std::string_view> choices) = 0;
};

}  // namespace lightwell
