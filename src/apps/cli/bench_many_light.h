// lightwell bench many-light: Table 5.1 of Sun and Agu 2015's thesis.
#pragma once

namespace CLI {
class App;
}

namespace lightwell {

// Adds the command to `bench`.
void add_bench_many_light_command(CLI::App& bench);

}  // namespace lightwell
