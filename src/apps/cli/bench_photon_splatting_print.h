// What bench photon-splatting found in one scene, as text.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace lightwell {

// `scene`: one of the array "scenes" that --json prints.
void print_splat_scene(const nlohmann::ordered_json& scene);

}  // namespace lightwell
