// Colour spaces in which differences mean something to an eye. White is that of linear sRGB (1,1,1), D65.
#pragma once

#include <glm/ext/vector_double3.hpp>

namespace lightwell {

// CIE 1976 L*a*b*.
glm::dvec3 lab_from_rgb(const glm::dvec3& linear_rgb);
glm::dvec3 rgb_from_lab(const glm::dvec3& lab);

// Opponent colours that are linear in light: L*a*b* without its cube root.
glm::dvec3 ycxcz_from_rgb(const glm::dvec3& linear_rgb);
glm::dvec3 rgb_from_ycxcz(const glm::dvec3& ycxcz);

}  // namespace lightwell
