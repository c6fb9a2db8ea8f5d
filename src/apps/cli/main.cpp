// lightwell: renders scenes with global illumination, compares pictures, describes scenes.
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/cli/commands.h"
#include "apps/cli/interrupt.h"
#include "core/join.h"
#include "core/log.h"
#include "core/printable.h"
#include "lightwell/error.h"

namespace {

constexpr int kSuccess = 0;
constexpr int kFailure = 2;

int fail(const std::string& message) {
  std::fprintf(stderr, "lightwell: error: %s\n", lightwell::printable(message).c_str());
  return kFailure;
}

// An option of `command` that took the next option for its value; "": none.
std::string option_without_value(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    for (const std::string& value : option->results())
      if (value.starts_with('-') && command.get_option_no_throw(value) != nullptr) return option->get_name();
  return "";
}

// CLI11 counts arguments; a user wants to know what to change.
std::string describe(const CLI::ParseError& error, const std::vector<CLI::App*>& commands) {
  const std::string text = error.what();
  for (const CLI::App* command : commands)
    if (const std::string name = option_without_value(*command); !name.empty()) return name + ": needs a value";
  const auto option_before = [&](const char* words) { return text.substr(0, text.find(words)); };
  if (text.find(": At Most 1 required") != std::string::npos)
    return option_before(": At Most 1 required") + ": given more than once";
  if (text.find(": 1 required ") != std::string::npos) return option_before(": 1 required ") + ": needs a value";
  return text;
}

std::string command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return lightwell::join(names);
}

int run(int argc, char** argv) {
  CLI::App program{"Real-time global illumination on Vulkan, with its ground truth beside it.", "lightwell"};
  program.set_version_flag("--version", "lightwell " LIGHTWELL_VERSION);
  program.require_subcommand(1);
  program.fallthrough();
  program.add_flag_callback(
      "-v,--verbose", [] { lightwell::set_log_level(lightwell::LogLevel::kVerbose); }, "Say what is being done");
  program.add_flag_callback(
      "-q,--quiet", [] { lightwell::set_log_level(lightwell::LogLevel::kQuiet); }, "No warnings, no progress");
  lightwell::add_render_command(program);
  lightwell::add_compare_command(program);
  lightwell::add_info_command(program);
  lightwell::add_bench_command(program);
  lightwell::add_rays_command(program);
  lightwell::add_montage_command(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return program.exit(e);  // --help, --version
    if (program.get_subcommands().empty() && !program.remaining().empty())
      return fail("'" + program.remaining().front() + "' is not a command (there are: " + command_names(program) + ")");
    const std::vector<CLI::App*> chosen = program.get_subcommands();
    const std::string command = chosen.empty() ? "" : " " + chosen.front()->get_name();
    return fail(describe(e, chosen) + " (see lightwell" + command + " --help)");
  }
  return kSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  lightwell::handle_signals();
  int code = kSuccess;
  try {
    code = run(argc, argv);
  } catch (const std::bad_alloc&) {
    code = fail("not enough memory");
  } catch (const std::exception& e) {
    code = fail(e.what());
  }
  // A full disk behind a redirected stdout shows only here.
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) return fail("standard output: could not be written");
  return code;
}
