#include "tools/plot/canvas.hpp"

#include <array>

namespace ghtrack::plot {
namespace {

constexpr Colour of_hex(unsigned rgb) {
  return {(rgb >> 16U & 0xffU) / 255.0, (rgb >> 8U & 0xffU) / 255.0, (rgb & 0xffU) / 255.0, 1.0};
}

}  // namespace

Palette::Palette(bool dark)
    : ground(of_hex(dark ? 0x14181d : 0xffffff)),
      ink(of_hex(dark ? 0xe8eaed : 0x1c1e21)),
      faint(of_hex(dark ? 0x8a9099 : 0x8f959c)),
      grid(of_hex(dark ? 0x2b3138 : 0xe4e7ea)),
      dark_(dark) {}

Colour Palette::of(int number) const {
  if (number == -1) return ink;
  if (number < -1) return faint;
  constexpr std::array<unsigned, kColours> kLight = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7,
                                                     0xe69f00, 0x56b4e9, 0x6f4e9c, 0x766900,
                                                     0xc4384c, 0x855c30, 0x3a8a96, 0x42760c};
  constexpr std::array<unsigned, kColours> kDark = {0x56b4e9, 0xe69f00, 0x2fc79a, 0xe59fc6,
                                                    0xff8a4c, 0x3a86ff, 0xb79ce0, 0xf0e442,
                                                    0xff6969, 0xc49a6c, 0x5ee1d5, 0xa1d662};
  const auto& colours = dark_ ? kDark : kLight;
  return of_hex(colours[static_cast<std::size_t>(number) % colours.size()]);
}

void Canvas::fill(double x, double y, double width, double height, const Colour& colour) {
  set(colour);
  cairo_rectangle(cairo_, x, y, width, height);
  cairo_fill(cairo_);
}

void Canvas::line(double x0, double y0, double x1, double y1, double width, const Colour& colour) {
  set(colour);
  cairo_set_line_width(cairo_, width);
  cairo_move_to(cairo_, x0, y0);
  cairo_line_to(cairo_, x1, y1);
  cairo_stroke(cairo_);
}

void Canvas::select(double size, bool bold) {
  cairo_select_font_face(cairo_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo_, size);
}

double Canvas::text_width(const std::string& text, double size, bool bold) {
  select(size, bold);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_, text.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(double x, double y, const std::string& text, double size, const Colour& colour,
                  Align align, bool bold, double angle) {
  const double width = text_width(text, size, bold);
  const double shift = align == Align::kLeft ? 0.0 : align == Align::kCentre ? width / 2.0 : width;
  set(colour);
  cairo_save(cairo_);
  cairo_translate(cairo_, x, y);
  cairo_rotate(cairo_, angle);
  cairo_move_to(cairo_, -shift, 0.0);
  cairo_show_text(cairo_, text.c_str());
  cairo_restore(cairo_);
}

}  // namespace ghtrack::plot
