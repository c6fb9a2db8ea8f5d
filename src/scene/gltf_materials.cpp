#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/log.h"
#include "scene/gltf_parts.h"
#include "scene/texture_loader.h"

namespace lightwell {

namespace {

Wrap read_wrap(const JsonView& json) {
  switch (json.count(10497)) {
    case 10497:
      return Wrap::kRepeat;
    case 33071:
      return Wrap::kClampToEdge;
    case 33648:
      return Wrap::kMirroredRepeat;
    default:
      json.fail("unknown wrap mode");
  }
}

// uv' = offset + R * (scale * uv). The extension's angle turns counter-clockwise as seen with v pointing down (glTF
// pull request 1624), so that a quarter turn takes (u, v) to (v, -u).
glm::mat3x2 read_texture_transform(const JsonView& json) {
  std::array<float, 2> offset = {0.0f, 0.0f};
  std::array<float, 2> scale = {1.0f, 1.0f};
  json["offset"].read(offset);
  json["scale"].read(scale);
  const float angle = json["rotation"].number(0.0f);
  const float c = std::cos(angle);
  const float s = std::sin(angle);
  return {c * scale[0], -s * scale[0], s * scale[1], c * scale[1], offset[0], offset[1]};
}

class MaterialReader {
 public:
  MaterialReader(GltfFile& file, Scene& scene) : file_(file), scene_(scene), loader_(scene, file.path()) {}

  Material read(const JsonView& json);

 private:
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
  const Wrap wrap_u = read_wrap(sampler["wrapS"]);
  const Wrap wrap_v = read_wrap(sampler["wrapT"]);
  const bool nearest = sampler["magFilter"].count(9729) == 9728;
  const std::uint64_t sampling =
      static_cast<std::uint64_t>(wrap_u) * 8 + static_cast<std::uint64_t>(wrap_v) * 2 + nearest;
  const auto found = images_.find({image, sampling});
  if (found != images_.end()) return found->second;

  int index = -1;
  const GltfFile::EncodedImage encoded = file_.image(image);
  if (encoded.bytes.data() == nullptr) {
    log_warning(encoded.subject + ": texture not found, used by " + file_.path());
  } else {
    const std::string name = file_.root()["images"][image]["name"].string("");
    index = loader_.add(encoded.subject, name, encoded.bytes);
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

int MaterialReader::texture(std::size_t index) {
  const auto found = textures_.find(index);
  if (found != textures_.end()) return found->second;
  const JsonView root = file_.root();
  const JsonView json = root["textures"][index];
  const int image = json["source"].index(root["images"].size());
  const int sampler = json["sampler"].index(root["samplers"].size());
  if (image < 0) log_warning(file_.path() + ": texture " + std::to_string(index) + " has no PNG or JPEG image");
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
  if (texcoord > 1) {
    log_warning(file_.path() + ": a texture on coordinate set " + std::to_string(texcoord) + " is ignored");
    return ref;
  }
  ref.texture = texture(static_cast<std::size_t>(index));
  if (ref.texture < 0) return ref;
  ref.texcoord = static_cast<int>(texcoord);
  if (transform.present()) ref.transform = read_texture_transform(transform);
  return ref;
}

AlphaMode read_alpha_mode(const JsonView& json) {
  const std::string mode = json.string("OPAQUE");
  if (mode == "OPAQUE") return AlphaMode::kOpaque;
  if (mode == "MASK") return AlphaMode::kMask;
  if (mode == "BLEND") return AlphaMode::kBlend;
  json.fail("unknown alpha mode");
}

Material MaterialReader::read(const JsonView& json) {
  Material material;
  material.name = json["name"].string("");

  const JsonView pbr = json["pbrMetallicRoughness"];
  pbr["baseColorFactor"].read({&material.base_color.x, 4});
  material.base_color_texture = read_texture_ref(pbr["baseColorTexture"]);
  material.metallic = pbr["metallicFactor"].number(1.0f);
  material.roughness = pbr["roughnessFactor"].number(1.0f);
  material.metallic_roughness_texture = read_texture_ref(pbr["metallicRoughnessTexture"]);

  const JsonView extensions = json["extensions"];
  json["emissiveFactor"].read({&material.emission.x, 3});
  material.emission *= extensions["KHR_materials_emissive_strength"]["emissiveStrength"].number(1.0f);
  material.emission_texture = read_texture_ref(json["emissiveTexture"]);

  material.alpha_mode = read_alpha_mode(json["alphaMode"]);
  material.alpha_cutoff = json["alphaCutoff"].number(0.5f);
  material.double_sided = json["doubleSided"].boolean(false);

  const JsonView specular = extensions["KHR_materials_specular"];
  material.specular = specular["specularFactor"].number(1.0f);
  specular["specularColorFactor"].read({&material.specular_color.x, 3});
  material.ior = extensions["KHR_materials_ior"]["ior"].number(1.5f);
  return material;
}

}  // namespace

void read_gltf_materials(GltfFile& file, Scene& scene) {
  MaterialReader reader(file, scene);
  const JsonView materials = file.root()["materials"];
  for (std::size_t i = 0; i < materials.size(); ++i) scene.materials.push_back(reader.read(materials[i]));
}

}  // namespace lightwell
