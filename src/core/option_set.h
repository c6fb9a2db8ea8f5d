// What is generated from describe(): setting an option from text, and its lists for people and programs.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "lightwell/options.h"

namespace lightwell {

// Visits all options of one struct: [&](OptionVisitor& visitor) { technique.describe(visitor); }
using DescribeOptions = std::function<void(OptionVisitor&)>;

// One option as text. `range` is "8 to 256", "on or off", or the choices "one, two, three".
struct OptionText {
  std::string name, help, unit, cost;
  std::string type;   // int, float, bool, choice
  std::string value;  // as it is now: the default, if nothing was set yet
  std::string range;
};

std::vector<OptionText> list_options(const DescribeOptions& describe);

// Sets one option. Throws InputError naming the option, the bad value and the range, or the known names.
void set_option(const DescribeOptions& describe, std::string_view name, std::string_view value);

// The same for "name=value", the argument of --set.
void set_option(const DescribeOptions& describe, std::string_view assignment);

// JSON array of {name, type, default, minimum and maximum or choices, unit, help, cost}.
std::string options_as_json(const DescribeOptions& describe);

// Markdown table for the manual pages.
std::string options_as_markdown(const DescribeOptions& describe);

// Indented lines for --help.
std::string options_as_help(const DescribeOptions& describe);

}  // namespace lightwell
