#pragma once

#include <cairo.h>

#include <cstddef>
#include <string>

#include "tools/plot/figure.hpp"

namespace ghtrack::plot {

struct Colour {
  double red = 0.0, green = 0.0, blue = 0.0, alpha = 1.0;
  Colour with_alpha(double value) const { return {red, green, blue, value}; }
};

/// The colours of a figure on light or dark ground.
struct Palette {
  explicit Palette(bool dark);
  Colour ground, ink, faint, grid;

  static constexpr std::size_t kColours = 12;  // that can be told apart

  /// Of a curve: first those that colour-blind people tell apart (Okabe & Ito 2008), after the
  /// twelfth again.
  Colour of(int number) const;

 private:
  bool dark_;
};

/// Draws figures with Cairo, so that SVG, PDF and PNG come from the same code. Lengths in points.
class Canvas {
 public:
  enum class Align { kLeft, kCentre, kRight };

  explicit Canvas(cairo_t* cairo) : cairo_(cairo) {}

  void fill(double x, double y, double width, double height, const Colour& colour);
  void line(double x0, double y0, double x1, double y1, double width, const Colour& colour);
  void text(double x, double y, const std::string& text, double size, const Colour& colour,
            Align align = Align::kLeft, bool bold = false, double angle = 0.0);
  double text_width(const std::string& text, double size, bool bold = false);

  cairo_t* cairo() { return cairo_; }
  void set(const Colour& colour) {
    cairo_set_source_rgba(cairo_, colour.red, colour.green, colour.blue, colour.alpha);
  }

 private:
  void select(double size, bool bold);
  cairo_t* cairo_;
};

}  // namespace ghtrack::plot
