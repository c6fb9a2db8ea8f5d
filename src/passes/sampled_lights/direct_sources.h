// What light comes straight from, for kernels that sample it with shadow rays: host side of
// shaders/sampled_direct.glsl.
#pragma once

#include <cstdint>

#include <glm/ext/vector_uint2.hpp>

#include "graph/frame_graph.h"
#include "passes/world/world.h"

namespace lightwell {

struct DirectSources {
  BufferHandle lights, emitters, groups, environment_table;
  ImageHandle environment;
  bool has_emitters = false;
  bool emitters_look_up = false;
  std::uint32_t environment_kind = 0;  // shaders/environment_kind.h
  // Of the kernel's parameters.
  glm::uvec2 table_size{0};
  std::uint32_t emitter_count = 0;
  std::uint32_t light_count = 0;
};

// Records the services that it takes: before the pass is declared.
DirectSources find_direct_sources(WorldFrame& world);

// Binds them, with the constants. The parameters are the caller's to push.
ComputePass& read_direct_sources(ComputePass& pass, const DirectSources& sources);

}  // namespace lightwell
