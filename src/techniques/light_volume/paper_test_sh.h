// The shaders' spherical harmonics for tests: the very file that the kernels include, compiled as C++.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace lightwell {
namespace sh_detail {

using glm::dot;
using glm::vec3;
using glm::vec4;

// Functions defined in a class may be defined in several test files.
struct ShaderSh {
#include "shaders/sh.glsl"
};

}  // namespace sh_detail

using sh_detail::ShaderSh;

}  // namespace lightwell
