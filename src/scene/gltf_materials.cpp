#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <glm/common.hpp>

#include "core/log.h"
#include "scene/gltf_parts.h"
#include "scene/gltf_repair.h"
#include "scene/texture_loader.h"

namespace lightwell {

namespace {

constexpr float kLargest = std::numeric_limits<float>::max();

Wrap read_wrap(GltfFile& file, const JsonView& json) {
  switch (json.count(10497)) {
    case 10497:
      return Wrap::kRepeat;
    case 33071:
      return Wrap::kClampToEdge;
    case 33648:
      return Wrap::kMirroredRepeat;
    default:
      file.note(json, "is no wrap mode that is known: the texture repeats");
      return Wrap::kRepeat;
  }
}

// uv' = offset + R * (scale * uv). The extension's angle turns counter-clockwise as seen with v pointing down (glTF
// pull request 1624), so that a quarter turn takes (u, v) to (v, -u).
glm::mat3x2 read_texture_transform(GltfFile& file, const JsonView& json) {
  std::array<float, 2> offset = {0.0f, 0.0f};
  std::array<float, 2> scale = {1.0f, 1.0f};
  read_numbers(file, json["offset"], offset);
  read_numbers(file, json["scale"], scale);
  const float angle = read_number(file, json["rotation"], 0.0f, -kLargest, kLargest);
  const float c = std::cos(angle);
  const float s = std::sin(angle);
  return {c * scale[0], -s * scale[0], s * scale[1], c * scale[1], offset[0], offset[1]};
}

class MaterialReader {
 public:
  MaterialReader(GltfFile& file, Scene& scene) : file_(file), scene_(scene), loader_(scene, file.path()) {}

  Material read(const JsonView& json);

 private:
  void read_base(const JsonView& metallic, const JsonView& glossy, Material& material);
  TextureRef read_texture_ref(const JsonView& info);
  int texture(std::size_t index);
  int image_texture(std::size_t image, const JsonView& sampler);

