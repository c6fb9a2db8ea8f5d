// The walk through a document that holds it against the table.
#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "scene/gltf_properties.h"

namespace lightwell {

namespace {

// The table as a tree of names.
struct Schema {
  std::map<std::string, Schema, std::less<>> members;
  const GltfProperty* property = nullptr;  // null: only a way to others
};

Schema make_schema() {
  Schema root;
  for (const GltfProperty& property : gltf_properties()) {
    Schema* at = &root;
    std::string_view path = property.path;
    while (!path.empty()) {
      const std::size_t dot = std::min(path.find('.'), path.size());
      at = &at->members[std::string(path.substr(0, dot))];
      path.remove_prefix(std::min(dot + 1, path.size()));
    }
    at->property = &property;
  }
  return root;
}

const Schema& schema() {
  static const Schema made = make_schema();
  return made;
}

const Schema* find(const Schema& in, std::string_view key) {
  const auto found = in.members.find(key);
  return found == in.members.end() ? nullptr : &found->second;
}

// A name with a number at its end also answers to that of all numbers.
const Schema* find_member(const Schema& in, std::string_view key) {
  if (const Schema* exact = find(in, key)) return exact;
  const std::size_t last = key.find_last_not_of("0123456789");
  if (last != std::string_view::npos && last + 1 < key.size())
    if (const Schema* any_number = find(in, std::string(key.substr(0, last + 1)) + "n")) return any_number;
  return find(*find(schema(), "any"), key);
}

bool is_neutral(const JsonDocument& document, const JsonValue& value, std::string_view neutral) {
  if (neutral.empty()) return false;
  switch (value.type) {
    case JsonValue::Type::kNumber:
      return value.number == std::atof(std::string(neutral).c_str());
    case JsonValue::Type::kBoolean:
      return value.number == (neutral == "true" ? 1.0 : 0.0);
    case JsonValue::Type::kString:
      return neutral.starts_with('!') && document.string(value) != neutral.substr(1);
    default:
      return false;
  }
}

std::string shortened(std::string_view text) {
  constexpr std::size_t kMost = 80;
  return std::string(text.substr(0, kMost)) + (text.size() > kMost ? "..." : "");
}

class Walk {
 public:
  Walk(const JsonDocument& document, FileNotes& notes) : document_(document), notes_(notes) {}

  void visit(const JsonValue& value, const Schema& as);
  void note_declared_extensions();

 private:
  void visit_member(std::string_view key, const JsonValue& value, const Schema& in);
  void visit_extensions(const JsonValue& value, const Schema* as);
  void note(const std::string& what) {
    notes_.add([&] { return place(); }, what);
  }
  void note_extension(std::string_view name);
  std::string place() const;

  // A step of the way from the root: a name, or an element's number.
  struct Step {
    std::string_view key;
    std::size_t element = 0;
  };

  const JsonDocument& document_;
  FileNotes& notes_;
  std::vector<Step> way_;
  std::set<std::string, std::less<>> extensions_met_;
};

std::string Walk::place() const {
  std::string text;
  for (const Step& step : way_) {
    if (step.key.data() == nullptr)
      text.append("[").append(std::to_string(step.element)).append("]");
    else
      text.append(text.empty() ? "" : ".").append(shortened(step.key));
  }
  return text;
}

void Walk::visit(const JsonValue& value, const Schema& as) {
  // Where the table knows no members, what is inside is a matter of numbers.
  if (as.members.empty()) return;
  if (value.type == JsonValue::Type::kArray) {
    const std::span<const JsonValue> elements = document_.elements(value);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      way_.push_back({{}, i});
      visit(elements[i], as);
      way_.pop_back();
    }
  } else if (value.type == JsonValue::Type::kObject) {
    for (const JsonMember& member : document_.members(value)) {
      way_.push_back({document_.key_of(member)});
      visit_member(way_.back().key, member.value, as);
      way_.pop_back();
    }
  }
}

void Walk::visit_member(std::string_view key, const JsonValue& value, const Schema& in) {
  const Schema* member = find_member(in, key);
  if (key == "extensions") return visit_extensions(value, find(in, key));
  if (member == nullptr) {
    if (!key.starts_with('_')) note(shortened(key) + " is no property that is known: ignored");
    return;
  }
  if (value.type == JsonValue::Type::kNull) return note("is null: taken as not there");
  if (const GltfProperty* property = member->property) {
    const bool is_lost = property->use == GltfUse::kApproximated || property->use == GltfUse::kIgnored;
    if (is_lost && !is_neutral(document_, value, property->neutral)) note(property->words);
    if (property->use == GltfUse::kIgnored || property->use == GltfUse::kNothing) return;
  }
  visit(value, key.ends_with("Texture") ? *find(schema(), "textureInfo") : *member);
}

void Walk::visit_extensions(const JsonValue& value, const Schema* as) {
  if (value.type != JsonValue::Type::kObject) return;
  for (const JsonMember& extension : document_.members(value)) {
    way_.push_back({document_.key_of(extension)});
    const std::string_view name = way_.back().key;
    extensions_met_.emplace(name);
    if (const Schema* known = as == nullptr ? nullptr : find(*as, name))
      visit(extension.value, *known);
    else
      note_extension(name);
    way_.pop_back();
  }
}

void Walk::note_extension(std::string_view name) {
  for (const GltfExtension& known : gltf_extensions()) {
    if (name != known.name) continue;
    if (known.use == GltfUse::kIgnored) note(known.words);
    if (known.use == GltfUse::kShown) note(shortened(name) + " has no place here: ignored");
    return;
  }
  note(shortened(name) + " is an extension that is not known: ignored");
}

// What a file says that it uses may have no object of its own.
void Walk::note_declared_extensions() {
  const JsonValue* used = document_.find(document_.root(), "extensionsUsed");
  if (used == nullptr || used->type != JsonValue::Type::kArray) return;
  for (const JsonValue& value : document_.elements(*used)) {
    if (value.type != JsonValue::Type::kString) continue;
    const std::string_view name = document_.string(value);
    const auto known = std::find_if(gltf_extensions().begin(), gltf_extensions().end(),
                                    [&](const GltfExtension& extension) { return name == extension.name; });
    if (extensions_met_.contains(name) || known != gltf_extensions().end()) continue;
    way_ = {{"extensionsUsed"}};
    note_extension(name);
  }
}

}  // namespace

void note_gltf_properties(const JsonDocument& document, FileNotes& notes) {
  Walk walk(document, notes);
  walk.visit(document.root(), schema());
  walk.note_declared_extensions();
}

}  // namespace lightwell
