#include <algorithm>

#include "scene/gltf_accessor.h"
#include "scene/gltf_parts.h"
#include "scene/gltf_repair.h"

namespace lightwell {

namespace {

// False for targets of extensions (KHR_animation_pointer).
bool read_path(const std::string& name, AnimationPath& path) {
  if (name == "translation")
    path = AnimationPath::kTranslation;
  else if (name == "rotation")
    path = AnimationPath::kRotation;
  else if (name == "scale")
    path = AnimationPath::kScale;
  else if (name == "weights")
    path = AnimationPath::kMorphWeights;
  else
    return false;
  return true;
}

Interpolation read_interpolation(const JsonView& json) {
  const std::string name = json.string("LINEAR");
  if (name == "LINEAR") return Interpolation::kLinear;
  if (name == "STEP") return Interpolation::kStep;
  if (name == "CUBICSPLINE") return Interpolation::kCubicSpline;
  json.fail("unknown interpolation");
}

// False if the channel moves nothing that is shown: what extensions target, morph weights outside the scene.
bool read_channel(GltfFile& file, const Scene& scene, const JsonView& json, const JsonView& samplers,
                  const std::vector<int>& nodes, AnimationChannel& channel) {
  const int sampler_index = json["sampler"].index(samplers.size());
  if (sampler_index < 0) json.fail("has no sampler");
  const int node = json["target"]["node"].index(nodes.size());
  if (node < 0 || !read_path(json["target"]["path"].string(""), channel.path)) return false;
  channel.node = nodes[static_cast<std::size_t>(node)];
  if (channel.path == AnimationPath::kMorphWeights && scene.nodes[static_cast<std::size_t>(channel.node)].mesh < 0)
    return false;

  const JsonView sampler = samplers[static_cast<std::size_t>(sampler_index)];
  channel.interpolation = read_interpolation(sampler["interpolation"]);
  const GltfAccessor times(file, sampler["input"]);
  times.expect_components(1);
  channel.times = times.floats();
  channel.values = GltfAccessor(file, sampler["output"]).floats();
  if (!std::all_of(channel.times.begin(), channel.times.end(), is_finite_value<float>) ||
      !std::all_of(channel.values.begin(), channel.values.end(), is_finite_value<float>)) {
    file.note(sampler, "holds numbers that are not finite: its channels are left out");
    return false;
  }
  if (!std::is_sorted(channel.times.begin(), channel.times.end())) {
    file.note(sampler, "its times do not rise: its channels are left out");
    return false;
  }
  return true;
}

}  // namespace

void read_gltf_skins(GltfFile& file, Scene& scene, const std::vector<int>& nodes) {
  const JsonView skins = file.root()["skins"];
  for (std::size_t i = 0; i < skins.size(); ++i) {
    Skin skin;
    skin.joints = skins[i]["joints"].indices(nodes.size());
    for (int& joint : skin.joints) joint = nodes[static_cast<std::size_t>(joint)];
    const JsonView matrices = skins[i]["inverseBindMatrices"];
    if (matrices.present())
      skin.inverse_bind_matrices = GltfAccessor(file, matrices).vectors<glm::mat4>();
    else
      skin.inverse_bind_matrices.resize(skin.joints.size(), glm::mat4(1.0f));
    if (skin.inverse_bind_matrices.size() < skin.joints.size()) matrices.fail("fewer matrices than joints");
    skin.inverse_bind_matrices.resize(skin.joints.size());
    replace_not_finite(file, matrices, skin.inverse_bind_matrices, glm::mat4(1.0f),
                       "holds numbers that are not finite: such matrices are taken as 1");
    scene.skins.push_back(std::move(skin));
  }
}

void read_gltf_animations(GltfFile& file, Scene& scene, const std::vector<int>& nodes) {
  const JsonView animations = file.root()["animations"];
  for (std::size_t i = 0; i < animations.size(); ++i) {
    Animation animation;
    animation.name = read_name(file, animations[i]["name"]);
    const JsonView channels = animations[i]["channels"];
    for (std::size_t k = 0; k < channels.size(); ++k) {
      AnimationChannel channel;
      if (read_channel(file, scene, channels[k], animations[i]["samplers"], nodes, channel))
        animation.channels.push_back(std::move(channel));
    }
    if (animation.channels.empty())
      file.note(animations[i], "moves nothing that is known: left out");
    else
      scene.animations.push_back(std::move(animation));
  }
}

}  // namespace lightwell
