// lightwell render: a scene and a technique in, pictures out.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "apps/cli/commands.h"
#include "apps/cli/output.h"
#include "apps/cli/progress.h"
#include "apps/cli/render_methods.h"
#include "apps/cli/scene_arguments.h"
#include "apps/cli/statistics.h"
#include "apps/cli/text.h"
#include "core/files.h"
#include "core/join.h"
#include "core/log.h"
#include "lightwell/error.h"
#include "lightwell/metrics.h"

namespace lightwell {

namespace {

struct RenderArguments {
  SceneArguments scene;
  CameraArguments camera;
  std::string technique = "light-volume";
  std::string preset;
  std::string size = "512x512";
  std::string exposure = "1";
  std::string aovs;
  std::string output;
  std::map<std::string, std::string> technique_options;  // those that were given, by name
  std::vector<std::string> assignments;                  // --set
  std::string device;
  bool validation = false;
  std::string grid_bounds;
  std::string debug_views;
  std::string statistics;  // "", "text" or "json"
  std::vector<RenderMethod> methods = make_render_methods();
};

// A size that passed may still be more than the machine can hold.
void check_memory(const glm::ivec2& size) {
  constexpr double kBytesPerPixel = 19 * sizeof(float);  // of a Picture
  const double needed = kBytesPerPixel * size.x * size.y;
  const double available =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  constexpr double kGigabyte = 1e9;
  constexpr double kUsable = 0.8;
  if (needed > kUsable * available) {
    char cause[200];
    std::snprintf(cause, sizeof cause, "%dx%d pixels need %.0f GB of memory; of this machine's %.0f, %.0f can be used",
                  size.x, size.y, needed / kGigabyte, available / kGigabyte, kUsable * available / kGigabyte);
    throw InputError("--size", cause);
  }
}

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
  constexpr float kFarthest = 1e9f;  // as for scenes
  for (const glm::vec3& corner_point : {bounds.minimum, bounds.maximum})
    if (glm::any(glm::greaterThan(glm::abs(corner_point), glm::vec3(kFarthest))))
      throw InputError("--grid-bounds", "'" + text + "' reaches farther than 1e9 metres");
  return bounds;
}

bool overlap(const Bounds& a, const Bounds& b) {
  return glm::all(glm::lessThanEqual(a.minimum, b.maximum)) && glm::all(glm::lessThanEqual(b.minimum, a.maximum));
}

// An option of another technique or preset is one of the command, too, so the error says whose it is not.
void require_option(const RenderMethod& method, const std::string& preset, const DescribeOptions& options,
                    const std::string& name) {
  std::vector<std::string> flags;
  for (const OptionText& option : list_options(options)) {
    if (option.name == name) return;
    flags.push_back("--" + option.name);
  }
  throw InputError("--" + name, "not an option of --technique " + method.name +
                                    (preset.empty() ? "" : " --preset " + preset) + ", which has " + join(flags));
}

// All that was set by name, checked against the method's options.
std::vector<std::string> checked_assignments(const RenderArguments& arguments, const RenderMethod& method,
                                             const std::string& preset) {
  std::vector<std::string> all;
  for (const auto& [name, value] : arguments.technique_options) all.push_back(name + "=" + value);
  all.insert(all.end(), arguments.assignments.begin(), arguments.assignments.end());
  const DescribeOptions options = method.options(preset);
  for (const std::string& assignment : all) {
    require_option(method, preset, options, assignment.substr(0, assignment.find('=')));
    set_option(options, assignment);
  }
  return all;
}

void print_statistics(const RenderArguments& arguments, const RenderResult& result) {
  if (arguments.statistics.empty() || !result.statistics) return;
  std::printf("%s\n", (arguments.statistics == "json" ? statistics_as_json(*result.statistics, result.device)
                                                      : statistics_as_text(*result.statistics, result.device))
                          .c_str());
}

std::string debug_file(const std::string& output, const std::string& view) {
  const std::filesystem::path path(output);
  return std::filesystem::path(path).replace_extension(view + path.extension().string()).string();
}

// Debug views are named like AOVs; where both are asked for, neither may overwrite the other.
void check_debug_files(const std::vector<std::string>& views, const std::vector<Output>& outputs) {
  for (const std::string& view : views) {
    const std::string file = debug_file(outputs.front().path, view);
    for (const Output& output : outputs)
      if (output.path == file) throw InputError("--debug-views", "'" + view + "' and --aov would both write " + file);
    check_writable(file);
  }
}

void write_debug_images(const RenderResult& result, const std::string& output) {
  for (const auto& [name, image] : result.debug_images) {
    const std::string file = debug_file(output, name);
    if (std::filesystem::path(output).extension() == ".exr")
      save_exr(file, image);
    else
      save_png(file, tone_map(image, 1.0f));
  }
}

// What only techniques on the GPU can give is not left out in silence.
void check_gpu_arguments(const RenderArguments& arguments, const RenderMethod& method) {
  if (method.on_gpu) return;
  if (!arguments.statistics.empty()) throw InputError("--stats", "--technique " + method.name + " has none");
  if (!arguments.debug_views.empty()) throw InputError("--debug-views", "--technique " + method.name + " has none");
}

// Everything that can be wrong is found out before the long work starts.
void render(const RenderArguments& arguments) {
  const RenderMethod& method = find_render_method(arguments.methods, arguments.technique);
  const std::string preset = find_preset(method, arguments.preset);
  const std::vector<std::string> assignments = checked_assignments(arguments, method, preset);
  check_gpu_arguments(arguments, method);
  const glm::ivec2 size = parse_size("--size", arguments.size);
  check_memory(size);
  const float exposure = parse_number("--exposure", arguments.exposure, 0.0f, 1e9f);
  const FrameNames frame_names(arguments.output);
  std::vector<std::string> debug_views;
  if (!arguments.debug_views.empty()) debug_views = split(arguments.debug_views, ',');
  check_debug_files(debug_views, plan_outputs(frame_names.name(0), arguments.aovs));
  std::optional<Bounds> grid_bounds;
  if (!arguments.grid_bounds.empty()) grid_bounds = parse_bounds(arguments.grid_bounds);

  const Scene scene = load_scene(arguments.scene);
  const SceneSnapshot snapshot = take_snapshot(scene);
  RenderJob job{scene, snapshot, choose_camera(snapshot, arguments.camera), size.x, size.y, preset, assignments};
  job.gpu.device = arguments.device;
  job.gpu.validation = arguments.validation;
  job.gpu.grid_bounds = grid_bounds;
  job.gpu.debug_views = debug_views;
  if (grid_bounds && !overlap(*grid_bounds, snapshot.bounds))
    log_warning("--grid-bounds: nothing of the scene is inside");
  const auto write = [&](int frame, const RenderResult& result) {
    const std::string name = frame_names.name(frame);
    write_outputs(result.picture, plan_outputs(name, arguments.aovs), exposure);
    write_debug_images(result, name);
  };
  if (frame_names.is_pattern()) job.each_frame = write;
  RenderResult result;
  {
    Progress progress(method.name);
    job.progress = [&](float done) { progress.update(done); };
    result = method.render(job);
  }
  if (!frame_names.is_pattern()) write(0, result);
  print_statistics(arguments, result);
}

// Options of techniques are shown in the footer, by technique and preset.
constexpr const char* kTechniqueGroup = "Technique";

class RenderHelp : public CLI::Formatter {
 public:
  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override {
    if (group == kTechniqueGroup) return "";
    return CLI::Formatter::make_group(std::move(group), is_positional, std::move(options));
  }
};

void add_flags(CLI::App& command, RenderArguments& arguments, const DescribeOptions& options) {
  for (const OptionText& option : list_options(options)) {
    const std::string flag = "--" + option.name;
    if (command.get_option_no_throw(flag)) continue;
    const auto keep = [&arguments, name = option.name](const std::string& value) {
      arguments.technique_options[name] = value;
    };
    command.add_option_function<std::string>(flag, keep)->group(kTechniqueGroup);
  }
}

// Every technique's options are options of the command; one of a technique that was not chosen is an error later.
void add_technique_options(CLI::App& command, RenderArguments& arguments) {
  std::string help;
  for (const RenderMethod& method : arguments.methods) {
    for (const std::string& preset : method.presets.empty() ? std::vector<std::string>{""} : method.presets) {
      help += "Options of --technique " + method.name + (preset.empty() ? "" : " --preset " + preset) + ":\n" +
              options_as_help(method.options(preset));
      add_flags(command, arguments, method.options(preset));
    }
  }
  command.formatter(std::make_shared<RenderHelp>());
  command.footer(help);
}

std::string technique_names(const std::vector<RenderMethod>& methods) {
  std::vector<std::string> names;
  for (const RenderMethod& method : methods) names.push_back(method.name);
  return join(names);
}

}  // namespace

