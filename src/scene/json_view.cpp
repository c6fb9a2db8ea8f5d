#include "scene/json_view.h"

#include <cmath>
#include <limits>

#include "lightwell/error.h"

namespace lightwell {

std::string JsonView::place() const {
  std::string where = document_->path_of(*nearest_) + missing_;
  if (where.starts_with('.')) where.erase(0, 1);
  return where;
}

void JsonView::fail(const std::string& cause) const {
  const std::string where = place();
  throw InputError(document_->subject(), where.empty() ? cause : where + ": " + cause);
}

JsonView JsonView::operator[](const char* key) const {
  if (value_ && !is(JsonValue::Type::kObject)) fail("expected an object");
  const JsonValue* found = value_ ? document_->find(*value_, key) : nullptr;
  if (found && found->type != JsonValue::Type::kNull) return {document_, found};
  JsonView absent = *this;
  absent.value_ = nullptr;
  absent.missing_.append(".").append(key);
  return absent;
}

JsonView JsonView::operator[](std::size_t i) const {
  LW_ASSERT(i < size(), std::to_string(i));
  return {document_, &document_->elements(*value_)[i]};
}

std::size_t JsonView::member_count() const {
  if (!value_) return 0;
  if (!is(JsonValue::Type::kObject)) fail("expected an object");
  return value_->count;
}

std::string JsonView::member_name(std::size_t i) const {
  LW_ASSERT(i < member_count(), std::to_string(i));
  return std::string(document_->key_of(document_->members(*value_)[i]));
}

std::size_t JsonView::size() const {
  if (!value_) return 0;
  if (!is(JsonValue::Type::kArray)) fail("expected an array");
  return value_->count;
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

bool JsonView::is_finite_number() const {
  return value_ && is(JsonValue::Type::kNumber) && std::isfinite(value_->number) &&
         std::abs(value_->number) <= static_cast<double>(std::numeric_limits<float>::max());
}

double JsonView::finite() const {
  if (!is(JsonValue::Type::kNumber)) fail("expected a number");
  if (!is_finite_number()) fail("number out of range");
  return value_->number;
}

float JsonView::number(float fallback) const {
  return value_ ? static_cast<float>(finite()) : fallback;
}

bool JsonView::boolean(bool fallback) const {
  if (!value_) return fallback;
  if (!is(JsonValue::Type::kBoolean)) fail("expected true or false");
  return value_->number != 0.0;
}

std::string JsonView::string(const std::string& fallback) const {
  if (!value_) return fallback;
  if (!is(JsonValue::Type::kString)) fail("expected a string");
  return std::string(document_->string(*value_));
}

void JsonView::read(std::span<float> out) const {
  if (!value_) return;
  if (size() != out.size()) fail("expected " + std::to_string(out.size()) + " numbers");
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = (*this)[i].number(0.0f);
}

bool JsonView::holds_finite(std::size_t count) const {
  if (!value_ || !is(JsonValue::Type::kArray) || size() != count) return false;
  for (std::size_t i = 0; i < count; ++i)
    if (!(*this)[i].is_finite_number()) return false;
  return true;
}

bool JsonView::read_if_finite(std::span<float> out) const {
  if (!holds_finite(out.size())) return false;
  read(out);
  return true;
}

bool JsonView::read_if_finite(std::span<double> out) const {
  if (!holds_finite(out.size())) return false;
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = (*this)[i].value_->number;
  return true;
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

}  // namespace lightwell
