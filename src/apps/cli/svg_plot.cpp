#include "apps/cli/svg_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace lightwell {

namespace {

// Pixels.
constexpr double kPlotWidth = 300.0, kPlotHeight = 220.0;
constexpr double kLeft = 60.0, kRight = 12.0, kAbove = 28.0, kBelow = 44.0;
constexpr double kCellWidth = kLeft + kPlotWidth + kRight, kCellHeight = kAbove + kPlotHeight + kBelow;
constexpr double kLegendWidth = 130.0, kLegendLine = 18.0;

// Colours that differ for people with colour-blindness, too; after the last they begin anew with dashes.
constexpr std::array<const char*, 8> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                "#e69f00", "#56b4e9", "#7f7f7f", "#332288"};

[[gnu::format(printf, 2, 3)]] void add(std::string& svg, const char* format, ...) {
  char line[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  svg += line;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else
      result += c;
  }
  return result;
}

void add_text(std::string& svg, double x, double y, const char* anchor, const std::string& text,
              const char* more = "") {
  add(svg, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\"%s>", x, y, anchor, more);
  svg += escaped(text) + "</text>\n";
}

bool can_be_shown(const glm::dvec2& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && point.x > 0.0 && point.y > 0.0;
}

// A logarithmic axis that begins and ends at 1, 2 or 5 times a power of ten.
struct Axis {
  double low = 1.0, high = 10.0;
  std::vector<double> ticks;

  double place(double value) const { return std::log(value / low) / std::log(high / low); }
};

Axis fit_axis(const Plot& plot, int coordinate) {
  double low = INFINITY, high = 0.0;
  for (const PlotCurve& curve : plot.curves)
    for (const glm::dvec2& point : curve.points) {
      if (!can_be_shown(point)) continue;
      low = std::min(low, point[coordinate]);
      high = std::max(high, point[coordinate]);
    }
  Axis axis;
  if (high <= 0.0) return axis;
  std::vector<double> round;
  for (int power = static_cast<int>(std::floor(std::log10(low))) - 1; power <= std::log10(high) + 1; ++power)
    for (const double digit : {1.0, 2.0, 5.0}) round.push_back(digit * std::pow(10.0, power));
  const auto begin = std::upper_bound(round.begin(), round.end(), low * (1.0 + 1e-9)) - 1;
  auto end = std::lower_bound(round.begin(), round.end(), high * (1.0 - 1e-9));
  if (end == begin) ++end;
  axis.low = *begin;
  axis.high = *end;
  axis.ticks.assign(begin, end + 1);
  if (axis.ticks.size() > 8)  // powers of ten are enough
    std::erase_if(axis.ticks, [](double tick) {
      const double power = std::log10(tick);
      return std::abs(power - std::round(power)) > 1e-6;
    });
  return axis;
}

class Drawing {
 public:
  Drawing(const Plot& plot, const Axis& x, const Axis& y, double left, double top, std::string& svg)
      : plot_(plot), x_(x), y_(y), left_(left), top_(top), svg_(svg) {}

  void draw_axes() {
    for (const double tick : x_.ticks) {
      const double x = left_ + kPlotWidth * x_.place(tick);
      add(svg_, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/>\n", x, top_, x,
          top_ + kPlotHeight);
      add_text(svg_, x, top_ + kPlotHeight + 14.0, "middle", label(tick));
    }
    for (const double tick : y_.ticks) {
      const double y = top_ + kPlotHeight * (1.0 - y_.place(tick));
      add(svg_, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/>\n", left_, y,
          left_ + kPlotWidth, y);
      add_text(svg_, left_ - 5.0, y + 4.0, "end", label(tick));
    }
    add(svg_, "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" stroke=\"#333\"/>\n", left_,
        top_, kPlotWidth, kPlotHeight);
    add_text(svg_, left_ + kPlotWidth / 2, top_ - 10.0, "middle", plot_.title, " font-weight=\"bold\"");
    add_text(svg_, left_ + kPlotWidth / 2, top_ + kPlotHeight + 32.0, "middle", plot_.x_label);
    char turned[64];
    std::snprintf(turned, sizeof turned, " transform=\"rotate(-90 %.1f %.1f)\"", left_ - 44.0, top_ + kPlotHeight / 2);
    add_text(svg_, left_ - 44.0, top_ + kPlotHeight / 2, "middle", plot_.y_label, turned);
  }

  void draw_curve(const PlotCurve& curve, const std::string& style) {
    std::string line, marks;
    for (const glm::dvec2& point : curve.points) {
      if (!can_be_shown(point)) continue;
      const double x = left_ + kPlotWidth * x_.place(point.x), y = top_ + kPlotHeight * (1.0 - y_.place(point.y));
      add(line, "%.1f,%.1f ", x, y);
      add(marks, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2.5\" %s/>\n", x, y, style.c_str());
    }
    if (line.empty()) return;
    svg_ += "<polyline points=\"" + line + "\" " + style + "/>\n" + marks;
  }

 private:
  static std::string label(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
  }

  const Plot& plot_;
  const Axis& x_;
  const Axis& y_;
  double left_, top_;
  std::string& svg_;
};

std::vector<std::string> names_of(const std::vector<Plot>& plots) {
  std::vector<std::string> names;
  for (const Plot& plot : plots)
    for (const PlotCurve& curve : plot.curves)
      if (std::find(names.begin(), names.end(), curve.name) == names.end()) names.push_back(curve.name);
  return names;
}

std::string style_of(std::size_t index) {
  return std::string("fill=\"none\" stroke-width=\"1.6\" stroke=\"") + kColors[index % kColors.size()] + "\"" +
         (index < kColors.size() ? "" : " stroke-dasharray=\"4 2\"");
}

void draw_legend(const std::vector<std::string>& names, double left, std::string& svg) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double y = kAbove + 8.0 + kLegendLine * static_cast<double>(i);
    add(svg, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" %s/>\n", left, y, left + 22.0, y,
        style_of(i).c_str());
    add_text(svg, left + 28.0, y + 4.0, "start", names[i]);
  }
}

}  // namespace

std::string plots_as_svg(const std::vector<Plot>& plots, int columns) {
  const std::vector<std::string> names = names_of(plots);
  const int rows = (static_cast<int>(plots.size()) + columns - 1) / columns;
  const double legend = kCellWidth * columns + 8.0;
  const double height = std::max(kCellHeight * rows, kAbove + kLegendLine * static_cast<double>(names.size()));
  std::string svg;
  add(svg,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" font-family=\"sans-serif\" "
      "font-size=\"11\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
      legend + kLegendWidth, height);
  for (std::size_t i = 0; i < plots.size(); ++i) {
    const Axis x = fit_axis(plots[i], 0), y = fit_axis(plots[i], 1);
    const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
    Drawing drawing(plots[i], x, y, kCellWidth * column + kLeft, kCellHeight * row + kAbove, svg);
    drawing.draw_axes();
    for (const PlotCurve& curve : plots[i].curves) {
      const auto index = std::find(names.begin(), names.end(), curve.name) - names.begin();
      drawing.draw_curve(curve, style_of(static_cast<std::size_t>(index)));
    }
  }
  draw_legend(names, legend, svg);
  return svg + "</svg>\n";
}

}  // namespace lightwell
