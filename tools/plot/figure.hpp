#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace ghtrack::plot {

/// What a curve looks like.
enum class Mark { kLine, kDashes, kDots, kRings };

/// Where a curve is interrupted.
inline constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// A curve; NaN in x or y interrupts it.
struct Curve {
  std::string name;  // in the legend; empty: not there
  std::vector<double> x, y;
  Mark mark = Mark::kLine;
  int colour = 0;  // −1: ink, −2: faint ink, else by number
};

/// The area between two curves.
struct Band {
  std::string name;
  std::vector<double> x, low, high;
  int colour = 0;
};

/// A horizontal line, such as a bound.
struct Level {
  double y = 0.0;
  std::string name;
};

/// One coordinate system.
struct Panel {
  std::string title = {}, x_label = {}, y_label = {};
  std::vector<Curve> curves = {};
  std::vector<Band> bands = {};
  std::vector<Level> levels = {};
  bool wide = false;                                  // as wide as the figure
  bool equal_scales = false;                          // a metre is as long in x as in y
  bool x_logarithmic = false, y_logarithmic = false;  // values at or below zero are left out
  std::vector<std::string> y_names = {};              // of y = 0, 1, …, instead of numbers
  std::optional<double> y_from = {}, y_to = {};       // instead of what the curves need
};

struct Figure {
  std::string title;
  std::vector<Panel> panels;
};

/// How a figure is drawn.
struct Style {
  double width = 960.0;     // [pt], 1/72 inch
  double height = 0.0;      // 0: what the panels need
  double tallest = 0.0;     // of a figure whose panels say its height; 0: any
  int columns = 2;          // of panels; more of them where it would be taller
  double font_size = 12.0;  // [pt]
  bool dark = false;
  double pixels_per_point = 2.0;  // of a PNG
};

/// The sizes that papers ask for: "column" (88.9 mm), "page" (181.9 mm), "slide" (16:9), "screen";
/// absent if there is no such name.
std::optional<Style> style_named(const std::string& name);

}  // namespace ghtrack::plot
