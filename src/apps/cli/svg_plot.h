// Curves on two logarithmic axes as an SVG picture.
#pragma once

#include <string>
#include <vector>

#include <glm/ext/vector_double2.hpp>

namespace lightwell {

struct PlotCurve {
  std::string name;
  std::vector<glm::dvec2> points;  // those that are not finite and above 0 are left out
};

struct Plot {
  std::string title, x_label, y_label;
  std::vector<PlotCurve> curves;
};

// Plots beside and below each other, `columns` (at least 1) in a row, and one legend: curves of one name look alike in
// all plots.
std::string plots_as_svg(const std::vector<Plot>& plots, int columns);

}  // namespace lightwell
