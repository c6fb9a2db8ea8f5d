// A JSON text in memory, in little more space than the text itself: an array's elements and an object's members lie in
// one row each, and all characters in one string.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

struct JsonValue {
  enum class Type : std::uint8_t { kNull, kBoolean, kNumber, kString, kArray, kObject };

  Type type = Type::kNull;
  std::uint32_t count = 0;  // of a string's characters, an array's elements, an object's members
  union {
    double number = 0.0;  // kBoolean: 0 or 1
    std::size_t first;    // of a string, an array or an object: where the row begins
  };
};

struct JsonMember {
  std::size_t key;  // a string's first character
  std::uint32_t key_size;
  JsonValue value;
};

class JsonDocument {
 public:
  // Throws InputError if `text` is not JSON or is nested deeper than any scene needs.
  JsonDocument(const std::string& subject, std::span<const std::uint8_t> text);

  const std::string& subject() const { return subject_; }
  const JsonValue& root() const { return root_; }

  std::string_view string(const JsonValue& value) const;
  std::span<const JsonValue> elements(const JsonValue& array) const;
  std::string_view key_of(const JsonMember& member) const;
  // By name; of one name all that there are.
  std::span<const JsonMember> members(const JsonValue& object) const;
  // The last one of that name; null if there is none.
  const JsonValue* find(const JsonValue& object, std::string_view key) const;

  // Where a value of this document stands, "nodes[3].mesh". Slow: for messages.
  std::string path_of(const JsonValue& value) const;

 private:
  class Builder;

  bool find_path(const JsonValue& from, const JsonValue& wanted, std::string& path) const;

  std::string subject_;
  JsonValue root_;
  std::string characters_;
  std::vector<JsonValue> elements_;
  std::vector<JsonMember> members_;  // of each object by name
};

}  // namespace lightwell
