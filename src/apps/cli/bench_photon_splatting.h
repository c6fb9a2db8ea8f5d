// lightwell bench photon-splatting: error over time and memory of the settings that were published for it, and of ours.
#pragma once

namespace CLI {
class App;
}

namespace lightwell {

// Adds the command to `bench`.
void add_bench_photon_splatting_command(CLI::App& bench);

}  // namespace lightwell
