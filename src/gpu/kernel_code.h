// One compiled shader stage, embedded in the program at build time (cmake/kernels.cmake).
// `#include "kernels/passes/gbuffer/gbuffer.vert.h"` declares `kernels::gbuffer_gbuffer_vert`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace lightwell {

struct KernelCode {
  const char* name;  // source file, relative to src/
  std::span<const std::uint32_t> spirv;
};

// A kernel that traces rays (it includes shaders/trace.glsl) is compiled twice: for our own hierarchy and for ray
// queries.
struct TraceKernel {
  KernelCode bvh;
  KernelCode ray_query;
};

// What a host-side parameter struct says of itself (shaders/shared.h); checked against the shader's own layout.
struct ParamMember {
  const char* name;
  std::size_t offset;
  std::size_t size;
};

}  // namespace lightwell
