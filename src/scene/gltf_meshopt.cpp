#include <string>

#include "scene/gltf_compressed.h"

#if LIGHTWELL_MESHOPT
#include <meshoptimizer.h>

namespace lightwell {

namespace {

struct Layout {
  std::size_t count = 0;
  std::size_t stride = 0;
};

// What the library takes as given.
void check_layout(const JsonView& json, const std::string& mode, const std::string& filter, const Layout& layout) {
  const bool attributes = mode == "ATTRIBUTES";
  if (!attributes && mode != "TRIANGLES" && mode != "INDICES") json["mode"].fail("is no mode that is known");
  if (attributes && (layout.stride == 0 || layout.stride > 256 || layout.stride % 4 != 0))
    json["byteStride"].fail("is no multiple of 4 up to 256");
  if (!attributes && layout.stride != 2 && layout.stride != 4) json["byteStride"].fail("of indices is not 2 or 4");
  if (mode == "TRIANGLES" && layout.count % 3 != 0) json["count"].fail("is not three indices a triangle");
  if (filter == "NONE") return;
  const bool octahedral = filter == "OCTAHEDRAL" && (layout.stride == 4 || layout.stride == 8);
  const bool quaternion = filter == "QUATERNION" && layout.stride == 8;
  if (!attributes || (!octahedral && !quaternion && filter != "EXPONENTIAL"))
    json["filter"].fail("is no filter for such data");
}

}  // namespace

std::vector<std::uint8_t> decode_meshopt(GltfFile& file, const JsonView& json, Bytes compressed) {
  const std::string mode = json["mode"].string("");
  const std::string filter = json["filter"].string("NONE");
  const std::uint64_t count = json["count"].count(0);
  if (count > 0xffffffffu) json["count"].fail("is too large");
  const Layout layout{count, json["byteStride"].count(0)};
  check_layout(json, mode, filter, layout);
  file.budget().charge(layout.count, layout.stride);
  std::vector<std::uint8_t> bytes(layout.count * layout.stride);
  int failed = 0;
  if (mode == "ATTRIBUTES")
    failed =
        meshopt_decodeVertexBuffer(bytes.data(), layout.count, layout.stride, compressed.data(), compressed.size());
  else if (mode == "TRIANGLES")
    failed = meshopt_decodeIndexBuffer(bytes.data(), layout.count, layout.stride, compressed.data(), compressed.size());
  else
    failed =
        meshopt_decodeIndexSequence(bytes.data(), layout.count, layout.stride, compressed.data(), compressed.size());
  if (failed != 0) json.fail("its data is damaged");
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), layout.count, layout.stride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), layout.count, layout.stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), layout.count, layout.stride);
  return bytes;
}

}  // namespace lightwell

#else

namespace lightwell {

std::vector<std::uint8_t> decode_meshopt(GltfFile&, const JsonView& json, Bytes) {
  json.fail("this build of Lightwell has no meshoptimizer to read it");
}

}  // namespace lightwell

#endif
