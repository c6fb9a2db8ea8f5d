// lightwell bench ray-traced-voxels: Tables 5.1 and 7.1 to 7.7 of Magalhaes 2020.
#pragma once

namespace CLI {
class App;
}

namespace lightwell {

// Adds the command to `bench`.
void add_bench_ray_traced_voxels_command(CLI::App& bench);

}  // namespace lightwell
