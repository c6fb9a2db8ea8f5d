#include "scene/gltf_accessor.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <type_traits>

namespace lightwell {

namespace {

int component_count(const JsonView& where, const std::string& type) {
  struct Type {
    const char* name;
    int components;
  };
  constexpr std::array<Type, 5> kTypes = {{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}}};
  for (const Type& known : kTypes)
    if (type == known.name) return known.components;
  where.fail("unsupported accessor type '" + type.substr(0, 20) + "'");
}

JsonView accessor_json(GltfFile& file, const JsonView& reference) {
  const JsonView accessors = file.root()["accessors"];
  const int index = reference.index(accessors.size());
  if (index < 0) reference.fail("no accessor given");
  return accessors[static_cast<std::size_t>(index)];
}

template <typename Stored, typename T>
T converted(Stored value, [[maybe_unused]] bool normalized) {
  if constexpr (std::is_same_v<T, float> && std::is_integral_v<Stored>) {
    if (normalized)
      return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<Stored>::max()), -1.0f);
  }
  return static_cast<T>(value);
}

}  // namespace

std::size_t GltfAccessor::component_size(const JsonView& where, int type) {
  if (type < kByte || type > kFloat || type == 5124) where.fail("unknown component type " + std::to_string(type));
  std::size_t size = 0;
  with_component_type(type, [&](auto stored) { size = sizeof(stored); });
  return size;
}

GltfAccessor::GltfAccessor(GltfFile& file, const JsonView& reference, Data data)
    : file_(&file), json_(accessor_json(file, reference)) {
  const std::uint64_t count = json_["count"].count(0);
  if (count > std::numeric_limits<std::uint32_t>::max()) json_.fail("count is too large");
  count_ = count;
  component_type_ = static_cast<int>(json_["componentType"].index(65536));
  components_ = component_count(json_, json_["type"].string(""));
  normalized_ = json_["normalized"].boolean(false);
  if (components_ == 16 && component_type_ != kFloat) json_.fail("matrices must be floats");
  const Bytes decoded = file.accessor_bytes(reference);
  const std::size_t element_size = component_size(json_, component_type_) * static_cast<std::size_t>(components_);
  if (data == Data::kElsewhere) return;
  if (decoded.data() != nullptr) {
    if (decoded.size() != count_ * element_size) json_.fail("has another size than its compressed data");
    dense_ = {decoded, element_size, count_, component_type_, components_};
    return;
  }
  if (json_["bufferView"].present()) dense_ = locate(file, json_, count_, component_type_, components_, true);
  if (json_["sparse"].present()) read_sparse(json_["sparse"]);
}

GltfAccessor::Elements GltfAccessor::locate(GltfFile& file, const JsonView& json, std::size_t count, int component_type,
                                            int components, bool may_stride) {
  const int view = json["bufferView"].index(file.root()["bufferViews"].size());
  if (view < 0) json.fail("has no buffer view");
  Elements elements;
  elements.bytes = file.buffer_view(static_cast<std::size_t>(view));
  elements.count = count;
  elements.component_type = component_type;
  elements.components = components;
  const std::size_t element_size = component_size(json, component_type) * static_cast<std::size_t>(components);
  elements.stride = may_stride ? file.buffer_view_stride(static_cast<std::size_t>(view)) : 0;
  if (elements.stride == 0) elements.stride = element_size;
  if (elements.stride < element_size) json.fail("elements overlap");
  const std::uint64_t offset = json["byteOffset"].count(0);
  if (offset > elements.bytes.size()) json.fail("starts past the end of its buffer view");
  elements.bytes = elements.bytes.subspan(offset);
  // Neither product can overflow: count < 2^32, stride <= 2^16.
  if (count > 0 && (count - 1) * elements.stride + element_size > elements.bytes.size())
    json.fail("reaches past the end of its buffer view");
  return elements;
}

void GltfAccessor::read_sparse(const JsonView& sparse) {
  const std::uint64_t count = sparse["count"].count(0);
  if (count > count_) sparse.fail("more sparse values than elements");
  const JsonView indices = sparse["indices"];
  const int type = indices["componentType"].index(65536);
  if (type != kUByte && type != kUShort && type != kUInt) indices.fail("indices must be unsigned integers");
  file_->budget().charge(count, sizeof(std::uint32_t));
  const Elements places = locate(*file_, indices, count, type, 1, false);
  sparse_places_.resize(count);
  convert<std::uint32_t>(places, false, sparse_places_, {});
  for (const std::uint32_t place : sparse_places_)
    if (place >= count_) indices.fail("index " + std::to_string(place) + " of " + std::to_string(count_));
  sparse_values_ = locate(*file_, sparse["values"], count, component_type_, components_, false);
}

void GltfAccessor::expect_components(int components) const {
  if (components != components_) json_.fail("has the wrong type for its use");
}

// Element i goes to place i, or to places[i].
template <typename T>
void GltfAccessor::convert(const Elements& from, bool normalized, std::span<T> to,
                           std::span<const std::uint32_t> places) {
  const auto width = static_cast<std::size_t>(from.components);
  const auto convert_as = [&](auto stored) {
    using Stored = decltype(stored);
    for (std::size_t i = 0; i < from.count; ++i) {
      const std::uint8_t* element = from.bytes.data() + i * from.stride;
      T* target = to.data() + (places.empty() ? i : places[i]) * width;
      for (std::size_t c = 0; c < width; ++c) {
        std::memcpy(&stored, element + c * sizeof(Stored), sizeof(Stored));
        target[c] = converted<Stored, T>(stored, normalized);
      }
    }
  };
  with_component_type(from.component_type, [&](auto stored) {
    if constexpr (std::is_same_v<T, float> || std::is_integral_v<decltype(stored)>) convert_as(stored);
  });
}

template <typename T>
void GltfAccessor::decode(std::span<T> out) const {
  convert<T>(dense_, normalized_, out, {});
  convert<T>(sparse_values_, normalized_, out, sparse_places_);
}
template void GltfAccessor::decode<float>(std::span<float>) const;

std::vector<float> GltfAccessor::floats() const {
  const std::size_t size = count_ * static_cast<std::size_t>(components_);
  file_->budget().charge(size, sizeof(float));
  std::vector<float> values(size);
  decode<float>(values);
  return values;
}

std::vector<std::uint32_t> GltfAccessor::unsigned_integers() const {
  if (component_type_ != kUByte && component_type_ != kUShort && component_type_ != kUInt)
    json_.fail("must hold unsigned integers");
  const std::size_t size = count_ * static_cast<std::size_t>(components_);
  file_->budget().charge(size, sizeof(std::uint32_t));
  std::vector<std::uint32_t> values(size);
  decode<std::uint32_t>(values);
  return values;
}

}  // namespace lightwell
