#include "scene/json_document.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "lightwell/error.h"

namespace lightwell {

namespace {

constexpr std::size_t kMaxDepth = 64;

// The parser's message without its prefix "[json.exception...] ".
std::string short_message(const std::string& what) {
  const std::size_t end = what.find("] ");
  return "invalid JSON: " + (end == std::string::npos ? what : what.substr(end + 2)).substr(0, 160);
}

}  // namespace

// Hears from the parser. Values whose array or object is still open wait on a stack; when it closes they move to their
// row, all of its elements being complete.
class JsonDocument::Builder : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit Builder(JsonDocument& document) : document_(document) {}

  void finish() { document_.root_ = waiting_.front().value; }

  bool null() override { return add({}); }
  bool boolean(bool value) override { return add_number(JsonValue::Type::kBoolean, value ? 1.0 : 0.0); }
  bool number_integer(std::int64_t value) override { return add_number(static_cast<double>(value)); }
  bool number_unsigned(std::uint64_t value) override { return add_number(static_cast<double>(value)); }
  bool number_float(double value, const std::string&) override { return add_number(value); }
  bool string(std::string& text) override {
    JsonValue value;
    value.type = JsonValue::Type::kString;
    value.count = static_cast<std::uint32_t>(text.size());
    value.first = append(text);
    return add(value);
  }
  bool binary(binary_t&) override { return false; }  // no part of JSON
  bool key(std::string& text) override {
    key_size_ = static_cast<std::uint32_t>(text.size());
    key_ = append(text);
    return true;
  }
  bool start_object(std::size_t) override { return open(JsonValue::Type::kObject); }
  bool start_array(std::size_t) override { return open(JsonValue::Type::kArray); }
  bool end_array() override {
    JsonValue& array = close();
    array.first = document_.elements_.size();
    for (std::size_t i = first_waiting_; i < waiting_.size(); ++i) document_.elements_.push_back(waiting_[i].value);
    waiting_.resize(first_waiting_);
    return true;
  }
  bool end_object() override {
    JsonValue& object = close();
    object.first = document_.members_.size();
    const auto first = waiting_.begin() + static_cast<std::ptrdiff_t>(first_waiting_);
    std::stable_sort(first, waiting_.end(), [&](const JsonMember& a, const JsonMember& b) {
      return document_.key_of(a) < document_.key_of(b);
    });
    document_.members_.insert(document_.members_.end(), first, waiting_.end());
    waiting_.resize(first_waiting_);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) override {
    throw InputError(document_.subject_, short_message(error.what()));
  }

 private:
  bool add(const JsonValue& value) {
    waiting_.push_back({key_, key_size_, value});
    return true;
  }
  bool add_number(JsonValue::Type type, double number) {
    JsonValue value;
    value.type = type;
    value.number = number;
    return add(value);
  }
  bool add_number(double number) { return add_number(JsonValue::Type::kNumber, number); }
  std::size_t append(const std::string& text) {
    document_.characters_ += text;
    return document_.characters_.size() - text.size();
  }
  bool open(JsonValue::Type type) {
    if (open_.size() >= kMaxDepth) throw InputError(document_.subject_, "JSON is nested too deeply");
    open_.push_back(waiting_.size());
    JsonValue value;
    value.type = type;
    return add(value);
  }
  // Of the innermost open value, whose children wait from first_waiting_ on.
  JsonValue& close() {
    JsonValue& value = waiting_[open_.back()].value;
    first_waiting_ = open_.back() + 1;
    value.count = static_cast<std::uint32_t>(waiting_.size() - first_waiting_);
    open_.pop_back();
    return value;
  }

  JsonDocument& document_;
  std::vector<JsonMember> waiting_;
  std::vector<std::size_t> open_;  // places in waiting_
  std::size_t first_waiting_ = 0;
  std::size_t key_ = 0;  // of the value that comes next
  std::uint32_t key_size_ = 0;
};

JsonDocument::JsonDocument(const std::string& subject, std::span<const std::uint8_t> text) : subject_(subject) {
  Builder builder(*this);
  nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
  builder.finish();
}

std::string_view JsonDocument::string(const JsonValue& value) const {
  return std::string_view(characters_).substr(value.first, value.count);
}

std::string_view JsonDocument::key_of(const JsonMember& member) const {
  return std::string_view(characters_).substr(member.key, member.key_size);
}

std::span<const JsonValue> JsonDocument::elements(const JsonValue& array) const {
  return std::span(elements_).subspan(array.first, array.count);
}

std::span<const JsonMember> JsonDocument::members(const JsonValue& object) const {
  return std::span(members_).subspan(object.first, object.count);
}

const JsonValue* JsonDocument::find(const JsonValue& object, std::string_view key) const {
  const std::span<const JsonMember> row = members(object);
  const auto after = std::upper_bound(row.begin(), row.end(), key,
                                      [&](std::string_view k, const JsonMember& m) { return k < key_of(m); });
  if (after == row.begin() || key_of(*std::prev(after)) != key) return nullptr;
  return &std::prev(after)->value;
}

std::string JsonDocument::path_of(const JsonValue& value) const {
  std::string path;
  find_path(root_, value, path);
  return path;
}

bool JsonDocument::find_path(const JsonValue& from, const JsonValue& wanted, std::string& path) const {
  if (&from == &wanted) return true;
  const std::size_t length = path.size();
  if (from.type == JsonValue::Type::kArray) {
    const std::span<const JsonValue> row = elements(from);
    for (std::size_t i = 0; i < row.size(); ++i) {
      path += "[" + std::to_string(i) + "]";
      if (find_path(row[i], wanted, path)) return true;
      path.resize(length);
    }
  } else if (from.type == JsonValue::Type::kObject) {
    for (const JsonMember& member : members(from)) {
      path.append(length == 0 ? "" : ".").append(key_of(member));
      if (find_path(member.value, wanted, path)) return true;
      path.resize(length);
    }
  }
  return false;
}

}  // namespace lightwell
