#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/ext/matrix_float4x4.hpp>

#include "lightwell/error.h"
#include "lightwell/scene.h"
#include "scene/pose.h"

namespace lightwell {

namespace {

// Geometry is transformed every frame: instances count, not meshes.
constexpr std::uint64_t kMaxPosingWork = std::uint64_t{1} << 27;
constexpr std::uint64_t kMaxJoints = std::uint64_t{1} << 22;  // each a matrix of 64 B, in every snapshot
constexpr float kHalfPi = 1.57079637f;

class Validator {
 public:
  Validator(const Scene& scene, const std::string& subject) : scene_(scene), subject_(subject) {}

  void check_textures() const;
  void check_materials() const;
  void check_meshes();
  void check_nodes() const;
  void check_skins() const;
  void check_lights_and_cameras() const;
  void check_animations() const;
  void check_environment() const;
  void check_world() const;

 private:
  void require(bool condition, const std::string& where, const char* cause) const {
    if (!condition) throw InputError(subject_, where + ": " + cause);
  }
  // `index` is -1 or below size.
  void check_index(int index, std::size_t size, const std::string& where) const {
    require(index >= -1 && index < static_cast<int>(size), where, "index out of range");
  }
  void check_texture_ref(const TextureRef& ref, const std::string& where) const;
  void check_primitive(const Primitive& primitive, const std::string& where);
  void check_channel(const AnimationChannel& channel, const std::string& where) const;

  // Every float of an array of vectors or matrices of floats.
  template <typename T, typename Predicate>
  void check_each(const std::vector<T>& values, const std::string& where, Predicate holds, const char* cause) const {
    const float* first = reinterpret_cast<const float*>(values.data());
    require(std::all_of(first, first + values.size() * (sizeof(T) / sizeof(float)), holds), where, cause);
  }
  template <typename T>
  void check_finite(const std::vector<T>& values, const std::string& where) const {
    check_each(
        values, where, [](float value) { return std::isfinite(value); }, "a number is not finite");
  }
  template <typename T>
  void check_finite(const T& value, const std::string& where) const {
    check_finite(std::vector<T>{value}, where);
  }
  void check_not_negative(const glm::vec3& color, const std::string& where) const {
    check_finite(color, where);
    require(color.x >= 0.0f && color.y >= 0.0f && color.z >= 0.0f, where, "is negative");
  }

  void check_light(const glm::vec3& light, const std::string& where) const {
    check_not_negative(light, where);
    require(std::max({light.x, light.y, light.z}) <= kMaxLight, where, "is more than 1e18");
  }

  const Scene& scene_;
  const std::string& subject_;
  std::vector<int> max_joint_;  // the largest joint index that each mesh uses; -1: none
};

std::string place(const char* array, std::size_t i) {
  return std::string(array) + "[" + std::to_string(i) + "]";
}

void Validator::check_textures() const {
  for (std::size_t i = 0; i < scene_.textures.size(); ++i) {
    const Texture& t = scene_.textures[i];
    require(t.width > 0 && t.height > 0 && t.width <= kMaxImageSide && t.height <= kMaxImageSide, place("textures", i),
            "bad size");
    require(t.rgba.size() == std::size_t{4} * static_cast<std::size_t>(t.width) * static_cast<std::size_t>(t.height),
            place("textures", i), "texel count does not match the size");
  }
}

void Validator::check_texture_ref(const TextureRef& ref, const std::string& where) const {
  check_index(ref.texture, scene_.textures.size(), where);
  require(ref.texcoord >= 0 && ref.texcoord < static_cast<int>(kTexcoordSets), where,
          "texture coordinate set is not 0 to 3");
  check_finite(ref.transform, where);
}

void Validator::check_materials() const {
  for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
    const Material& m = scene_.materials[i];
    const std::string where = place("materials", i);
    check_not_negative(glm::vec3(m.base_color), where + ".base_color");
    check_light(m.emission, where + ".emission");
    check_not_negative(m.specular_color, where + ".specular_color");
    check_finite(glm::vec4(m.metallic, m.roughness, m.specular, m.ior), where);
    check_finite(glm::vec2(m.base_color.w, m.alpha_cutoff), where);
    check_texture_ref(m.base_color_texture, where + ".base_color_texture");
    check_texture_ref(m.emission_texture, where + ".emission_texture");
    check_texture_ref(m.metallic_roughness_texture, where + ".metallic_roughness_texture");
    check_texture_ref(m.normal_texture, where + ".normal_texture");
    check_texture_ref(m.bump_texture, where + ".bump_texture");
    check_finite(glm::vec2(m.normal_scale, m.bump_scale), where);
  }
}

void Validator::check_primitive(const Primitive& p, const std::string& where) {
  const std::size_t count = p.positions.size();
  const auto matches = [&](std::size_t size) { return size == 0 || size == count; };
  check_index(p.material, scene_.materials.size(), where + ".material");
  require(p.normals.size() == count, where + ".normals", "not one a vertex");
  for (const std::vector<glm::vec2>& texcoords : p.texcoords) {
    require(matches(texcoords.size()), where + ".texcoords", "not one a vertex");
    check_finite(texcoords, where + ".texcoords");
  }
  require(matches(p.colors.size()), where + ".colors", "not one a vertex");
  check_each(
      p.colors, where + ".colors", [](float value) { return value >= 0.0f && value <= 1.0f; },
      "a number is not in 0 to 1");
  require(matches(p.joints.size()) && p.joints.size() == p.weights.size(), where + ".joints", "not one a vertex");
  require(p.indices.size() % 3 == 0, where + ".indices", "not three a triangle");
  const auto largest = std::max_element(p.indices.begin(), p.indices.end());
  require(largest == p.indices.end() || *largest < count, where + ".indices", "vertex index out of range");
  check_finite(p.positions, where + ".positions");
  check_finite(p.normals, where + ".normals");
  check_finite(p.weights, where + ".weights");
  for (const MorphTarget& target : p.morph_targets) {
    require(matches(target.positions.size()) && matches(target.normals.size()), where + ".morph_targets",
            "not one offset a vertex");
    check_finite(target.positions, where + ".morph_targets");
    check_finite(target.normals, where + ".morph_targets");
  }
  for (const glm::u16vec4& joints : p.joints)
    for (int k = 0; k < 4; ++k) max_joint_.back() = std::max(max_joint_.back(), static_cast<int>(joints[k]));
}

void Validator::check_meshes() {
  for (std::size_t i = 0; i < scene_.meshes.size(); ++i) {
    const Mesh& mesh = scene_.meshes[i];
    const std::string where = place("meshes", i);
    max_joint_.push_back(-1);
    check_finite(mesh.morph_weights, where + ".morph_weights");
    for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
      require(mesh.primitives[k].morph_targets.size() == mesh.morph_weights.size(), where, "not one weight a target");
      check_primitive(mesh.primitives[k], where + "." + place("primitives", k));
    }
  }
}

