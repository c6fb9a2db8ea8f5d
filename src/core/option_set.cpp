#include "core/option_set.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

#include "lightwell/error.h"

namespace lightwell {

namespace {

using Choices = std::span<const std::string_view>;

// The shortest text that reads back as the same number.
template <typename Number>
std::string text_of(Number value) {
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

template <typename Number>
std::string range_of(Number minimum, Number maximum) {
  return text_of(minimum) + " to " + text_of(maximum);
}

std::string range_of(Choices choices) {
  std::string text;
  for (const std::string_view choice : choices) text.append(text.empty() ? "" : ", ").append(choice);
  return text;
}

constexpr const char* kBoolRange = "on or off";

std::string_view choice_name(int value, Choices choices) {
  LW_ASSERT(value >= 0 && static_cast<std::size_t>(value) < choices.size(), std::to_string(value));
  return choices[static_cast<std::size_t>(value)];
}

template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<bool> parse_bool(std::string_view text) {
  for (const std::string_view yes : {"on", "true", "yes", "1"})
    if (text == yes) return true;
  for (const std::string_view no : {"off", "false", "no", "0"})
    if (text == no) return false;
  return std::nullopt;
}

// Sets the one option that has the name.
class Setter : public OptionVisitor {
 public:
  Setter(std::string_view name, std::string_view text) : name_(name), text_(text) {}

  void visit(const OptionInfo& info, int& value, int minimum, int maximum) override {
    set_number(info, value, minimum, maximum);
  }
  void visit(const OptionInfo& info, float& value, float minimum, float maximum) override {
    set_number(info, value, minimum, maximum);
  }
  void visit(const OptionInfo& info, bool& value) override {
    if (!is_mine(info)) return;
    const std::optional<bool> parsed = parse_bool(text_);
    if (!parsed) refuse(kBoolRange);
    value = *parsed;
  }
  void visit(const OptionInfo& info, int& value, Choices choices) override {
    if (!is_mine(info)) return;
    const auto found = std::find(choices.begin(), choices.end(), text_);
    if (found == choices.end()) refuse("one of " + range_of(choices));
    value = static_cast<int>(found - choices.begin());
  }

  void require_found() const {
    if (found_) return;
    throw InputError(flag(),
                     known_.empty() ? "unknown option; there are none here" : "unknown option; known: " + known_);
  }

 private:
  template <typename Number>
  void set_number(const OptionInfo& info, Number& value, Number minimum, Number maximum) {
    if (!is_mine(info)) return;
    const std::optional<Number> parsed = parse_number<Number>(text_);
    // Written so that NaN is refused.
    if (!parsed || !(*parsed >= minimum && *parsed <= maximum)) {
      std::string wanted = std::is_integral_v<Number> ? "a whole number, " : "a number, ";
      wanted += range_of(minimum, maximum);
      if (!info.unit.empty()) wanted.append(" ").append(info.unit);
      refuse(wanted);
    }
    value = *parsed;
  }

  bool is_mine(const OptionInfo& info) {
    known_.append(known_.empty() ? "--" : ", --").append(info.name);
    found_ = found_ || info.name == name_;
    return info.name == name_;
  }

  [[noreturn]] void refuse(const std::string& wanted) const {
    throw InputError(flag(), "'" + std::string(text_) + "' is not " + wanted);
  }

  std::string flag() const { return std::string("--").append(name_); }

  std::string_view name_, text_;
  bool found_ = false;
  std::string known_;
};

class Lister : public OptionVisitor {
 public:
  std::vector<OptionText> options;

  void visit(const OptionInfo& info, int& value, int minimum, int maximum) override {
    add(info, "int", text_of(value), range_of(minimum, maximum));
  }
  void visit(const OptionInfo& info, float& value, float minimum, float maximum) override {
    add(info, "float", text_of(value), range_of(minimum, maximum));
  }
  void visit(const OptionInfo& info, bool& value) override { add(info, "bool", value ? "on" : "off", kBoolRange); }
  void visit(const OptionInfo& info, int& value, Choices choices) override {
    add(info, "choice", std::string(choice_name(value, choices)), range_of(choices));
  }

 private:
  void add(const OptionInfo& info, const char* type, const std::string& value, const std::string& range) {
    options.push_back({std::string(info.name), std::string(info.help), std::string(info.unit), std::string(info.cost),
                       type, value, range});
  }
};

class JsonLister : public OptionVisitor {
 public:
  nlohmann::ordered_json options = nlohmann::ordered_json::array();

  void visit(const OptionInfo& info, int& value, int minimum, int maximum) override {
    add(info, "int", value, {{"minimum", minimum}, {"maximum", maximum}});
  }
  void visit(const OptionInfo& info, float& value, float minimum, float maximum) override {
    // Through text: 0.1f is 0.1, not 0.10000000149.
    const auto number = [](float x) { return nlohmann::ordered_json::parse(text_of(x)); };
    add(info, "float", number(value), {{"minimum", number(minimum)}, {"maximum", number(maximum)}});
  }
  void visit(const OptionInfo& info, bool& value) override {
    add(info, "bool", value, nlohmann::ordered_json::object());
  }
  void visit(const OptionInfo& info, int& value, Choices choices) override {
    add(info, "choice", choice_name(value, choices), {{"choices", choices}});
  }

 private:
  void add(const OptionInfo& info, const char* type, const nlohmann::ordered_json& value,
           const nlohmann::ordered_json& range) {
    nlohmann::ordered_json option = {{"name", info.name}, {"type", type}, {"default", value}};
    option.update(range);
    option["unit"] = info.unit;
    option["help"] = info.help;
    option["cost"] = info.cost;
    options.push_back(option);
  }
};

std::string range_with_unit(const OptionText& option) {
  return option.unit.empty() ? option.range : option.range + " " + option.unit;
}

}  // namespace

std::vector<OptionText> list_options(const DescribeOptions& describe) {
  Lister lister;
  describe(lister);
  return std::move(lister.options);
}

void set_option(const DescribeOptions& describe, std::string_view name, std::string_view value) {
  Setter setter(name, value);
  describe(setter);
  setter.require_found();
}

void set_option(const DescribeOptions& describe, std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0)
    throw InputError("--set", std::string("'").append(assignment) + "' is not name=value");
  set_option(describe, assignment.substr(0, equals), assignment.substr(equals + 1));
}

std::string options_as_json(const DescribeOptions& describe) {
  JsonLister lister;
  describe(lister);
  return lister.options.dump(2);
}

std::string options_as_markdown(const DescribeOptions& describe) {
  std::string table = "| option | default | range | meaning | raising it costs |\n|---|---|---|---|---|\n";
  for (const OptionText& option : list_options(describe))
    table += "| `--" + option.name + "` | " + option.value + " | " + range_with_unit(option) + " | " + option.help +
             " | " + (option.cost.empty() ? "nothing" : option.cost) + " |\n";
  return table;
}

std::string options_as_help(const DescribeOptions& describe) {
  const std::vector<OptionText> options = list_options(describe);
  std::size_t width = 0;
  for (const OptionText& option : options) width = std::max(width, option.name.size());
  std::string help;
  for (const OptionText& option : options) {
    help += "  --" + option.name + std::string(width - option.name.size() + 2, ' ') + option.help + " (" +
            range_with_unit(option) + "; default " + option.value + ")";
    help += option.cost.empty() ? "\n" : "; costs " + option.cost + "\n";
  }
  return help;
}

}  // namespace lightwell