void add_render_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("render", "Render a scene to EXR or PNG files");
  const auto arguments = std::make_shared<RenderArguments>();
  add_scene_options(*command, arguments->scene);
  add_camera_options(*command, arguments->camera);
  command->add_option("--technique", arguments->technique, technique_names(arguments->methods) + " (light-volume)");
  command->add_option("--preset", arguments->preset, "A named set of the technique's options (best)");
  command->add_option("--set", arguments->assignments, "Set an option of the technique: name=value")
      ->allow_extra_args(false);
  command->add_option("--size", arguments->size, "WIDTHxHEIGHT in pixels (512x512)");
  command->add_option("--exposure", arguments->exposure, "Factor on radiance in PNG files (1)");
  command->add_option("--aov", arguments->aovs, "More files x.NAME.exr beside x.exr, by comma: " + aov_names());
  command->add_option("-o,--output", arguments->output, "File to write: .exr (linear) or .png (tone-mapped)")
      ->required();
  command->add_option("--device", arguments->device, "best, cpu, a part of a device's name or its number (best)");
  command->add_flag("--validation", arguments->validation, "Check every Vulkan call; any message is an error");
  command->add_option("--grid-bounds", arguments->grid_bounds, "x,y,z,x,y,z in metres: what grids cover (the scene)");
  command->add_option("--debug-views", arguments->debug_views, "Write these intermediate images as well, by comma");
  command->add_option("--stats", arguments->statistics, "Print times by pass, memory and counts: text or json")
      ->check(CLI::IsMember({"text", "json"}));
  add_technique_options(*command, *arguments);
  command->callback([arguments] { render(*arguments); });
}

}  // namespace lightwell
