#include "apps/cli/technique_arguments.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "apps/cli/text.h"
#include "core/log.h"
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
  for (const glm::vec3& point : {bounds.minimum, bounds.maximum})
    if (glm::any(glm::greaterThan(glm::abs(point), glm::vec3(kMaxCoordinate))))
      throw InputError("--grid-bounds", "'" + text + "' reaches farther than 1e9 metres");
  return bounds;
}

bool overlap(const Bounds& a, const Bounds& b) {
  return glm::all(glm::lessThanEqual(a.minimum, b.maximum)) && glm::all(glm::lessThanEqual(b.minimum, a.maximum));
}

// Options of techniques are shown in the footer, by technique and preset.
constexpr const char* kTechniqueGroup = "Technique";

class TechniqueHelp : public CLI::Formatter {
 public:
  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override {
    if (group == kTechniqueGroup) return "";
    return CLI::Formatter::make_group(std::move(group), is_positional, std::move(options));
  }
};

void add_flags(CLI::App& command, TechniqueArguments& arguments, const DescribeOptions& options) {
  for (const OptionText& option : list_options(options)) {
    const std::string flag = "--" + option.name;
    if (command.get_option_no_throw(flag)) continue;
    const auto keep = [&arguments, name = option.name](const std::string& value) { arguments.options[name] = value; };
    command.add_option_function<std::string>(flag, keep)->group(kTechniqueGroup);
  }
}

// Returns the help on them.
std::string add_all_flags(CLI::App& command, TechniqueArguments& arguments) {
  std::string help = "Options of every --technique on the GPU:\n" + options_as_help(shared_options());
  add_flags(command, arguments, shared_options());
  for (const RenderMethod& method : arguments.methods) {
    for (const std::string& preset : method.presets.empty() ? std::vector<std::string>{""} : method.presets) {
      const DescribeOptions options = method.own_options(preset);
      if (list_options(options).empty()) continue;
      help += "Options of --technique " + method.name + (preset.empty() ? "" : " --preset " + preset) + ":\n" +
              options_as_help(options);
      add_flags(command, arguments, options);
    }
  }
  return help;
}

// An option of another technique or preset is one of the command, too, so the error says whose it is not.
void require_option(const ChosenTechnique& chosen, const DescribeOptions& options, const std::string& assignment) {
  const std::string name = assignment.substr(0, assignment.find('='));
  std::vector<std::string> flags;
  for (const OptionText& option : list_options(options)) {
    if (option.name == name) return;
    flags.push_back("--" + option.name);
  }
  const std::string preset = chosen.preset.empty() ? "" : " --preset " + chosen.preset;
  throw InputError("--" + name,
                   "not an option of --technique " + chosen.method.name + preset + ", which has " + join(flags));
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
  command.add_option("--grid-bounds", arguments.grid_bounds,
                     "x,y,z,x,y,z in metres: what grids and shadow maps of suns cover (the scene)");
  command.formatter(std::make_shared<TechniqueHelp>());
  command.footer(add_all_flags(command, arguments));
}

ChosenTechnique choose_technique(const TechniqueArguments& arguments) {
  const RenderMethod& method = find_render_method(arguments.methods, arguments.technique);
  ChosenTechnique chosen{method, find_preset(method, arguments.preset), {}, {}};
  for (const auto& [name, value] : arguments.options) chosen.assignments.push_back(name + "=" + value);
  chosen.assignments.insert(chosen.assignments.end(), arguments.assignments.begin(), arguments.assignments.end());
  const DescribeOptions options = all_options(method, chosen.preset);
  for (const std::string& assignment : chosen.assignments) {
    if (assignment.find('=') != std::string::npos && !assignment.starts_with('='))
      require_option(chosen, options, assignment);
    set_option(options, assignment);
  }
  if (!arguments.grid_bounds.empty()) chosen.grid_bounds = parse_bounds(arguments.grid_bounds);
  return chosen;
}

RenderJob make_job(const TechniqueArguments& arguments, const ChosenTechnique& chosen, const Scene& scene,
                   const Moment& start) {
  const glm::ivec2 size = parse_size("--size", arguments.size);
  RenderJob job{scene, start, {}, size.x, size.y, chosen.preset, chosen.assignments};
  job.gpu.device = arguments.device;
  job.gpu.validation = arguments.validation;
  if (chosen.grid_bounds) {
    const auto moved = [&](const glm::vec3& point) { return glm::vec3(glm::dvec3(point) - scene.origin); };
    job.gpu.grid_bounds = Bounds{moved(chosen.grid_bounds->minimum), moved(chosen.grid_bounds->maximum)};
  }
  if (job.gpu.grid_bounds && !overlap(*job.gpu.grid_bounds, start.world.bounds))
    log_warning("--grid-bounds: nothing of the scene is inside");
  return job;
}

}  // namespace lightwell
