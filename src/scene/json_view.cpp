#include "scene/json_view.h"

#include <cmath>
#include <limits>
#include <string_view>

#include <nlohmann/json.hpp>

#include "lightwell/error.h"

namespace lightwell {

namespace {

constexpr int kMaxDepth = 64;

// Rejects deep nesting before the parser builds it.
void check_depth(const std::string& subject, std::span<const std::uint8_t> text) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::uint8_t c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMaxDepth) throw InputError(subject, "JSON is nested too deeply");
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

// The parser's message without its prefix "[json.exception...] ".
std::string short_message(const std::string& what) {
  const std::size_t end = what.find("] ");
  return "invalid JSON: " + (end == std::string::npos ? what : what.substr(end + 2)).substr(0, 160);
}

}  // namespace

JsonView::JsonView(const nlohmann::json* value, std::string where, const std::string* subject)
    : value_(value), where_(std::move(where)), subject_(subject) {}

void JsonView::fail(const std::string& cause) const {
  throw InputError(*subject_, where_.empty() ? cause : where_ + ": " + cause);
}

JsonView JsonView::operator[](const char* key) const {
  std::string where = where_.empty() ? std::string(key) : where_ + "." + key;
  if (!value_) return {nullptr, std::move(where), subject_};
  if (!value_->is_object()) fail("expected an object");
  const auto found = value_->find(key);
  return {found == value_->end() ? nullptr : &*found, std::move(where), subject_};
}

JsonView JsonView::operator[](std::size_t i) const {
  LW_ASSERT(i < size(), where_);
  return {&(*value_)[i], where_ + "[" + std::to_string(i) + "]", subject_};
}

std::size_t JsonView::size() const {
  if (!value_) return 0;
  if (!value_->is_array()) fail("expected an array");
  return value_->size();
}

int JsonView::index(std::size_t size) const {
  if (!value_) return -1;
  const std::uint64_t i = count(0);
  if (i >= size || i > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
    fail("expected an index below " + std::to_string(size) + ", got " + std::to_string(i));
  return static_cast<int>(i);
}

std::uint64_t JsonView::count(std::uint64_t fallback) const {
  if (!value_) return fallback;
  const double number = finite();
  if (number < 0 || number > 0x1p53 || number != std::floor(number)) fail("expected a non-negative integer");
  return static_cast<std::uint64_t>(number);
}

double JsonView::finite() const {
  if (!value_->is_number()) fail("expected a number");
  const double number = value_->get<double>();
  if (!std::isfinite(number) || std::abs(number) > static_cast<double>(std::numeric_limits<float>::max()))
    fail("number out of range");
  return number;
}

float JsonView::number(float fallback) const {
  return value_ ? static_cast<float>(finite()) : fallback;
}

bool JsonView::boolean(bool fallback) const {
  if (!value_) return fallback;
  if (!value_->is_boolean()) fail("expected true or false");
  return value_->get<bool>();
}

std::string JsonView::string(const std::string& fallback) const {
  if (!value_) return fallback;
  if (!value_->is_string()) fail("expected a string");
  return value_->get<std::string>();
}

void JsonView::read(std::span<float> out) const {
  if (!value_) return;
  if (size() != out.size()) fail("expected " + std::to_string(out.size()) + " numbers");
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = (*this)[i].number(0.0f);
}

std::vector<float> JsonView::numbers() const {
  std::vector<float> values(size());
  read(values);
  return values;
}

std::vector<int> JsonView::indices(std::size_t limit) const {
  std::vector<int> values(size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = (*this)[i].index(limit);
  return values;
}

JsonDocument::JsonDocument(const std::string& subject, std::span<const std::uint8_t> text) : subject_(subject) {
  check_depth(subject, text);
  try {
    json_ = std::make_unique<nlohmann::json>(nlohmann::json::parse(text.begin(), text.end()));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(subject, short_message(error.what()));
  }
}

JsonDocument::~JsonDocument() = default;

JsonView JsonDocument::root() const {
  return {json_.get(), "", &subject_};
}

}  // namespace lightwell
