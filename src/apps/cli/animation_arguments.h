// What `render` and `bench` are told about time, and the scene as it is seen at any moment.
#pragma once

#include <optional>
#include <string>

#include "apps/cli/render_methods.h"
#include "apps/cli/scene_arguments.h"
#include "lightwell/scene.h"

namespace CLI {
class App;
}

namespace lightwell {

// "" where nothing was given.
struct AnimationArguments {
  std::string animation, time, fps;
};

// Adds --animation, --time and --fps.
void add_animation_options(CLI::App& command, AnimationArguments& arguments);

// The course of a scene in time, frame by frame. Without an animation all frames are alike.
class Playback {
 public:
  // `scene`, with what was told about it, outlives the playback. Throws InputError, also where the scene has no
  // animation and something was told about one.
  Playback(const Scene& scene, const SceneArguments& scene_arguments, const CameraArguments& camera,
           const AnimationArguments& arguments);

  bool is_animated() const { return animation_.has_value(); }

  // Frame k is `--time` + k / `--fps` seconds after the animation's start; after its end the last pose is held. Cameras
  // of the scene move with their nodes, others are static. Throws InputError if something moves too far away.
  Moment frame(int index) const;

  // The same, where the animation begins anew after its end.
  Moment looped_frame(int index) const;

 private:
  SceneSnapshot world_at(double seconds) const;
  Moment moment_at(double seconds) const;
  Bounds bounds_of_all_moments() const;

  const Scene& scene_;
  std::string name_;  // of the scene, for messages
  CameraArguments camera_arguments_;
  std::optional<Animation> animation_;
  double start_ = 0.0;  // seconds
  double frames_per_second_ = 24.0;
  std::optional<WorldCamera> still_camera_;  // one that no node of the scene carries
};

}  // namespace lightwell
