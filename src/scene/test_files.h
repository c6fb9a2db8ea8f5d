// Small scene files for tests, made on the spot.
#pragma once

#include <stdlib.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>

#include "lightwell/error.h"
#include "lightwell/scene.h"

namespace lightwell::test {

// A folder that lives as long as this object; in memory where the system allows, for thousands of files a second.
class TempFolder {
 public:
  TempFolder() {
    const bool in_memory = ::access("/dev/shm", W_OK) == 0;
    const auto parent = in_memory ? std::filesystem::path("/dev/shm") : std::filesystem::temp_directory_path();
    std::string pattern = (parent / "lightwell-scene-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::string path(const std::string& name) const { return path_ + "/" + name; }
  std::string write(const std::string& name, std::string_view content) const {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }
  Scene load(const std::string& name, std::string_view content, const ImportOptions& options = {}) const {
    return load_scene(write(name, content), options);
  }
  // The message with which loading fails; empty if it does not.
  std::string error(const std::string& name, std::string_view content) const {
    try {
      load(name, content);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  std::string path_;
};

inline std::string base64(std::string_view bytes) {
  constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (int k = 0; k < 4; ++k)
      text += i + static_cast<std::size_t>(k) > bytes.size() ? '=' : kAlphabet[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

template <typename T>
std::string raw_bytes(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// A GLB file of one JSON chunk and one of binary data.
inline std::string glb_of(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto word = [](std::size_t value) {
    return raw_bytes(std::vector<std::uint32_t>{static_cast<std::uint32_t>(value)});
  };
  return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + binary.size()) + word(json.size()) + "JSON" + json +
         word(binary.size()) + std::string("BIN\0", 4) + binary;
}

// Collects buffer views and accessors; the rest of the JSON is given as text.
class GltfBuilder {
 public:
  template <typename T>
  int view(const std::vector<T>& values, const std::string& extra = "") {
    data_.resize((data_.size() + 3) / 4 * 4, '\0');
    add(views_, R"({"buffer":0,"byteOffset":)" + std::to_string(data_.size()) + R"(,"byteLength":)" +
                    std::to_string(values.size() * sizeof(T)) + extra + "}");
    data_ += raw_bytes(values);
    return view_count_++;
  }

  // `fields` are the accessor's other members, such as "type":"VEC3","count":3,"componentType":5126.
  int accessor(const std::string& fields) {
    add(accessors_, "{" + fields + "}");
    return accessor_count_++;
  }

  int floats(const char* type, std::size_t width, const std::vector<float>& values) {
    return accessor(R"("bufferView":)" + std::to_string(view(values)) + R"(,"componentType":5126,"type":")" + type +
                    R"(","count":)" + std::to_string(values.size() / width));
  }
  int vec3(const std::vector<float>& values) { return floats("VEC3", 3, values); }
  int vec2(const std::vector<float>& values) { return floats("VEC2", 2, values); }
  int indices(const std::vector<std::uint16_t>& values) {
    return accessor(R"("bufferView":)" + std::to_string(view(values)) +
                    R"(,"componentType":5123,"type":"SCALAR","count":)" + std::to_string(values.size()));
  }

  const std::string& data() const { return data_; }

  // With the buffer embedded, or in another file.
  std::string text(const std::string& rest, const std::string& uri = "") const {
    return json(rest,
                R"("uri":")" + (uri.empty() ? "data:application/octet-stream;base64," + base64(data_) : uri) + "\",");
  }

  std::string glb(const std::string& rest) const { return glb_of(json(rest, ""), data_); }

 private:
  static void add(std::string& list, const std::string& item) { list += (list.empty() ? "" : ",") + item; }
  std::string json(const std::string& rest, const std::string& uri) const {
    return R"({"asset":{"version":"2.0"},"buffers":[{)" + uri + R"("byteLength":)" + std::to_string(data_.size()) +
           R"(}],"bufferViews":[)" + views_ + R"(],"accessors":[)" + accessors_ + "]" + (rest.empty() ? "" : ",") +
           rest + "}";
  }

  std::string data_;
  std::string views_;
  std::string accessors_;
  int view_count_ = 0;
  int accessor_count_ = 0;
};

// glTF text of nodes, lights and so on, without any geometry.
inline std::string gltf_of(const std::string& rest) {
  return R"({"asset":{"version":"2.0"},)" + rest + "}";
}

// glTF text of one mesh at the origin with one primitive given by its members.
inline std::string one_primitive(const GltfBuilder& builder, const std::string& primitive,
                                 const std::string& more = "") {
  return builder.text(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{)" + primitive + "}]}]" + more);
}

inline const Primitive& first_primitive(const Scene& scene) {
  return scene.meshes.at(0).primitives.at(0);
}

inline long triangle_count(const Scene& scene) {
  std::size_t count = 0;
  for (const Mesh& mesh : scene.meshes)
    for (const Primitive& primitive : mesh.primitives) count += primitive.indices.size() / 3;
  return static_cast<long>(count);
}

// Sum of the area vectors of all triangles, in mesh space.
inline glm::vec3 area_vector(const Primitive& p) {
  glm::vec3 sum(0.0f);
  for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
    const glm::vec3 a = p.positions[p.indices[i]], b = p.positions[p.indices[i + 1]], c = p.positions[p.indices[i + 2]];
    sum += 0.5f * glm::cross(b - a, c - a);
  }
  return sum;
}

}  // namespace lightwell::test

// With the operands printed.
#define EXPECT_VEC3_NEAR(actual, expected, tolerance)                                                  \
  do {                                                                                                 \
    const glm::vec3 a_ = (actual), e_ = (expected);                                                    \
    EXPECT_LE(glm::length(a_ - e_), tolerance) << #actual " is " << a_.x << " " << a_.y << " " << a_.z \
                                               << ", expected " << e_.x << " " << e_.y << " " << e_.z; \
  } while (false)
