#include "tools/plot/panel_painter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "tools/plot/axis.hpp"

namespace ghtrack::plot {
namespace {

using Align = Canvas::Align;

constexpr std::size_t kFewDots = 300;    // of a curve, that are drawn larger
constexpr std::size_t kManyDots = 6000;  // of all curves, that are drawn smaller

/// The least and the greatest of finite values.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool only_positive = false;

  void add(double value) {
    if (!std::isfinite(value) || (only_positive && value <= 0.0)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void add(const std::vector<double>& values) {
    for (const double value : values) add(value);
  }
};

/// The coordinate system of a panel on the page.
class Frame {
 public:
  Frame(const Panel& panel, const Rectangle& plot, double font_size) : plot_(plot) {
    Range xs, ys;
    xs.only_positive = panel.x_logarithmic;
    ys.only_positive = panel.y_logarithmic;
    for (const Curve& curve : panel.curves) {
      xs.add(curve.x);
      ys.add(curve.y);
    }
    for (const Band& band : panel.bands) {
      xs.add(band.x);
      ys.add(band.low);
      ys.add(band.high);
    }
    for (const Level& level : panel.levels) ys.add(level.y);
    if (panel.y_from) ys.low = *panel.y_from;
    if (panel.y_to) ys.high = *panel.y_to;
    const double x_ticks = plot.width / (font_size * 6.5);
    const double y_ticks = plot.height / (font_size * 3.5);
    x = panel.x_logarithmic ? logarithmic_axis_over(xs.low, xs.high)
                            : axis_over(xs.low, xs.high, x_ticks, !panel.equal_scales);
    y = !panel.y_names.empty() ? axis_of(panel.y_names)
        : panel.y_logarithmic  ? logarithmic_axis_over(ys.low, ys.high)
                               : axis_over(ys.low, ys.high, y_ticks, panel.y_from && panel.y_to);
    if (panel.equal_scales) equalise(x_ticks, y_ticks);
  }

  double to_x(double value) const { return plot_.x + x.share(value) * plot_.width; }
  double to_y(double value) const { return plot_.y + (1.0 - y.share(value)) * plot_.height; }
  double tick_x(double tick) const { return plot_.x + (tick - x.low) / x.span() * plot_.width; }
  double tick_y(double tick) const {
    return plot_.y + plot_.height - (tick - y.low) / y.span() * plot_.height;
  }
  const Rectangle& plot() const { return plot_; }

  Axis x, y;

 private:
  /// Widens one axis until both have the same scale.
  void equalise(double x_ticks, double y_ticks) {
    const double scale = std::max(x.span() / plot_.width, y.span() / plot_.height);
    const auto widen = [&](const Axis& axis, double length, double ticks) {
      const double middle = (axis.low + axis.high) / 2.0;
      const double reach = scale * length / 2.0;
      return axis_over(middle - reach, middle + reach, ticks, true);
    };
    x = widen(x, plot_.width, x_ticks);
    y = widen(y, plot_.height, y_ticks);
  }

  Rectangle plot_;
};

/// Adds the points of a curve to Cairo's path; points closer than a hair to the last are passed
/// over, so that a million of them cost what can be seen of them.
void trace(cairo_t* cairo, const Frame& frame, const std::vector<double>& x,
           const std::vector<double>& y) {
  constexpr double kHair = 0.15;  // [pt]
  bool pen_down = false;
  double last_x = 0.0, last_y = 0.0;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) {
      pen_down = false;
      continue;
    }
    const double px = frame.to_x(x[i]), py = frame.to_y(y[i]);
    if (!std::isfinite(px) || !std::isfinite(py)) {
      pen_down = false;
      continue;
    }
    if (!pen_down) {
      cairo_move_to(cairo, px, py);
    } else if (std::hypot(px - last_x, py - last_y) < kHair && i + 1 < x.size()) {
      continue;
    } else {
      cairo_line_to(cairo, px, py);
    }
    pen_down = true;
    last_x = px;
    last_y = py;
  }
}

void draw_dots(Canvas& canvas, const Frame& frame, const Curve& curve, double radius) {
  cairo_t* const cairo = canvas.cairo();
  double last_x = -1e9, last_y = -1e9;
  for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) continue;
    const double px = frame.to_x(curve.x[i]), py = frame.to_y(curve.y[i]);
    if (!std::isfinite(px) || !std::isfinite(py)) continue;
    if (std::hypot(px - last_x, py - last_y) < 0.3) continue;
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, px, py, radius, 0.0, 2.0 * std::numbers::pi);
    last_x = px;
    last_y = py;
  }
  if (curve.mark == Mark::kDots) {
    cairo_fill(cairo);
  } else {
    cairo_set_line_width(cairo, 0.45 * radius);
    cairo_stroke(cairo);
  }
}

