#include "apps/cli/technique_arguments.h"

#include <CLI/CLI.hpp>

#include "apps/cli/text.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

// "x,y,z,x,y,z": the lower and the upper corner.
Bounds parse_bounds(const std::string& text) {
  const std::vector<std::string> numbers = split(text, ',');
  if (numbers.size() != 6) throw InputError("--grid-bounds", "'" + text + "' is not x,y,z,x,y,z in metres");
  const auto corner = [&](std::size_t i) {
    return parse_vector("--grid-bounds", numbers[i] + "," + numbers[i + 1] + "," + numbers[i + 2]);
  };
  const Bounds bounds{corner(0), corner(3)};
  if (!(bounds.minimum.x < bounds.maximum.x && bounds.minimum.y < bounds.maximum.y &&
        bounds.minimum.z < bounds.maximum.z))
    throw InputError("--grid-bounds", "'" + text + "' is empty: the upper corner comes last");
  return bounds;
}

void add_flags(CLI::App& command, TechniqueArguments& arguments, const DescribeOptions& options) {
  for (const OptionText& option : list_options(options)) {
    const std::string flag = "--" + option.name;
    if (command.get_option_no_throw(flag)) continue;
    const auto keep = [&arguments, name = option.name](const std::string& value) { arguments.options[name] = value; };
    command.add_option_function<std::string>(flag, keep)->group("");  // the footer shows it
  }
}

// Returns the help on them.
std::string add_all_flags(CLI::App& command, TechniqueArguments& arguments) {
  std::string help;
  for (const RenderMethod& method : arguments.methods) {
    for (const std::string& preset : method.presets.empty() ? std::vector<std::string>{""} : method.presets) {
      help += "Options of --technique " + method.name + (preset.empty() ? "" : " --preset " + preset) + ":\n" +
              options_as_help(method.options(preset));
      add_flags(command, arguments, method.options(preset));
    }
  }
  return help;
}

std::string technique_names(const std::vector<RenderMethod>& methods) {
  std::vector<std::string> names;
  for (const RenderMethod& method : methods) names.push_back(method.name);
  return join(names);
}

}  // namespace

void add_technique_options(CLI::App& command, TechniqueArguments& arguments) {
  command.add_option("--technique", arguments.technique, technique_names(arguments.methods) + " (light-volume)");
  command.add_option("--preset", arguments.preset, "A named set of the technique's options (best)");
  command.add_option("--set", arguments.assignments, "Set an option of the technique: name=value")
      ->allow_extra_args(false);
  command.add_option("--size", arguments.size, "WIDTHxHEIGHT in pixels (512x512)");
  command.add_option("--device", arguments.device, "best, cpu, a part of a device's name or its number (best)");
  command.add_flag("--validation", arguments.validation, "Check every Vulkan call; any message is an error");
  command.add_option("--grid-bounds", arguments.grid_bounds, "x,y,z,x,y,z in metres: what grids cover (the scene)");
  command.footer(add_all_flags(command, arguments));
}

ChosenTechnique choose_technique(const TechniqueArguments& arguments) {
  const RenderMethod& method = find_render_method(arguments.methods, arguments.technique);
  ChosenTechnique chosen{method, find_preset(method, arguments.preset), {}};
  for (const auto& [name, value] : arguments.options) chosen.assignments.push_back(name + "=" + value);
  chosen.assignments.insert(chosen.assignments.end(), arguments.assignments.begin(), arguments.assignments.end());
  const DescribeOptions options = method.options(chosen.preset);
  for (const std::string& assignment : chosen.assignments) set_option(options, assignment);
  return chosen;
}

RenderJob make_job(const TechniqueArguments& arguments, const ChosenTechnique& chosen, const Scene& scene,
                   const SceneSnapshot& snapshot, const WorldCamera& camera) {
  const glm::ivec2 size = parse_size("--size", arguments.size);
  RenderJob job{scene, snapshot, camera, size.x, size.y, chosen.preset, chosen.assignments};
  job.gpu.device = arguments.device;
  job.gpu.validation = arguments.validation;
  if (!arguments.grid_bounds.empty()) job.gpu.grid_bounds = parse_bounds(arguments.grid_bounds);
  return job;
}

}  // namespace lightwell
