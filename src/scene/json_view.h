// Reading JSON that nobody has checked: every access names the place in the file that it complains about.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/json_document.h"

namespace lightwell {

// A value in a JSON document, or its absence. Reading an absent value gives the fallback; a value of the wrong type is
// an InputError such as "room.gltf: nodes[3].mesh: expected an index below 2". Valid as long as the document.
class JsonView {
 public:
  explicit JsonView(const JsonDocument& document) : document_(&document), value_(&document.root()), nearest_(value_) {}

  bool present() const { return value_ != nullptr; }
  [[noreturn]] void fail(const std::string& cause) const;
  // Where in the document this is, "nodes[3].mesh". Slow: for messages.
  std::string place() const;

  // Member of an object; absent if there is none, it is null, or this value is absent.
  JsonView operator[](const char* key) const;
  // Element of an array; i < size().
  JsonView operator[](std::size_t i) const;
  // Members of an object, by name; 0 if absent.
  std::size_t member_count() const;
  std::string member_name(std::size_t i) const;
  // Length of an array; 0 if absent.
  std::size_t size() const;

  bool is_string() const { return value_ && is(JsonValue::Type::kString); }
  bool is_finite_number() const;

  // An index into an array of `size`; -1 if absent.
  int index(std::size_t size) const;
  // A non-negative integer up to 2^53.
  std::uint64_t count(std::uint64_t fallback) const;
  float number(float fallback) const;
  bool boolean(bool fallback) const;
  std::string string(const std::string& fallback) const;

  // Fills `out` from an array of exactly that length; leaves it alone if absent.
  void read(std::span<float> out) const;
  // The same for numbers that may be damaged: false, and `out` left alone, unless all are there and finite.
  bool read_if_finite(std::span<float> out) const;
  bool read_if_finite(std::span<double> out) const;
  std::vector<float> numbers() const;
  std::vector<int> indices(std::size_t size) const;

 private:
  JsonView(const JsonDocument* document, const JsonValue* value)
      : document_(document), value_(value), nearest_(value) {}

  bool holds_finite(std::size_t count) const;
  bool is(JsonValue::Type type) const { return value_->type == type; }
  double finite() const;

  const JsonDocument* document_;
  const JsonValue* value_;    // null: absent
  const JsonValue* nearest_;  // the value, or the last one on the way to it that is there
  std::string missing_;       // the way from there on, ".pbrMetallicRoughness.baseColorFactor"
};

}  // namespace lightwell