/// Where a curve without any length is, as of what stands still.
std::optional<std::pair<double, double>> only_place(const Curve& curve) {
  std::optional<std::pair<double, double>> place;
  for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) continue;
    const std::pair here(curve.x[i], curve.y[i]);
    if (place && *place != here) return std::nullopt;
    place = here;
  }
  return place;
}

/// The size of dots, smaller where there are many.
double dot_radius(const Panel& panel, double font_size) {
  std::size_t most = 0, dots = 0;
  for (const Curve& curve : panel.curves) {
    if (curve.mark != Mark::kDots && curve.mark != Mark::kRings) continue;
    most = std::max(most, curve.x.size());
    dots += curve.x.size();
  }
  if (dots > kManyDots) return 0.07 * font_size;
  return (most <= kFewDots ? 0.2 : 0.11) * font_size;
}

void draw_curve(Canvas& canvas, const Frame& frame, const Curve& curve, const Palette& palette,
                double font_size, double radius) {
  cairo_t* const cairo = canvas.cairo();
  canvas.set(palette.of(curve.colour).with_alpha(curve.colour < -1 ? 0.7 : 1.0));
  if (curve.mark == Mark::kDots || curve.mark == Mark::kRings) {
    return draw_dots(canvas, frame, curve, radius);
  }
  const double dashes[] = {font_size * 0.45, font_size * 0.3};
  cairo_set_dash(cairo, dashes, curve.mark == Mark::kDashes ? 2 : 0, 0.0);
  cairo_set_line_width(cairo, font_size * (curve.mark == Mark::kDashes ? 0.09 : 0.12));
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  trace(cairo, frame, curve.x, curve.y);
  cairo_stroke(cairo);
  cairo_set_dash(cairo, nullptr, 0, 0.0);
  if (const auto place = only_place(curve)) {
    draw_dots(canvas, frame,
              {.name = "", .x = {place->first}, .y = {place->second}, .mark = Mark::kDots},
              font_size * 0.2);
  }
}

void draw_band(Canvas& canvas, const Frame& frame, const Band& band, const Palette& palette) {
  cairo_t* const cairo = canvas.cairo();
  canvas.set(palette.of(band.colour).with_alpha(0.18));
  std::size_t begin = 0;
  while (begin < band.x.size()) {  // pieces between gaps
    std::size_t end = begin;
    while (end < band.x.size() && std::isfinite(band.low[end]) && std::isfinite(band.high[end])) {
      ++end;
    }
    if (end > begin + 1) {
      cairo_move_to(cairo, frame.to_x(band.x[begin]), frame.to_y(band.low[begin]));
      for (std::size_t i = begin; i < end; ++i) {
        cairo_line_to(cairo, frame.to_x(band.x[i]), frame.to_y(band.low[i]));
      }
      for (std::size_t i = end; i-- > begin;) {
        cairo_line_to(cairo, frame.to_x(band.x[i]), frame.to_y(band.high[i]));
      }
      cairo_close_path(cairo);
      cairo_fill(cairo);
    }
    begin = end + 1;
  }
}