  GltfFile& file_;
  Scene& scene_;
  TextureLoader loader_;
  std::map<std::size_t, int> textures_;                          // of glTF textures
  std::map<std::pair<std::size_t, std::uint64_t>, int> images_;  // of an image and a way to sample it; -1: none
};

// One Texture for each pair of image and sampler settings. Only images that a material uses are decoded.
int MaterialReader::image_texture(std::size_t image, const JsonView& sampler) {
  const Wrap wrap_u = read_wrap(file_, sampler["wrapS"]);
  const Wrap wrap_v = read_wrap(file_, sampler["wrapT"]);
  const bool nearest = sampler["magFilter"].count(9729) == 9728;
  const std::uint64_t sampling =
      static_cast<std::uint64_t>(wrap_u) * 8 + static_cast<std::uint64_t>(wrap_v) * 2 + nearest;
  const auto found = images_.find({image, sampling});
  if (found != images_.end()) return found->second;

  int index = -1;
  if (const std::optional<GltfFile::EncodedImage> encoded = file_.image(image)) {
    const std::string name = read_name(file_, file_.root()["images"][image]["name"]);
    index = loader_.add(encoded->subject, name, encoded->bytes);
  }
  if (index >= 0) {
    Texture& texture = scene_.textures[static_cast<std::size_t>(index)];
    texture.wrap_u = wrap_u;
    texture.wrap_v = wrap_v;
    texture.nearest = nearest;
  }
  images_[{image, sampling}] = index;
  return index;
}

// The image of a texture: WebP, else that of the core, else one of a kind that the decoder can only name.
JsonView image_of(const JsonView& texture) {
  const JsonView extensions = texture["extensions"];
  for (const char* extension : {"EXT_texture_webp", "", "KHR_texture_basisu", "MSFT_texture_dds", "EXT_texture_avif"}) {
    const JsonView source = *extension == 0 ? texture["source"] : extensions[extension]["source"];
    if (source.present()) return source;
  }
  return texture["source"];
}

int MaterialReader::texture(std::size_t index) {
  const auto found = textures_.find(index);
  if (found != textures_.end()) return found->second;
  const JsonView root = file_.root();
  const JsonView json = root["textures"][index];
  const int image = image_of(json).index(root["images"].size());
  const int sampler = json["sampler"].index(root["samplers"].size());
  if (image < 0) file_.note(json, "has no image that can be read: left out");
  const JsonView sampler_json = sampler < 0 ? json["sampler"] : root["samplers"][static_cast<std::size_t>(sampler)];
  const int texture = image < 0 ? -1 : image_texture(static_cast<std::size_t>(image), sampler_json);
  textures_[index] = texture;
  return texture;
}

TextureRef MaterialReader::read_texture_ref(const JsonView& info) {
  TextureRef ref;
  if (!info.present()) return ref;
  const int index = info["index"].index(file_.root()["textures"].size());
  if (index < 0) info.fail("has no texture index");
  const JsonView transform = info["extensions"]["KHR_texture_transform"];
  const std::uint64_t texcoord = transform["texCoord"].count(info["texCoord"].count(0));
  if (texcoord >= kTexcoordSets) {
    file_.note(info, "is on a texture coordinate set beyond the fourth: left out");
    return ref;
  }
  ref.texture = texture(static_cast<std::size_t>(index));
  if (ref.texture < 0) return ref;
  ref.texcoord = static_cast<int>(texcoord);
  if (transform.present()) ref.transform = read_texture_transform(file_, transform);
  return ref;
}

AlphaMode read_alpha_mode(GltfFile& file, const JsonView& json) {
  const std::string mode = json.string("OPAQUE");
  if (mode == "OPAQUE") return AlphaMode::kOpaque;
  if (mode == "MASK") return AlphaMode::kMask;
  if (mode == "BLEND") return AlphaMode::kBlend;
  file.note(json, "is no alpha mode that is known: taken as opaque");
  return AlphaMode::kOpaque;
}

// Metallic-roughness, or, where a material has it, specular-glossiness: its diffuse colour is what a Lambert surface
// reflects, its glossiness the opposite of roughness.
void MaterialReader::read_base(const JsonView& metallic, const JsonView& glossy, Material& material) {
  const JsonView& given = glossy.present() ? glossy : metallic;
  const char* factor = glossy.present() ? "diffuseFactor" : "baseColorFactor";
  const char* texture = glossy.present() ? "diffuseTexture" : "baseColorTexture";
  read_color(file_, given[factor], {&material.base_color.x, 4}, kLargest);
  material.base_color_texture = read_texture_ref(given[texture]);
  if (glossy.present()) {
    material.metallic = 0.0f;
    material.roughness = 1.0f - read_number(file_, glossy["glossinessFactor"], 1.0f, 0.0f, 1.0f);
    return;
  }
  material.metallic = read_number(file_, metallic["metallicFactor"], 1.0f, 0.0f, 1.0f);
  material.roughness = read_number(file_, metallic["roughnessFactor"], 1.0f, 0.0f, 1.0f);
  material.metallic_roughness_texture = read_texture_ref(metallic["metallicRoughnessTexture"]);
}

Material MaterialReader::read(const JsonView& json) {
  Material material;
  material.name = read_name(file_, json["name"]);
  const JsonView extensions = json["extensions"];
  read_base(json["pbrMetallicRoughness"], extensions["KHR_materials_pbrSpecularGlossiness"], material);

  read_color(file_, json["emissiveFactor"], {&material.emission.x, 3}, kMaxLight);
  material.emission *=
      read_number(file_, extensions["KHR_materials_emissive_strength"]["emissiveStrength"], 1.0f, 0.0f, kMaxLight);
  material.emission = glm::min(material.emission, glm::vec3(kMaxLight));
  material.emission_texture = read_texture_ref(json["emissiveTexture"]);

  material.alpha_mode = read_alpha_mode(file_, json["alphaMode"]);
  material.alpha_cutoff = read_number(file_, json["alphaCutoff"], 0.5f, 0.0f, kLargest);
  material.double_sided = json["doubleSided"].boolean(false);

  const JsonView specular = extensions["KHR_materials_specular"];
  material.specular = read_number(file_, specular["specularFactor"], 1.0f, 0.0f, 1.0f);
  read_color(file_, specular["specularColorFactor"], {&material.specular_color.x, 3}, kLargest);
  material.ior = read_number(file_, extensions["KHR_materials_ior"]["ior"], 1.5f, 0.0f, kLargest);
  return material;
}

}  // namespace

void read_gltf_materials(GltfFile& file, Scene& scene) {
  MaterialReader reader(file, scene);
  const JsonView materials = file.root()["materials"];
  for (std::size_t i = 0; i < materials.size(); ++i) scene.materials.push_back(reader.read(materials[i]));
}

}  // namespace lightwell
