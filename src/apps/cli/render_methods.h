// Everything that turns a scene into a Picture, by the name that --technique takes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/option_set.h"
#include "lightwell/picture.h"
#include "lightwell/scene.h"

namespace lightwell {

struct RenderJob {
  const Scene& scene;
  const SceneSnapshot& snapshot;
  WorldCamera camera;
  int width = 0;
  int height = 0;
  std::function<void(float)> progress;  // part done in (0,1]
};

struct RenderMethod {
  std::string name;
  std::string help;          // one sentence
  DescribeOptions describe;  // its options; they keep what they are set to
  std::function<Picture(const RenderJob&)> render;
};

// All of them, each with its options at their defaults.
std::vector<RenderMethod> make_render_methods();

// Throws InputError listing the names.
const RenderMethod& find_render_method(const std::vector<RenderMethod>& methods, const std::string& name);

}  // namespace lightwell
