// Lets one header describe a kernel's parameters and buffer elements to C++ and to GLSL.
//
//   #define BLUR_PARAMS(MEMBER) MEMBER(uvec2, size) MEMBER(float, sigma) MEMBER(uint, radius)
//   LW_PUSH_CONSTANTS(BlurParams, BLUR_PARAMS)        // C++: struct glsl::BlurParams; GLSL: params.size, ...
//
//   #define SPOT(MEMBER) MEMBER(vec4, position) MEMBER(vec4, intensity)
//   LW_STRUCT(Spot, SPOT)                             // an element of a storage buffer
//
// Push constants and the strides of buffers are checked against the SPIR-V when a pass is declared, so a layout that
// differs between the two languages (a vec3 that GLSL aligns to 16 bytes) stops the program with both offsets named.
#ifndef LIGHTWELL_SHADERS_SHARED_H
#define LIGHTWELL_SHADERS_SHARED_H

#ifdef __cplusplus

#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/ext/matrix_float4x4.hpp>
#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_float4.hpp>
#include <glm/ext/vector_int2.hpp>
#include <glm/ext/vector_int3.hpp>
#include <glm/ext/vector_int4.hpp>
#include <glm/ext/vector_uint2.hpp>
#include <glm/ext/vector_uint3.hpp>
#include <glm/ext/vector_uint4.hpp>

#include "gpu/kernel_code.h"

namespace lightwell::glsl {
using glm::ivec2;
using glm::ivec3;
using glm::ivec4;
using glm::mat4;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
}  // namespace lightwell::glsl

#define LW_DECLARE_MEMBER(type, name) type name;
#define LW_DESCRIBE_MEMBER(type, name) ParamMember{#name, offsetof(Self, name), sizeof(type)},

#define LW_STRUCT(Name, MEMBERS) \
  namespace lightwell::glsl {    \
  struct Name {                  \
    MEMBERS(LW_DECLARE_MEMBER)   \
  };                             \
  }

#define LW_PUSH_CONSTANTS(Name, MEMBERS)                              \
  namespace lightwell::glsl {                                         \
  struct Name {                                                       \
    MEMBERS(LW_DECLARE_MEMBER)                                        \
    static std::span<const ParamMember> members() {                   \
      using Self = Name;                                              \
      static const ParamMember all[] = {MEMBERS(LW_DESCRIBE_MEMBER)}; \
      return all;                                                     \
    }                                                                 \
  };                                                                  \
  }

#define LW_CONSTANT(type, name, value) \
  namespace lightwell::glsl {          \
  inline constexpr type name = value;  \
  }

#else  // GLSL

#define LW_DECLARE_MEMBER(type, name) type name;
#define LW_STRUCT(Name, MEMBERS) \
  struct Name {                  \
    MEMBERS(LW_DECLARE_MEMBER)   \
  };
#define LW_PUSH_CONSTANTS(Name, MEMBERS) layout(push_constant) uniform Name{MEMBERS(LW_DECLARE_MEMBER)} params;
#define LW_CONSTANT(type, name, value) const type name = value;

#endif

#endif
