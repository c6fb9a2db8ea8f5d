// lightwell render: a scene and a technique in, pictures out.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

#include "apps/cli/animation_arguments.h"
#include "apps/cli/commands.h"
#include "apps/cli/memory_check.h"
#include "apps/cli/output.h"
#include "apps/cli/progress.h"
#include "apps/cli/render_methods.h"
#include "apps/cli/scene_arguments.h"
#include "apps/cli/statistics.h"
#include "apps/cli/technique_arguments.h"
#include "apps/cli/text.h"
#include "core/files.h"
#include "core/log.h"
#include "lightwell/error.h"
#include "lightwell/metrics.h"

namespace lightwell {

namespace {

struct RenderArguments {
  SceneArguments scene;
  CameraArguments camera;
  AnimationArguments animation;
  TechniqueArguments technique;
  std::string exposure = "1";
  std::string aovs;
  std::string output;
  std::string debug_views;
  std::string statistics;  // "", "text" or "json"
};

void print_statistics(const RenderArguments& arguments, const RenderResult& result) {
  if (arguments.statistics.empty()) return;
  const bool json = arguments.statistics == "json";
  std::string text;
  if (result.photon_mapper)
    text = json ? statistics_as_json(*result.photon_mapper) : statistics_as_text(*result.photon_mapper);
  else if (result.statistics)
    text = json ? statistics_as_json(*result.statistics, result.device)
                : statistics_as_text(*result.statistics, result.device);
  std::printf("%s\n", text.c_str());
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

// Positions relative to `origin` in the file's coordinates; where there is no surface they are 0 and stay so.
Image moved_back(Image positions, const glm::dvec3& origin) {
  std::vector<float>& p = positions.pixels;
  for (std::size_t i = 0; i + 2 < p.size(); i += 3) {
    if (p[i] == 0.0f && p[i + 1] == 0.0f && p[i + 2] == 0.0f) continue;
    for (std::size_t c = 0; c < 3; ++c) p[i + c] = static_cast<float>(p[i + c] + origin[static_cast<int>(c)]);
  }
  return positions;
}

void write_debug_images(const RenderResult& result, const glm::dvec3& origin, const std::string& output) {
  for (const auto& [name, seen] : result.debug_images) {
    const std::string file = debug_file(output, name);
    const Image image = name == "position" || name.ends_with("-position") ? moved_back(seen, origin) : seen;
    if (std::filesystem::path(output).extension() == ".exr")
      save_exr(file, image);
    else
      save_png(file, tone_map(image, 1.0f));
  }
}

// Names in --aov that are no part of every picture are the technique's own intermediate images.
void divide_aovs(RenderArguments& arguments) {
  std::string parts;
  const auto add = [](std::string& list, const std::string& name) { list += (list.empty() ? "" : ",") + name; };
  if (!arguments.aovs.empty())
    for (const std::string& name : split(arguments.aovs, ',')) add(is_aov(name) ? parts : arguments.debug_views, name);
  arguments.aovs = parts;
}

// Exporters leave out lights unless they are told not to.
void warn_of_darkness(const Picture& picture) {
  const std::vector<float>& pixels = picture.combined.pixels;
  if (std::all_of(pixels.begin(), pixels.end(), [](float value) { return value == 0.0f; }))
    log_warning("the picture is black: --light, --sun and --env add light (lightwell info says what there is)");
}

bool wants_variance(const RenderArguments& arguments) {
  if (arguments.aovs.empty()) return false;
  const std::vector<std::string> aovs = split(arguments.aovs, ',');
  return std::find(aovs.begin(), aovs.end(), "variance") != aovs.end();
}

// What a method cannot give is not left out in silence.
void check_method_arguments(const RenderArguments& arguments, const RenderMethod& method) {
  if (!arguments.statistics.empty() && !method.has_statistics)
    throw InputError("--stats", "--technique " + method.name + " has none");
  if (!arguments.debug_views.empty() && !method.on_gpu)
    throw InputError("--debug-views", "--technique " + method.name + " has none");
  if (!method.has_variance && wants_variance(arguments))
    throw InputError("--aov", "--technique " + method.name + " has no variance");
}

// Everything that can be wrong is found out before the long work starts.
void render(RenderArguments arguments) {
  const ChosenTechnique chosen = choose_technique(arguments.technique);
  if (chosen.method.on_gpu) divide_aovs(arguments);
  check_method_arguments(arguments, chosen.method);
  check_picture_memory(parse_size("--size", arguments.technique.size));
  const float exposure = parse_number("--exposure", arguments.exposure, 0.0f, 1e9f);
  const FrameNames frame_names(arguments.output);
  std::vector<std::string> debug_views;
  if (!arguments.debug_views.empty()) debug_views = split(arguments.debug_views, ',');
  check_debug_files(debug_views, plan_outputs(frame_names.name(0), arguments.aovs));

  const Scene scene = load_scene(arguments.scene);
  const Playback playback(scene, arguments.scene, arguments.camera, arguments.animation);
  RenderJob job = make_job(arguments.technique, chosen, scene, playback.frame(0));
  if (playback.is_animated()) job.play = [&](int frame) { return playback.frame(frame); };
  job.gpu.debug_views = debug_views;
  job.variance = wants_variance(arguments);
  const auto write = [&](int frame, const RenderResult& result) {
    const std::string name = frame_names.name(frame);
    write_outputs(result.picture, plan_outputs(name, arguments.aovs), exposure);
    write_debug_images(result, scene.origin, name);
  };
  if (frame_names.is_pattern()) job.each_frame = write;
  RenderResult result;
  {
    Progress progress(chosen.method.name);
    job.progress = [&](float done) { progress.update(done); };
    result = chosen.method.render(job);
  }
  if (!frame_names.is_pattern()) write(0, result);
  warn_of_darkness(result.picture);
  print_statistics(arguments, result);
}

}  // namespace

void add_render_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("render", "Render a scene to EXR or PNG files");
  const auto arguments = std::make_shared<RenderArguments>();
  add_scene_options(*command, arguments->scene);
  add_camera_options(*command, arguments->camera);
  add_animation_options(*command, arguments->animation);
  command->add_option("--exposure", arguments->exposure, "Factor on radiance in PNG files (1)");
  command->add_option("--aov", arguments->aovs,
                      "More files x.NAME.exr beside x.exr, by comma: " + aov_names() + ", or what --debug-views takes");
  command->add_option("-o,--output", arguments->output, "File to write: .exr (linear) or .png (tone-mapped)")
      ->required();
  command->add_option("--debug-views", arguments->debug_views, "Write these intermediate images as well, by comma");
  command->add_option("--stats", arguments->statistics, "Print times by pass, memory and counts: text or json")
      ->check(CLI::IsMember({"text", "json"}));
  add_technique_options(*command, arguments->technique);
  command->callback([arguments] { render(*arguments); });
}

}  // namespace lightwell
