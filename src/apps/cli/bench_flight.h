// lightwell bench flight: how steady a technique's light is while a camera flies through a scene.
#pragma once

namespace CLI {
class App;
}

namespace lightwell {

void add_bench_flight_command(CLI::App& bench);

}  // namespace lightwell