void draw_axes(Canvas& canvas, const Panel& panel, const Frame& frame, const Rectangle& place,
               const Palette& palette, double font_size) {
  const Rectangle& plot = frame.plot();
  const double small = font_size * 0.85;
  for (const double tick : frame.x.ticks) {
    const double at = frame.tick_x(tick);
    canvas.line(at, plot.y, at, plot.y + plot.height, 0.6, palette.grid);
    canvas.text(at, plot.y + plot.height + small * 1.35, frame.x.label(tick), small, palette.ink,
                Align::kCentre);
  }
  double widest = 0.0;  // label beside the plot
  for (const double tick : frame.y.ticks) {
    const double at = frame.tick_y(tick);
    const std::string label = frame.y.label(tick);
    canvas.line(plot.x, at, plot.x + plot.width, at, 0.6, palette.grid);
    canvas.text(plot.x - small * 0.5, at + small * 0.36, label, small, palette.ink, Align::kRight);
    widest = std::max(widest, canvas.text_width(label, small));
  }
  canvas.text(plot.x, place.y + font_size * 1.1, panel.title, font_size, palette.ink, Align::kLeft,
              true);
  canvas.text(plot.x + plot.width / 2.0, place.y + place.height - font_size * 0.25,
              frame.x.title(panel.x_label), small, palette.ink, Align::kCentre);
  const double beside = std::max(place.x + small, plot.x - widest - small * 1.3);
  canvas.text(beside, plot.y + plot.height / 2.0, frame.y.title(panel.y_label), small, palette.ink,
              Align::kCentre, false, -std::numbers::pi / 2.0);
}

struct Entry {
  std::string name;
  Mark mark;
  int colour;
  bool is_band;
};

std::vector<Entry> legend_of(const Panel& panel) {
  std::vector<Entry> entries;
  for (const Curve& curve : panel.curves) {
    if (!curve.name.empty()) entries.push_back({curve.name, curve.mark, curve.colour, false});
  }
  // What all curves are compared with comes first.
  std::stable_partition(entries.begin(), entries.end(),
                        [](const Entry& entry) { return entry.colour < 0; });
  for (const Band& band : panel.bands) {
    if (!band.name.empty()) entries.push_back({band.name, Mark::kLine, band.colour, true});
  }
  return entries;
}

/// Entries of a legend in right-aligned rows, the first of which has the title beside it.
class Legend {
 public:
  Legend(Canvas& canvas, const Panel& panel, double width, double font_size)
      : canvas_(canvas), small_(font_size * 0.8) {
    double room = width - canvas.text_width(panel.title, font_size, true) - font_size * 1.5;
    double needed = 0.0;
    for (Entry& entry : legend_of(panel)) {
      const double own = width_of(entry);
      if (needed + own > room && (needed > 0.0 || rows_.size() == 1)) {
        rows_.emplace_back();
        room = width;
        needed = 0.0;
      }
      needed += own;
      rows_.back().push_back(std::move(entry));
    }
    if (rows_.size() > kMostRows) rows_.resize(kMostRows);
  }

  /// Below the first row.
  double extra_height() const { return static_cast<double>(rows_.size() - 1) * row_height(); }

  void draw(double right, double baseline, const Palette& palette) const {
    for (const std::vector<Entry>& row : rows_) {
      double x = right;
      for (const Entry& entry : row) x -= width_of(entry);
      for (const Entry& entry : row) {
        draw(entry, x, baseline, palette);
        x += width_of(entry);
      }
      baseline += row_height();
    }
  }

 private:
  static constexpr std::size_t kMostRows = 4;

  double row_height() const { return 1.4 * small_; }
  double swatch() const { return 1.6 * small_; }
  double width_of(const Entry& entry) const {
    return swatch() + canvas_.text_width(entry.name, small_) + small_ * 1.3;
  }