void Validator::check_nodes() const {
  for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
    const Node& node = scene_.nodes[i];
    const std::string where = place("nodes", i);
    require(node.parent >= -1 && node.parent < static_cast<int>(i), where + ".parent",
            "does not come before its child");
    check_index(node.mesh, scene_.meshes.size(), where + ".mesh");
    check_index(node.skin, scene_.skins.size(), where + ".skin");
    check_index(node.camera, scene_.cameras.size(), where + ".camera");
    check_index(node.light, scene_.lights.size(), where + ".light");
    check_finite(node.morph_weights, where + ".morph_weights");
    if (node.mesh < 0) continue;
    const auto mesh = static_cast<std::size_t>(node.mesh);
    require(node.morph_weights.empty() || node.morph_weights.size() == scene_.meshes[mesh].morph_weights.size(), where,
            "not one weight a morph target");
    require(node.skin < 0 ||
                max_joint_[mesh] < static_cast<int>(scene_.skins[static_cast<std::size_t>(node.skin)].joints.size()),
            where, "its mesh uses joints that its skin lacks");
  }
}

void Validator::check_skins() const {
  for (std::size_t i = 0; i < scene_.skins.size(); ++i) {
    const Skin& skin = scene_.skins[i];
    require(!skin.joints.empty(), place("skins", i), "has no joints");
    require(skin.joints.size() == skin.inverse_bind_matrices.size(), place("skins", i), "not one matrix a joint");
    for (const int joint : skin.joints)
      require(joint >= 0 && joint < static_cast<int>(scene_.nodes.size()), place("skins", i), "joint out of range");
    check_finite(skin.inverse_bind_matrices, place("skins", i));
  }
}

void Validator::check_lights_and_cameras() const {
  for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
    const Light& light = scene_.lights[i];
    check_light(light.intensity, place("lights", i) + ".intensity");
    require(light.type != LightType::kSpot || (light.inner_angle >= 0.0f && light.inner_angle < light.outer_angle &&
                                               light.outer_angle <= kHalfPi + 1e-4f),
            place("lights", i), "spot angles must be 0 <= inner < outer <= 90 degrees");
    require(light.range > 0.0f, place("lights", i) + ".range", "is not more than 0");
  }
  for (std::size_t i = 0; i < scene_.cameras.size(); ++i) {
    const Camera& camera = scene_.cameras[i];
    const std::string where = place("cameras", i);
    require(camera.half_height >= 0.0f && camera.half_height <= kMaxCoordinate, where, "half height out of range");
    require(camera.half_height > 0.0f || (camera.yfov > 1e-4f && camera.yfov < 3.1415f), where,
            "field of view out of range");
    require((camera.half_height > 0.0f ? camera.znear >= 0.0f : camera.znear > 0.0f) && camera.zfar > camera.znear &&
                std::isfinite(camera.zfar),
            where, "near and far planes must be 0 < near < far");
  }
}

