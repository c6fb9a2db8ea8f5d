// lightwell bench: what frames cost, one by one, with nothing brought back from the device.
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/animation_arguments.h"
#include "apps/cli/bench_flight.h"
#include "apps/cli/bench_frames.h"
#include "apps/cli/bench_many_light.h"
#include "apps/cli/bench_photon_splatting.h"
#include "apps/cli/bench_ray_traced_voxels.h"
#include "apps/cli/commands.h"
#include "apps/cli/scene_arguments.h"
#include "apps/cli/technique_arguments.h"
#include "apps/cli/text.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

using Json = nlohmann::ordered_json;

struct BenchArguments {
  SceneArguments scene;
  CameraArguments camera;
  AnimationArguments animation;
  TechniqueArguments technique;
  std::string frames = "30", warm_up = "3";
  std::string cut = "none";
  bool move_lights = false;
  bool move_light = false;
  bool animate = false;
  bool json = false;
};

BenchRun bench_run(const BenchArguments& arguments, std::size_t lights) {
  BenchRun run;
  run.frames = parse_integer("--frames", arguments.frames, 1, kMaximumBenchFrames);
  run.warm_up = parse_integer("--warm-up", arguments.warm_up, 0, kMaximumBenchFrames);
  if (arguments.cut == "first") run.cut = BenchCut::kFirst;
  if (arguments.cut == "every") run.cut = BenchCut::kEvery;
  if (arguments.move_light) run.moving_lights = 1;
  if (arguments.move_lights) run.moving_lights = lights;
  return run;
}

void print_row(const std::string& name, const Json& ms, const std::string& more = "") {
  std::printf("%-32.32s %9.3f %9.3f %9.3f %9.3f  %s\n", name.c_str(), ms["min"].get<double>(),
              ms["median"].get<double>(), ms["mean"].get<double>(), ms["max"].get<double>(), more.c_str());
}

void print_table(const Json& json) {
  std::printf("%s (%s): %d frames, %.1f MiB\n", json["device"].get<std::string>().c_str(),
              json["driver"].get<std::string>().c_str(), json["frames"].get<int>(),
              json["memory_bytes"].get<double>() / (1 << 20));
  std::printf("%-32s %9s %9s %9s %9s  %s\n", "ms", "min", "median", "mean", "max", "count");
  print_row("frame, wall", json["wall_ms"]);
  print_row("frame, device", json["gpu_ms"]);
  for (const Json& pass : json["passes"])
    print_row("  " + pass["name"].get<std::string>(), pass["ms"], std::to_string(pass["count"].get<int>()));
  std::printf("%-32s %9s\n", "memory", "MiB");
  for (const Json& entry : json["memory"])
    std::printf("  %-30.30s %9.3f\n", entry["name"].get<std::string>().c_str(),
                entry["bytes"].get<double>() / (1 << 20));
}

void bench(const BenchArguments& arguments) {
  const ChosenTechnique chosen = choose_technique(arguments.technique);
  if (!chosen.method.on_gpu) throw InputError("--technique", chosen.method.name + " runs no frames on a device");
  const Scene scene = load_scene(arguments.scene);
  const Playback playback(scene, arguments.scene, arguments.camera, arguments.animation);
  RenderJob job = make_job(arguments.technique, chosen, scene, playback.looped_frame(0));
  if (arguments.animate) {
    if (!playback.is_animated())
      throw InputError("--animate", "the scene " + arguments.scene.scene + " has no animation");
    job.play = [&](int frame) { return playback.looped_frame(frame); };
  }
  const BenchRun run = bench_run(arguments, job.start.world.lights.size());
  const Json json = bench_as_json(run_frames(job, run, chosen.method.name));
  if (arguments.json)
    std::printf("%s\n", json.dump(2).c_str());
  else
    print_table(json);
}

}  // namespace

void add_bench_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("bench", "Measure what frames cost: time by pass, wall time, memory");
  const auto arguments = std::make_shared<BenchArguments>();
  add_scene_options(*command, arguments->scene);
  CLI::Option* scene = command->get_option("SCENE")->required(false);  // published tables choose their own
  add_camera_options(*command, arguments->camera);
  add_animation_options(*command, arguments->animation);
  command->add_option("--frames", arguments->frames, "Frames that are measured (30)");
  command->add_option("--warm-up", arguments->warm_up, "Frames before, not measured: drivers compile in them (3)");
  command->add_flag("--move-lights", arguments->move_lights,
                    "Lights circle by 5 % of the scene's diagonal, suns tilt: one round in 30 frames");
  command->add_flag("--move-light", arguments->move_light, "The same with the first light alone");
  command->add_flag("--animate", arguments->animate,
                    "Play the animation over and over: each frame is 1 / --fps later than the one before");
  command
      ->add_option("--cut", arguments->cut,
                   "Which measured frames start from nothing, as after a camera cut: none, first or every (none)")
      ->check(CLI::IsMember({"none", "first", "every"}));
  command->add_flag("--json", arguments->json, "Print JSON");
  add_technique_options(*command, arguments->technique);
  add_bench_flight_command(*command);
  add_bench_many_light_command(*command);
  add_bench_photon_splatting_command(*command);
  add_bench_ray_traced_voxels_command(*command);
  command->callback([arguments, command, scene] {
    if (!command->get_subcommands().empty()) return;
    if (scene->empty()) throw CLI::RequiredError("SCENE");
    bench(*arguments);
  });
}

}  // namespace lightwell
