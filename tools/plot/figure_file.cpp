#include "tools/plot/figure_file.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "tools/plot/panel_painter.hpp"
#include "tools/record/atomic_file.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack::plot {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

constexpr double kPanelAspect = 0.56;  // height of a panel to its width
constexpr double kTitle = 2.0;         // height of the title, in font sizes

cairo_status_t append(void* text, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

double title_height(const Figure& figure, const Style& style) {
  return figure.title.empty() ? 0.0 : kTitle * style.font_size;
}

int rows_of(const Figure& figure, const Style& style) {
  const int panels = std::max(1, static_cast<int>(figure.panels.size()));
  const int columns = std::min(style.columns, panels);
  return (panels + columns - 1) / columns;
}

void draw(cairo_t* cairo, const Figure& figure, const Style& style, double height) {
  Canvas canvas(cairo);
  const Palette palette(style.dark);
  canvas.fill(0.0, 0.0, style.width, height, palette.ground);
  const double top = title_height(figure, style);
  if (!figure.title.empty()) {
    canvas.text(style.font_size * 0.8, style.font_size * 1.5, figure.title, style.font_size * 1.15,
                palette.ink, Canvas::Align::kLeft, true);
  }
  const int columns = std::min(style.columns, std::max(1, static_cast<int>(figure.panels.size())));
  const double width = style.width / columns;
  const double row = (height - top) / rows_of(figure, style);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const auto at = static_cast<int>(i);
    draw_panel(canvas, figure.panels[i],
               {width * (at % columns), top + row * (at / columns), width, row}, palette,
               style.font_size);
  }
}

}  // namespace

std::optional<Style> style_named(const std::string& name) {
  if (name == "screen") return Style{};
  if (name == "column") {
    return Style{.width = 252.0, .columns = 1, .font_size = 7.0, .pixels_per_point = 600.0 / 72.0};
  }
  if (name == "page") {
    return Style{.width = 515.0, .columns = 2, .font_size = 7.5, .pixels_per_point = 300.0 / 72.0};
  }
  if (name == "slide") return Style{.width = 960.0, .height = 540.0, .font_size = 12.0};
  return std::nullopt;
}

bool is_figure_file(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".svg" || ending == ".pdf" || ending == ".png";
}

void write_figure(const std::filesystem::path& path, const Figure& figure, const Style& style) {
  const int columns = std::min(style.columns, std::max(1, static_cast<int>(figure.panels.size())));
  const double height =
      style.height > 0.0 ? style.height
                         : title_height(figure, style) + rows_of(figure, style) * kPanelAspect *
                                                             style.width / columns;
  const std::string ending = path.extension().string();
  std::string bytes;
  const bool is_png = ending == ".png";
  const double scale = is_png ? style.pixels_per_point : 1.0;
  Surface surface(is_png ? cairo_image_surface_create(CAIRO_FORMAT_RGB24,
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
  draw(cairo.get(), figure, style, height);
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
