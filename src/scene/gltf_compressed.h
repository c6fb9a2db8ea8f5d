// Compressed geometry in glTF files: KHR_draco_mesh_compression, and EXT_meshopt_compression. What the library for one
// of them was not there for when Lightwell was built is refused, unless the file holds the data uncompressed too.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/gltf_file.h"

namespace lightwell {

// The bytes of a buffer view that `json`, its EXT_meshopt_compression, describes; `compressed` are those that it names.
std::vector<std::uint8_t> decode_meshopt(GltfFile& file, const JsonView& json, Bytes compressed);

// Decodes the primitive's KHR_draco_mesh_compression, if it has one, into the accessors that its attributes and indices
// name.
void decode_draco(GltfFile& file, const JsonView& primitive);

}  // namespace lightwell
