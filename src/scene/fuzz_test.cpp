// Random damage to small valid files: loading them succeeds or throws InputError, nothing else, in bounded time and
// memory.
//
// Variables of the environment: LIGHTWELL_FUZZ_SECONDS (0.25) for each format, LIGHTWELL_FUZZ_FILES ends a format after
// so many files, LIGHTWELL_FUZZ_SEED (1) the sequence; LIGHTWELL_FUZZ_PROGRAM, the command line's program: it loads the
// files, a process each, instead of this one. If the process dies, the file that did it stays in the folder that was
// printed.
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>

#include <gtest/gtest.h>

#include "core/log.h"
#include "scene/fuzz_mutator.h"
#include "scene/fuzz_seeds.h"
#include "scene/light_spec.h"
#include "scene/pose.h"

namespace lightwell {
namespace {

using namespace test;

constexpr double kMaxSeconds = 2.0;  // of processors' time for one file; other work of the machine does not count
constexpr double kMaxWait = 20.0;
constexpr double kMaxBytes = 1e9;

bool is_environment(const std::string& path) {
  return path.ends_with(".hdr") || path.ends_with(".exr");
}

// Whatever a valid scene's animations do, its vertices come out somewhere near or are refused.
void play(const Scene& scene) {
  for (const Animation& animation : scene.animations)
    for (const float seconds : {-1.0f, 0.25f, 0.5f * animation_end(animation), 1e30f}) {
      const SceneSnapshot snapshot = take_snapshot(scene, animate_nodes(scene, animation, seconds));
      try {
        validate(snapshot, "pose");
      } catch (const InputError&) {
        continue;
      }
      for (const MeshInstance& instance : snapshot.instances)
        for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives)
          for (const glm::vec3& p : pose_primitive(primitive, instance).positions)
            ASSERT_LE(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), kMaxCoordinate);
    }
}

// True if the file loaded.
bool load(const std::string& path) {
  try {
    if (is_environment(path)) {
      Scene scene;
      scene.environment = parse_environment(path);
      validate(scene, path);
    } else {
      play(load_scene(path));
    }
    return true;
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  } catch (const std::exception& error) {
    ADD_FAILURE() << path << ": not an InputError: " << error.what();
  }
  return false;
}

// The same by a process of its own, which ends with 0 or 2; `scene` is shown in the light of an environment.
bool load_by(const std::string& program, const std::string& path, const std::string& scene) {
  std::vector<std::string> words = {program, "info", is_environment(path) ? scene : path, "--json"};
  if (is_environment(path)) words.insert(words.end(), {"--env", path});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, (path + ".stderr").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t process = 0;
  const int failure = posix_spawn(&process, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  rusage usage{};
  if (failure != 0 || ::wait4(process, &status, 0, &usage) != process) {
    ADD_FAILURE() << program << " does not run";
    return false;
  }
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  EXPECT_TRUE(code == 0 || code == 2) << path << ": status " << status << ", see its .stderr";
  EXPECT_LT(1024.0 * static_cast<double>(usage.ru_maxrss), kMaxBytes) << path;
  return code == 0;
}

double peak_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

// Of this process and those that it waited for.
double processor_seconds() {
  double sum = 0.0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    ::getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      sum += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return sum;
}

double number_from_environment(const char* name, double fallback) {
  const char* text = std::getenv(name);
  return text ? std::atof(text) : fallback;
}

class Fuzz : public testing::TestWithParam<std::string> {};

TEST_P(Fuzz, DamagedFilesAreErrorsAndNothingWorse) {
  const std::vector<Seed> seeds = make_seeds().at(GetParam());
  const TempFolder folder;
  const std::string scene = folder.write("scene.gltf", gltf_of(R"("nodes":[{}])"));
  const char* program = std::getenv("LIGHTWELL_FUZZ_PROGRAM");
  const auto try_loading = [&](const std::string& path) {
    return program ? load_by(program, path, scene) : load(path);
  };
  set_log_level(LogLevel::kQuiet);
  for (const Seed& seed : seeds) {
    if (!seed.companion_name.empty()) folder.write(seed.companion_name, seed.companion);
    EXPECT_TRUE(try_loading(folder.write(seed.name, seed.content))) << seed.name << " is a valid file";
  }

  const double seconds = number_from_environment("LIGHTWELL_FUZZ_SECONDS", 0.25);
  const double files = number_from_environment("LIGHTWELL_FUZZ_FILES", std::numeric_limits<double>::infinity());
  const auto sequence = static_cast<std::uint64_t>(number_from_environment("LIGHTWELL_FUZZ_SEED", 1.0));
  std::cout << "seed " << sequence << ", " << seconds << " s, files in " << folder.path("") << std::endl;
  Mutator mutator(sequence);
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  const double bytes_before = peak_bytes();
  long cases = 0, loaded = 0;
  double slowest = 0.0;
  for (; elapsed() < seconds && static_cast<double>(cases) < files && !HasFailure(); ++cases) {
    const Seed& seed = seeds[mutator.below(seeds.size())];
    const bool damage_companion = seed.damage_companion_only || (!seed.companion_name.empty() && mutator.below(3) == 0);
    folder.write(seed.name, damage_companion ? seed.content : mutator.mutate(seed.content));
    if (!seed.companion_name.empty())
      folder.write(seed.companion_name, damage_companion ? mutator.mutate(seed.companion) : seed.companion);
    const double before = processor_seconds(), start_of_case = elapsed();
    loaded += try_loading(folder.path(seed.name));
    const double taken = processor_seconds() - before;
    slowest = std::max(slowest, taken);
    EXPECT_LT(taken, kMaxSeconds) << "case " << cases << " of seed " << sequence << ", " << seed.name;
    EXPECT_LT(elapsed() - start_of_case, kMaxWait) << "case " << cases << " of seed " << sequence;
    EXPECT_LT(peak_bytes() - bytes_before, kMaxBytes) << "case " << cases << " of seed " << sequence;
  }
  set_log_level(LogLevel::kWarning);
  std::cout << cases << " files, of which " << loaded << " loaded; the slowest took " << slowest << " s, "
            << static_cast<long>((peak_bytes() - bytes_before) / 1e6) << " MB" << std::endl;
  EXPECT_GT(cases, 10);
}

std::vector<std::string> formats() {
  std::vector<std::string> names;
  for (const auto& [name, seeds] : make_seeds()) names.push_back(name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Formats, Fuzz, testing::ValuesIn(formats()), [](const auto& info) { return info.param; });

}  // namespace
}  // namespace lightwell
