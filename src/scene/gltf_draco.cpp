#include "scene/gltf_accessor.h"
#include "scene/gltf_compressed.h"

#if LIGHTWELL_DRACO
#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <type_traits>

// The library's headers give warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#include <draco/compression/decode.h>
#pragma GCC diagnostic pop

namespace lightwell {

namespace {

std::unique_ptr<draco::Mesh> decode(const JsonView& json, Bytes compressed) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(compressed.data()), compressed.size());
  draco::Decoder decoder;
  auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
  if (!mesh.ok()) json.fail("its data is damaged");
  return std::move(mesh).value();
}

template <typename T>
void append(std::vector<std::uint8_t>& bytes, const T* values, std::size_t count) {
  const auto* first = reinterpret_cast<const std::uint8_t*>(values);
  bytes.insert(bytes.end(), first, first + count * sizeof(T));
}

// The attribute as the accessor says that it lies in memory.
std::vector<std::uint8_t> bytes_of(const JsonView& json, const draco::Mesh& mesh,
                                   const draco::PointAttribute& attribute, const GltfAccessor& accessor) {
  if (accessor.count() != mesh.num_points()) json.fail("its accessor has another count than its data");
  std::vector<std::uint8_t> bytes;
  const int width = accessor.components();
  if (attribute.num_components() < width || width > 4) json.fail("its accessor has another type than its data");
  accessor.with_component_type([&](auto stored) {
    using Stored = decltype(stored);
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
      std::array<Stored, 4> values{};
      if (!attribute.ConvertValue<Stored>(attribute.mapped_index(point), static_cast<std::int8_t>(width),
                                          values.data()))
        json.fail("its data does not fit its accessor");
      append(bytes, values.data(), static_cast<std::size_t>(width));
    }
  });
  return bytes;
}

std::vector<std::uint8_t> index_bytes(const JsonView& json, const draco::Mesh& mesh, const GltfAccessor& accessor) {
  if (accessor.count() != std::size_t{3} * mesh.num_faces() || accessor.components() != 1)
    json.fail("its indices have another count than its data");
  std::vector<std::uint8_t> bytes;
  accessor.with_component_type([&](auto stored) {
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
      for (const draco::PointIndex& point : mesh.face(face)) {
        const auto index = static_cast<decltype(stored)>(point.value());
        append(bytes, &index, 1);
      }
  });
  return bytes;
}

}  // namespace

void decode_draco(GltfFile& file, const JsonView& primitive) {
  const JsonView json = primitive["extensions"]["KHR_draco_mesh_compression"];
  if (!json.present()) return;
  const int view = json["bufferView"].index(file.root()["bufferViews"].size());
  if (view < 0) json.fail("has no buffer view");
  const std::unique_ptr<draco::Mesh> mesh = decode(json, file.buffer_view(static_cast<std::size_t>(view)));
  const JsonView compressed = json["attributes"];
  for (std::size_t i = 0; i < compressed.member_count(); ++i) {
    const std::string name = compressed.member_name(i);
    const JsonView reference = primitive["attributes"][name.c_str()];
    const std::uint64_t id = compressed[name.c_str()].count(0);
    const draco::PointAttribute* attribute =
        id > 0xffffffffu ? nullptr : mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
    if (!reference.present() || attribute == nullptr) compressed.fail("names an attribute that is not there");
    const GltfAccessor accessor(file, reference, GltfAccessor::Data::kElsewhere);
    file.set_accessor_bytes(reference, bytes_of(json, *mesh, *attribute, accessor));
  }
  const JsonView indices = primitive["indices"];
  if (!indices.present()) return;
  const GltfAccessor accessor(file, indices, GltfAccessor::Data::kElsewhere);
  file.set_accessor_bytes(indices, index_bytes(json, *mesh, accessor));
}

}  // namespace lightwell

#else

namespace lightwell {

// Accessors with data of their own are read instead.
void decode_draco(GltfFile& file, const JsonView& primitive) {
  const JsonView json = primitive["extensions"]["KHR_draco_mesh_compression"];
  if (!json.present()) return;
  const JsonView accessors = file.root()["accessors"];
  const int position = primitive["attributes"]["POSITION"].index(accessors.size());
  if (position < 0 || !accessors[static_cast<std::size_t>(position)]["bufferView"].present())
    json.fail("this build of Lightwell has no Draco to read it");
}

}  // namespace lightwell

#endif
