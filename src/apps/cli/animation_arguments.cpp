#include "apps/cli/animation_arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include <CLI/CLI.hpp>
#include <glm/common.hpp>

#include "apps/cli/text.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

constexpr float kMaxSeconds = 1e5f;  // a day and some; single precision still tells 8 ms apart there
constexpr float kMaxFramesPerSecond = 1e4f;

std::string list_animations(const Scene& scene) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.animations.size(); ++i)
    names.push_back(std::to_string(i) + (scene.animations[i].name.empty() ? "" : " " + scene.animations[i].name));
  return join(names);
}

// The first, and with it those that move nothing that moves already: exporters often write one animation for each
// object, whereas the actions of one character move the same bones.
Animation default_animation(const Scene& scene) {
  Animation together;
  std::set<std::pair<int, AnimationPath>> moved;
  for (const Animation& next : scene.animations) {
    const bool collides = std::any_of(next.channels.begin(), next.channels.end(), [&](const AnimationChannel& channel) {
      return moved.contains({channel.node, channel.path});
    });
    if (collides) continue;
    together.channels.insert(together.channels.end(), next.channels.begin(), next.channels.end());
    for (const AnimationChannel& channel : next.channels) moved.insert({channel.node, channel.path});
  }
  return together;
}

// By name, else by number.
Animation choose_animation(const Scene& scene, const std::string& wanted) {
  if (wanted.empty()) return default_animation(scene);
  for (const Animation& animation : scene.animations)
    if (animation.name == wanted) return animation;
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (error == std::errc() && end == wanted.data() + wanted.size() && index < scene.animations.size())
    return scene.animations[index];
  throw InputError("--animation",
                   "no animation '" + wanted + "' in the scene (there are: " + list_animations(scene) + ")");
}

void refuse_without_animation(const AnimationArguments& arguments, const std::string& scene) {
  for (const auto& [option, value] : {std::pair{"--animation", &arguments.animation},
                                      std::pair{"--time", &arguments.time}, std::pair{"--fps", &arguments.fps}})
    if (!value->empty()) throw InputError(option, "the scene " + scene + " has no animation");
}

}  // namespace

void add_animation_options(CLI::App& command, AnimationArguments& arguments) {
  command.add_option("--animation", arguments.animation,
                     "Animation of the scene, by name or number (the first, and others that move other things)");
  command.add_option("--time", arguments.time,
                     "Moment of the animation in seconds: what is shown, or the first of --frames (0)");
  command.add_option("--fps", arguments.fps,
                     "Moments a second: --frames N of an animated scene shows N of them, each one once (24)");
}

Playback::Playback(const Scene& scene, const SceneArguments& scene_arguments, const CameraArguments& camera,
                   const AnimationArguments& arguments)
    : scene_(scene), name_(scene_arguments.scene), camera_arguments_(camera) {
  if (scene.animations.empty()) {
    refuse_without_animation(arguments, name_);
  } else {
    animation_ = choose_animation(scene, arguments.animation);
    if (!arguments.time.empty()) start_ = parse_number("--time", arguments.time, 0.0f, kMaxSeconds);
    if (!arguments.fps.empty()) frames_per_second_ = parse_number("--fps", arguments.fps, 1e-2f, kMaxFramesPerSecond);
  }
  SceneSnapshot first = world_at(start_);
  if (is_camera_of_scene(first, camera)) return;
  if (animation_) first.bounds = bounds_of_all_moments();
  still_camera_ = choose_camera(scene_, first, camera);
}

SceneSnapshot Playback::world_at(double seconds) const {
  if (!animation_) return take_snapshot(scene_);
  SceneSnapshot world = take_snapshot(scene_, animate_nodes(scene_, *animation_, static_cast<float>(seconds)));
  char when[64];
  std::snprintf(when, sizeof when, "%g s of the animation", seconds);
  validate(world, name_ + ": at " + when);
  return world;
}

Bounds Playback::bounds_of_all_moments() const {
  constexpr int kIntervals = 32;  // close enough for a view of it
  const double end = animation_end(*animation_);
  Bounds bounds = world_at(0.0).bounds;
  for (int i = 1; i <= kIntervals && end > 0.0; ++i) {
    const Bounds now = world_at(end * i / kIntervals).bounds;
    bounds = {glm::min(bounds.minimum, now.minimum), glm::max(bounds.maximum, now.maximum)};
  }
  return bounds;
}

Moment Playback::moment_at(double seconds) const {
  const SceneSnapshot world = world_at(seconds);
  return {world, still_camera_ ? *still_camera_ : choose_camera(scene_, world, camera_arguments_), seconds};
}

Moment Playback::frame(int index) const {
  return moment_at(start_ + index / frames_per_second_);
}

Moment Playback::looped_frame(int index) const {
  const double end = animation_ ? animation_end(*animation_) : 0.0;
  return moment_at(end > 0.0 ? std::fmod(start_ + index / frames_per_second_, end) : 0.0);
}

}  // namespace lightwell
