// lightwell render: a scene and a technique in, pictures out.
#include <unistd.h>

#include <map>
#include <memory>

#include <CLI/CLI.hpp>

#include "apps/cli/commands.h"
#include "apps/cli/output.h"
#include "apps/cli/progress.h"
#include "apps/cli/render_methods.h"
#include "apps/cli/scene_arguments.h"
#include "apps/cli/text.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

struct RenderArguments {
  SceneArguments scene;
  CameraArguments camera;
  std::string technique = "path-tracer";
  std::string size = "512x512";
  std::string exposure = "1";
  std::string aovs;
  std::string output;
  std::map<std::string, std::string> technique_options;  // those that were given, by name
  std::vector<std::string> assignments;                  // --set
  std::vector<RenderMethod> methods = make_render_methods();
};

// A size that passed may still be more than the machine can hold.
void check_memory(const glm::ivec2& size) {
  constexpr double kBytesPerPixel = 19 * sizeof(float);  // of a Picture
  const double needed = kBytesPerPixel * size.x * size.y;
  const double available =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  constexpr double kGigabyte = 1e9;
  if (needed > 0.8 * available) {
    char cause[160];
    std::snprintf(cause, sizeof cause, "%dx%d pixels need %.0f GB of memory; this machine has %.0f", size.x, size.y,
                  needed / kGigabyte, available / kGigabyte);
    throw InputError("--size", cause);
  }
}

// Everything that can be wrong is found out before the long work starts.
void render(const RenderArguments& arguments) {
  const RenderMethod& method = find_render_method(arguments.methods, arguments.technique);
  for (const auto& [name, value] : arguments.technique_options) set_option(method.describe, name, value);
  for (const std::string& assignment : arguments.assignments) set_option(method.describe, assignment);
  const glm::ivec2 size = parse_size("--size", arguments.size);
  check_memory(size);
  const float exposure = parse_number("--exposure", arguments.exposure, 0.0f, 1e9f);
  const std::vector<Output> outputs = plan_outputs(arguments.output, arguments.aovs);

  const Scene scene = load_scene(arguments.scene);
  const SceneSnapshot snapshot = take_snapshot(scene);
  const WorldCamera camera = choose_camera(snapshot, arguments.camera);
  Picture picture;
  {
    Progress progress(method.name);
    picture = method.render({scene, snapshot, camera, size.x, size.y, [&](float done) { progress.update(done); }});
  }
  write_outputs(picture, outputs, exposure);
}

// Every technique's options are options of the command; one of a technique that was not chosen is an error later.
void add_technique_options(CLI::App& command, RenderArguments& arguments) {
  std::string help;
  for (const RenderMethod& method : arguments.methods) {
    help += "Options of --technique " + method.name + ":\n" + options_as_help(method.describe);
    for (const OptionText& option : list_options(method.describe)) {
      const std::string flag = "--" + option.name;
      if (command.get_option_no_throw(flag)) continue;
      const auto keep = [&arguments, name = option.name](const std::string& value) {
        arguments.technique_options[name] = value;
      };
      command.add_option_function<std::string>(flag, keep)->group("");  // the footer shows it
    }
  }
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
  command->add_option("--technique", arguments->technique, technique_names(arguments->methods) + " (path-tracer)");
  command->add_option("--set", arguments->assignments, "Set an option of the technique: name=value")
      ->allow_extra_args(false);
  command->add_option("--size", arguments->size, "WIDTHxHEIGHT in pixels (512x512)");
  command->add_option("--exposure", arguments->exposure, "Factor on radiance in PNG files (1)");
  command->add_option("--aov", arguments->aovs, "More files x.NAME.exr beside x.exr, by comma: " + aov_names());
  command->add_option("-o,--output", arguments->output, "File to write: .exr (linear) or .png (tone-mapped)")
      ->required();
  add_technique_options(*command, *arguments);
  command->callback([arguments] { render(*arguments); });
}

}  // namespace lightwell
