// What `render` and `bench` are told about a technique, its options and the device it runs on.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/cli/render_methods.h"

namespace CLI {
class App;
}

namespace lightwell {

struct TechniqueArguments {
  std::string technique = "light-volume";
  std::string preset;
  std::string size = "512x512";
  std::map<std::string, std::string> options;  // those that were given, by name
  std::vector<std::string> assignments;        // --set
  std::string device;
  bool validation = false;
  std::string grid_bounds;
  std::vector<RenderMethod> methods = make_render_methods();
};

// Adds --technique, --preset, --set, --size, --device, --validation, --grid-bounds and every option of every technique
// that the command does not have yet; one of a technique that was not chosen is an error later.
void add_technique_options(CLI::App& command, TechniqueArguments& arguments);

// The technique that was chosen and all that was set for it, checked.
struct ChosenTechnique {
  const RenderMethod& method;
  std::string preset;
  std::vector<std::string> assignments;  // "name=value"
  std::optional<Bounds> grid_bounds;
};

// Throws InputError.
ChosenTechnique choose_technique(const TechniqueArguments& arguments);

// The job of a static scene: as `start` shows it. The scene outlives the job. Throws InputError.
RenderJob make_job(const TechniqueArguments& arguments, const ChosenTechnique& chosen, const Scene& scene,
                   const Moment& start);

}  // namespace lightwell
