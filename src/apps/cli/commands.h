// The subcommands of `lightwell`. Each adds its options to the program and, when it is called, runs after all options
// were read. Results go to stdout; errors are thrown.
#pragma once

namespace CLI {
class App;
}

namespace lightwell {

void add_render_command(CLI::App& program);
void add_compare_command(CLI::App& program);
void add_info_command(CLI::App& program);
void add_bench_command(CLI::App& program);
void add_rays_command(CLI::App& program);
void add_montage_command(CLI::App& program);

}  // namespace lightwell
