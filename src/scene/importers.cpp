#include "scene/importers.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <new>
#include <stdexcept>

#include <glm/common.hpp>

#include "core/log.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

Scene import_by_extension(const std::string& path, const SceneFiles& files) {
  const std::string extension = lower_extension(path);
  if (extension == ".gltf" || extension == ".glb") return import_gltf(path, files);
  if (extension == ".obj") return import_obj(path, files);
  if (extension == ".ply") return import_ply(path, files);
  throw InputError(path, "unknown kind of scene file; expected .gltf, .glb, .obj or .ply");
}

void check_options(const ImportOptions& options) {
  if (!std::isfinite(options.scale) || options.scale < 1e-9f || options.scale > 1e9f)
    throw InputError("--scale", "expected a number between 1e-9 and 1e9");
  if (options.up != 'y' && options.up != 'z') throw InputError("--up", "expected y or z");
}

// What reflects more than it gets makes light out of nothing, more with every bounce.
void limit_reflectance(Scene& scene, const std::string& path) {
  int limited = 0;
  for (Material& material : scene.materials) {
    const glm::vec3 color(material.base_color);
    const glm::vec3 possible = glm::min(color, glm::vec3(1.0f));
    if (possible == color) continue;
    material.base_color = glm::vec4(possible, material.base_color.a);
    ++limited;
  }
  if (limited > 0)
    log_warning(path + ": " + std::to_string(limited) + " materials reflect more light than they get; limited to 1");
}

// Colours and alphas that are no numbers, or none of a surface.
void limit_vertex_colors(Scene& scene, const std::string& path) {
  std::size_t limited = 0;
  for (Mesh& mesh : scene.meshes)
    for (Primitive& primitive : mesh.primitives)
      for (glm::vec4& color : primitive.colors) {
        const glm::vec4 given = color;
        for (int c = 0; c < 4; ++c) color[c] = std::isnan(given[c]) ? 1.0f : std::clamp(given[c], 0.0f, 1.0f);
        limited += color != given;
      }
  if (limited > 0)
    log_warning(path + ": " + std::to_string(limited) + " vertex colours are not within 0 and 1; limited to them");
}

// Textures of which one texel is shown everywhere.
void note_missing_texcoords(const Scene& scene, const std::string& path) {
  std::size_t primitives = 0;
  for (const Mesh& mesh : scene.meshes)
    for (const Primitive& primitive : mesh.primitives) {
      if (primitive.material < 0) continue;
      const Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
      const auto lacks = [&](const TextureRef& ref) {
        return ref.texture >= 0 && primitive.texcoords[static_cast<std::size_t>(ref.texcoord)].empty();
      };
      primitives += lacks(material.base_color_texture) || lacks(material.emission_texture);
    }
  if (primitives > 0)
    log_warning(path + ": " + std::to_string(primitives) +
                " primitives have a texture but no texture coordinates: one texel of it colours them");
}

}  // namespace

void apply_import_options(Scene& scene, const ImportOptions& options) {
  check_options(options);
  if (options.scale == 1.0f && options.up == 'y') return;

  Node root;
  root.name = "file units";
  root.scale = glm::vec3(options.scale);
  if (options.up == 'z') root.rotation = glm::quat(std::sqrt(0.5f), -std::sqrt(0.5f), 0.0f, 0.0f);
  scene.nodes.insert(scene.nodes.begin(), std::move(root));

  // Every node moved up by one place; the former roots hang below the new one, which is what -1 + 1 says.
  for (std::size_t i = 1; i < scene.nodes.size(); ++i) ++scene.nodes[i].parent;
  for (Skin& skin : scene.skins)
    for (int& joint : skin.joints) ++joint;
  for (Animation& animation : scene.animations)
    for (AnimationChannel& channel : animation.channels) ++channel.node;
  for (Camera& camera : scene.cameras) {
    camera.znear *= options.scale;
    camera.zfar *= options.scale;
    camera.half_height *= options.scale;
  }
  for (Light& light : scene.lights) light.range *= options.scale;
}

Scene load_scene(const std::string& path, const ImportOptions& options) {
  check_options(options);
  try {
    Scene scene = import_by_extension(path, SceneFiles(options.root));
    scene.name = std::filesystem::path(path).stem().string();
    apply_import_options(scene, options);
    limit_vertex_colors(scene, path);
    validate(scene, path);
    limit_reflectance(scene, path);
    note_missing_texcoords(scene, path);
    scene.origin = choose_origin(take_snapshot(scene).bounds);
    return scene;
  } catch (const std::bad_alloc&) {
    throw InputError(path, "not enough memory to load it");
  } catch (const std::length_error&) {
    throw InputError(path, "not enough memory to load it");
  }
}

}  // namespace lightwell