  void draw(const Entry& entry, double x, double y, const Palette& palette) const {
    const Colour colour = palette.of(entry.colour);
    const double middle = y - small_ * 0.32;
    if (entry.is_band) {
      canvas_.fill(x, middle - small_ * 0.35, swatch() * 0.8, small_ * 0.7, colour.with_alpha(0.3));
    } else if (entry.mark == Mark::kDots || entry.mark == Mark::kRings) {
      canvas_.set(colour);
      cairo_new_sub_path(canvas_.cairo());
      cairo_arc(canvas_.cairo(), x + swatch() * 0.4, middle, small_ * 0.22, 0.0,
                2.0 * std::numbers::pi);
      if (entry.mark == Mark::kDots) {
        cairo_fill(canvas_.cairo());
      } else {
        cairo_set_line_width(canvas_.cairo(), small_ * 0.1);
        cairo_stroke(canvas_.cairo());
      }
    } else {
      const double dashes[] = {small_ * 0.4, small_ * 0.25};
      cairo_set_dash(canvas_.cairo(), dashes, entry.mark == Mark::kDashes ? 2 : 0, 0.0);
      canvas_.line(x, middle, x + swatch() * 0.8, middle, small_ * 0.16, colour);
      cairo_set_dash(canvas_.cairo(), nullptr, 0, 0.0);
    }
    canvas_.text(x + swatch(), y, entry.name, small_, palette.ink);
  }

  Canvas& canvas_;
  double small_;  // letters
  std::vector<std::vector<Entry>> rows_{1};
};

void draw_levels(Canvas& canvas, const Panel& panel, const Frame& frame, const Palette& palette,
                 double font_size) {
  const Rectangle& plot = frame.plot();
  for (const Level& level : panel.levels) {
    const double at = frame.to_y(level.y);
    canvas.line(plot.x, at, plot.x + plot.width, at, font_size * 0.07, palette.faint);
    const double small = font_size * 0.75;
    const double width = canvas.text_width(level.name, small);
    const double right = plot.x + plot.width - font_size * 0.3;
    const bool has_room_below = at + font_size < plot.y + plot.height;
    const bool has_room_above = at - font_size > plot.y;
    const bool is_below = level.y < 0.0 ? has_room_below : !has_room_above;  // away from the other
    const double below = is_below ? font_size : 0.0;
    canvas.fill(right - width - 1.0, at + below - font_size * 0.95, width + 2.0, font_size * 0.85,
                palette.ground.with_alpha(0.8));
    canvas.text(right, at + below - font_size * 0.25, level.name, small, palette.ink,
                Align::kRight);
  }
}

}  // namespace

void draw_panel(Canvas& canvas, const Panel& panel, const Rectangle& place, const Palette& palette,
                double font_size) {
  const double left = font_size * 5.2, right = font_size * 0.8;
  const Legend legend(canvas, panel, place.width - left - right, font_size);
  const double top = font_size * 1.9 + legend.extra_height(), bottom = font_size * 3.0;
  const Rectangle plot{place.x + left, place.y + top, place.width - left - right,
                       place.height - top - bottom};
  const Frame frame(panel, plot, font_size);
  draw_axes(canvas, panel, frame, place, palette, font_size);
  cairo_t* const cairo = canvas.cairo();
  cairo_save(cairo);
  cairo_rectangle(cairo, plot.x, plot.y, plot.width, plot.height);
  cairo_clip(cairo);
  for (const Band& band : panel.bands) draw_band(canvas, frame, band, palette);
  const double radius = dot_radius(panel, font_size);
  for (const Curve& curve : panel.curves) {
    draw_curve(canvas, frame, curve, palette, font_size, radius);
  }
  draw_levels(canvas, panel, frame, palette, font_size);
  cairo_restore(cairo);
  canvas.set(palette.faint);
  cairo_set_line_width(cairo, 0.8);
  cairo_rectangle(cairo, plot.x, plot.y, plot.width, plot.height);
  cairo_stroke(cairo);
  legend.draw(plot.x + plot.width, place.y + font_size * 1.1, palette);
}

}  // namespace ghtrack::plot
