#include "tools/plot/figure_file.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "tools/plot/panel_painter.hpp"
#include "tools/record/atomic_file.hpp"
#include "tools/record/errors.hpp"
#include "tools/record/output_name.hpp"

namespace ghtrack::plot {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

constexpr double kPanelAspect = 0.56;  // height of a panel to its width
constexpr double kTitle = 2.0;         // height of the title, in font sizes

cairo_status_t append(void* text, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

/// How many columns give panels that are neither flat nor narrow, where the height is given.
int columns_in(const Style& style, const std::vector<Panel>& panels) {
  const auto count = static_cast<int>(panels.size());
  const bool has_wide =
      std::any_of(panels.begin(), panels.end(), [](const Panel& panel) { return panel.wide; });
  constexpr double kBeside = 6.0, kAround = 5.0;  // of what is drawn, in letters
  const auto is_room_for = [&](int columns) {
    return style.width / columns > 2.0 * kBeside * style.font_size;
  };
  if (style.height == 0.0 || has_wide) {
    int columns = std::min(style.columns, std::max(1, count));
    const auto is_too_tall = [&] {
      const int rows = (count + columns - 1) / columns;
      return style.tallest > 0.0 && rows * kPanelAspect * style.width / columns > style.tallest;
    };
    while (is_too_tall() && is_room_for(columns + 1)) ++columns;
    return columns;
  }
  const auto flatness = [&](int columns) {
    const int rows = (count + columns - 1) / columns;
    const double width = style.width / columns - kBeside * style.font_size;
    const double height = style.height / rows - kAround * style.font_size;
    return std::abs(std::log(kPanelAspect * width / std::max(height, 1.0)));
  };
  int best = 1;
  for (int columns = 2; columns <= count; ++columns) {
    if (!is_room_for(columns)) break;
    if (flatness(columns) < flatness(best)) best = columns;
  }
  return best;
}

/// Where the panels of a figure are, in rows of as many as there is room for.
class Layout {
 public:
  Layout(const Figure& figure, const Style& style) : columns_(columns_in(style, figure.panels)) {
    top_ = figure.title.empty() ? 0.0 : kTitle * style.font_size;
    const double width = style.width / columns_;
    double y = 0.0;
    int column = 0;
    for (const Panel& panel : figure.panels) {
      // A last panel that would stand alone takes the row.
      const bool alone = &panel == &figure.panels.back() && column == 0 && !panel.equal_scales &&
                         figure.panels.size() > 1;
      const bool wide = (panel.wide || alone) && columns_ > 1;
      if (wide && column > 0) {
        y += kPanelAspect * width;
        column = 0;
      }
      const double height = kPanelAspect * width * (wide && !alone ? kWide : 1.0);
      places_.push_back({width * column, y, wide ? style.width : width, height});
      column = wide ? 0 : (column + 1) % columns_;
      if (column == 0) y += height;
    }
    if (column > 0 || figure.panels.empty()) y += kPanelAspect * width;
    height_ = style.height > 0.0 ? style.height : top_ + y;
    const double stretch = (height_ - top_) / y;
    for (Rectangle& place : places_) {
      place.y = top_ + stretch * place.y;
      place.height *= stretch;
    }
  }

  double height() const { return height_; }
  const std::vector<Rectangle>& places() const { return places_; }

 private:
  static constexpr double kWide = 1.4;  // height of a wide panel to that of the others

  int columns_;
  double top_ = 0.0, height_ = 0.0;
  std::vector<Rectangle> places_;
};

void draw(cairo_t* cairo, const Figure& figure, const Style& style, const Layout& layout) {
  Canvas canvas(cairo);
  const Palette palette(style.dark);
  canvas.set(palette.ground);
  cairo_paint(cairo);
  if (!figure.title.empty()) {
    canvas.text(style.font_size * 0.8, style.font_size * 1.5, figure.title, style.font_size * 1.15,
                palette.ink, Canvas::Align::kLeft, true);
  }
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    draw_panel(canvas, figure.panels[i], layout.places()[i], palette, style.font_size);
  }
}

}  // namespace

std::optional<Style> style_named(const std::string& name) {
  constexpr double kPage = 680.0;  // height of the text on A4 and Letter [pt]
  if (name == "screen") return Style{};
  if (name == "column") {
    return Style{.width = 252.0,
                 .tallest = kPage,
                 .columns = 1,
                 .font_size = 7.0,
                 .pixels_per_point = 600.0 / 72.0};
  }
  if (name == "page") {
    return Style{.width = 515.0,
                 .tallest = kPage,
                 .columns = 2,
                 .font_size = 7.5,
                 .pixels_per_point = 300.0 / 72.0};
  }
  if (name == "slide") return Style{.width = 960.0, .height = 540.0, .font_size = 12.0};
  return std::nullopt;
}

bool is_figure_file(const std::filesystem::path& path) {
  const std::string ending = lower_extension(path);
  return ending == ".svg" || ending == ".pdf" || ending == ".png";
}

void write_figure(const std::filesystem::path& path, const Figure& figure, const Style& style) {
  const Layout layout(figure, style);
  const double height = layout.height();
  const std::string ending = lower_extension(path);
  std::string bytes;
  const bool is_png = ending == ".png";
  const double scale = is_png ? style.pixels_per_point : 1.0;
  Surface surface(
      is_png ? cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                          static_cast<int>(std::lround(style.width * scale)),
                                          static_cast<int>(std::lround(height * scale)))
      : ending == ".pdf"
          ? cairo_pdf_surface_create_for_stream(&append, &bytes, style.width, height)
          : cairo_svg_surface_create_for_stream(&append, &bytes, style.width, height),
      &cairo_surface_destroy);
  if (ending == ".pdf") {  // the date would make every file differ
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                   "2000-01-01T00:00:00Z");
  }
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo(cairo_create(surface.get()),
                                                                 &cairo_destroy);
  cairo_scale(cairo.get(), scale, scale);
  draw(cairo.get(), figure, style, layout);
  cairo_show_page(cairo.get());
  if (is_png) cairo_surface_write_to_png_stream(surface.get(), &append, &bytes);
  cairo_surface_finish(surface.get());
  const cairo_status_t status = cairo_surface_status(surface.get());
  if (status != CAIRO_STATUS_SUCCESS || cairo_status(cairo.get()) != CAIRO_STATUS_SUCCESS) {
    throw WriteError(path.string() + ": error: cannot be drawn: " + cairo_status_to_string(status));
  }
  write_file(path, bytes);
}

}  // namespace ghtrack::plot
