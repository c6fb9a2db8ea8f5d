// Decoding of glTF accessors: any component type, normalised, strided, sparse, or without data (zeros).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "scene/gltf_file.h"

namespace lightwell {

class GltfAccessor {
 public:
  // Where its elements are: where it says, or in a compressed mesh that is yet to be decoded.
  enum class Data { kAsStated, kElsewhere };

  // Checks the whole accessor against its buffers, before anything is allocated. `reference` holds its index.
  GltfAccessor(GltfFile& file, const JsonView& reference, Data data = Data::kAsStated);

  std::size_t count() const { return count_; }
  int components() const { return components_; }

  // Calls `use` with a number of the type that its components are stored in.
  template <typename Function>
  void with_component_type(Function use) const {
    with_component_type(component_type_, use);
  }

  // Throws InputError unless the accessor's type is `components` wide (1, 2, 3, 4, or 16 for MAT4).
  void expect_components(int components) const;

  // Reads integers as if the accessor said that they are normalised.
  void normalize_integers() { normalized_ = true; }

  // count() * components() values. Integers become floats as glTF says: divided by their maximum if normalised.
  std::vector<float> floats() const;
  // The same for unsigned integers. Throws InputError for other component types.
  std::vector<std::uint32_t> unsigned_integers() const;

  // As vectors of T, whose width must be the accessor's.
  template <typename T>
  std::vector<T> vectors() const {
    expect_components(static_cast<int>(sizeof(T) / sizeof(float)));
    file_->budget().charge(count_, sizeof(T));
    std::vector<T> values(count_);
    decode<float>({reinterpret_cast<float*>(values.data()), count_ * (sizeof(T) / sizeof(float))});
    return values;
  }

 private:
  enum ComponentType : int { kByte = 5120, kUByte = 5121, kShort = 5122, kUShort = 5123, kUInt = 5125, kFloat = 5126 };

  template <typename Function>
  static void with_component_type(int type, Function use) {
    switch (type) {
      case kByte:
        return use(std::int8_t{});
      case kUByte:
        return use(std::uint8_t{});
      case kShort:
        return use(std::int16_t{});
      case kUShort:
        return use(std::uint16_t{});
      case kUInt:
        return use(std::uint32_t{});
      default:
        return use(float{});
    }
  }
  static std::size_t component_size(const JsonView& where, int type);

  // Elements as they lie in memory.
  struct Elements {
    Bytes bytes;
    std::size_t stride = 0;
    std::size_t count = 0;
    int component_type = 0;
    int components = 1;
  };
  static Elements locate(GltfFile& file, const JsonView& json, std::size_t count, int component_type, int components,
                         bool may_stride);
  template <typename T>
  static void convert(const Elements& from, bool normalized, std::span<T> to, std::span<const std::uint32_t> places);
  template <typename T>
  void decode(std::span<T> out) const;
  void read_sparse(const JsonView& sparse);

  GltfFile* file_;
  JsonView json_;
  std::size_t count_ = 0;
  int component_type_ = 0;
  int components_ = 0;
  bool normalized_ = false;
  Elements dense_;  // count 0: zeros
  Elements sparse_values_;
  std::vector<std::uint32_t> sparse_places_;
};

}  // namespace lightwell