void Validator::check_channel(const AnimationChannel& channel, const std::string& where) const {
  require(channel.node >= 0 && channel.node < static_cast<int>(scene_.nodes.size()), where, "node out of range");
  require(!channel.times.empty(), where, "has no keys");
  check_finite(channel.times, where + ".times");
  check_finite(channel.values, where + ".values");
  require(std::is_sorted(channel.times.begin(), channel.times.end()), where + ".times", "do not rise");
  std::size_t width = channel.path == AnimationPath::kRotation ? 4 : 3;
  if (channel.path == AnimationPath::kMorphWeights) {
    const int mesh = scene_.nodes[static_cast<std::size_t>(channel.node)].mesh;
    width = mesh < 0 ? 0 : scene_.meshes[static_cast<std::size_t>(mesh)].morph_weights.size();
  }
  if (channel.interpolation == Interpolation::kCubicSpline) width *= 3;
  const std::size_t wanted = channel.times.size() * width;
  const std::string cause = std::to_string(channel.values.size()) + " numbers, where its " +
                            std::to_string(channel.times.size()) + " keys need " + std::to_string(wanted);
  require(channel.values.size() == wanted, where + ".values", cause.c_str());
}

void Validator::check_animations() const {
  for (std::size_t i = 0; i < scene_.animations.size(); ++i)
    for (std::size_t k = 0; k < scene_.animations[i].channels.size(); ++k)
      check_channel(scene_.animations[i].channels[k], place("animations", i) + "." + place("channels", k));
}

void Validator::check_environment() const {
  const Environment& environment = scene_.environment;
  check_light(environment.radiance, "environment");
  const Image& map = environment.map;
  if (map.width == 0) return;
  require(map.width > 0 && map.height > 0 && map.channels == 3 &&
              map.pixels.size() ==
                  std::size_t{3} * static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height),
          "environment", "bad image size");
  check_each(
      map.pixels, "environment", [](float value) { return value >= 0.0f && value <= kMaxLight; },
      "a number is not in 0 to 1e18");
}

// Vertices that one pose of a node's mesh computes, once more for each morph target.
std::uint64_t posing_work(const Scene& scene, const Node& node) {
  const Mesh& mesh = scene.meshes[static_cast<std::size_t>(node.mesh)];
  std::uint64_t work = mesh.morph_weights.size();
  for (const Primitive& p : mesh.primitives) work += p.positions.size() * (1 + p.morph_targets.size());
  return work;
}

std::uint64_t joint_count(const Scene& scene, const Node& node) {
  return node.skin < 0 ? 0 : scene.skins[static_cast<std::size_t>(node.skin)].joints.size();
}

// Transforms and vertices in the world stay within what single precision can work with.
void Validator::check_world() const {
  const auto near = [](float value) { return std::abs(value) <= kMaxCoordinate; };
  constexpr const char* kTooFar = "reaches farther than 1e9 metres (see --scale) or is not finite";
  const std::vector<glm::dmat4> world = world_transforms(scene_.nodes, glm::dvec3(0.0));
  std::uint64_t work = 0;
  std::uint64_t joints = 0;
  for (std::size_t i = 0; i < world.size(); ++i) {
    check_each(std::vector<glm::mat4>{glm::mat4(world[i])}, place("nodes", i) + " transform", near, kTooFar);
    if (scene_.nodes[i].mesh < 0) continue;
    work += posing_work(scene_, scene_.nodes[i]);
    joints += joint_count(scene_, scene_.nodes[i]);
    require(work <= kMaxPosingWork, place("nodes", i), "the scene's instances have too many vertices");
    require(joints <= kMaxJoints, place("nodes", i), "the scene's instances have too many joints");
  }
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (scene_.nodes[i].mesh < 0) continue;
    const MeshInstance instance = make_instance(scene_, scene_.nodes, world, static_cast<int>(i));
    for (const Primitive& p : scene_.meshes[static_cast<std::size_t>(instance.mesh)].primitives)
      check_each(pose_positions(p, instance), place("nodes", i) + " geometry", near, kTooFar);
  }
}

}  // namespace

void validate(const Scene& scene, const std::string& subject) {
  Validator validator(scene, subject);
  validator.check_textures();
  validator.check_materials();
  validator.check_meshes();
  validator.check_nodes();
  validator.check_skins();
  validator.check_lights_and_cameras();
  validator.check_animations();
  validator.check_environment();
  validator.check_world();
}

}  // namespace lightwell
