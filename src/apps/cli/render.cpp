// lightwell render: a scene and a technique in, pictures out.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

#include "apps/cli/commands.h"
#include "apps/cli/output.h"
#include "apps/cli/progress.h"
#include "apps/cli/render_methods.h"
#include "apps/cli/scene_arguments.h"
#include "apps/cli/statistics.h"
#include "apps/cli/technique_arguments.h"
#include "apps/cli/text.h"
#include "core/files.h"
#include "lightwell/error.h"
#include "lightwell/metrics.h"

namespace lightwell {

namespace {

struct RenderArguments {
  SceneArguments scene;
  CameraArguments camera;
  TechniqueArguments technique;
  std::string exposure = "1";
  std::string aovs;
  std::string output;
  std::string debug_views;
  std::string statistics;  // "", "text" or "json"
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

void print_statistics(const RenderArguments& arguments, const RenderResult& result) {
  if (arguments.statistics.empty() || !result.statistics) return;
  std::printf("%s\n", (arguments.statistics == "json" ? statistics_as_json(*result.statistics, result.device)
                                                      : statistics_as_text(*result.statistics, result.device))
                          .c_str());
}

void write_debug_images(const RenderResult& result, const std::string& output) {
  const std::filesystem::path path(output);
  for (const auto& [name, image] : result.debug_images) {
    std::filesystem::path file = path;
    file.replace_extension("." + name + path.extension().string());
    if (path.extension() == ".exr")
      save_exr(file.string(), image);
    else
      save_png(file.string(), tone_map(image, 1.0f));
  }
}

// Everything that can be wrong is found out before the long work starts.
void render(const RenderArguments& arguments) {
  const ChosenTechnique chosen = choose_technique(arguments.technique);
  check_memory(parse_size("--size", arguments.technique.size));
  const float exposure = parse_number("--exposure", arguments.exposure, 0.0f, 1e9f);
  const FrameNames frame_names(arguments.output);
  const std::vector<Output> outputs = plan_outputs(frame_names.name(0), arguments.aovs);

  const Scene scene = load_scene(arguments.scene);
  const SceneSnapshot snapshot = take_snapshot(scene);
  RenderJob job = make_job(arguments.technique, chosen, scene, snapshot, choose_camera(snapshot, arguments.camera));
  if (!arguments.debug_views.empty()) job.gpu.debug_views = split(arguments.debug_views, ',');
  if (frame_names.is_pattern())
    job.each_frame = [&](int frame, const Picture& picture) {
      write_outputs(picture, plan_outputs(frame_names.name(frame), arguments.aovs), exposure);
    };
  RenderResult result;
  {
    Progress progress(chosen.method.name);
    job.progress = [&](float done) { progress.update(done); };
    result = chosen.method.render(job);
  }
  if (!frame_names.is_pattern()) write_outputs(result.picture, outputs, exposure);
  write_debug_images(result, frame_names.name(0));
  print_statistics(arguments, result);
}

}  // namespace

void add_render_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("render", "Render a scene to EXR or PNG files");
  const auto arguments = std::make_shared<RenderArguments>();
  add_scene_options(*command, arguments->scene);
  add_camera_options(*command, arguments->camera);
  command->add_option("--exposure", arguments->exposure, "Factor on radiance in PNG files (1)");
  command->add_option("--aov", arguments->aovs, "More files x.NAME.exr beside x.exr, by comma: " + aov_names());
  command->add_option("-o,--output", arguments->output, "File to write: .exr (linear) or .png (tone-mapped)")
      ->required();
  command->add_option("--debug-views", arguments->debug_views, "Write these intermediate images as well, by comma");
  command->add_option("--stats", arguments->statistics, "Print times by pass, memory and counts: text or json")
      ->check(CLI::IsMember({"text", "json"}));
  add_technique_options(*command, arguments->technique);
  command->callback([arguments] { render(*arguments); });
}

}  // namespace lightwell
