#include "tools/render/layout.hpp"

#include <algorithm>

namespace ghtrack::render {

namespace {

constexpr double kHudHeight = 56.0;
constexpr double kLegendHeight = 40.0;
constexpr double kHeaderHeight = 28.0;
constexpr double kGap = 4.0;
constexpr double kPlotShare = 0.2;  // of the picture's height

/// Size of one panel when `count` panels stand in so many columns.
struct Grid {
  int columns, rows;
  double width, height;
};

Grid grid(const Viewport& area, int count, int columns, double gap) {
  const int rows = (count + columns - 1) / columns;
  return {columns, rows, (area.width - gap * (columns - 1)) / columns,
          (area.height - gap * (rows - 1)) / rows};
}

}  // namespace

Layout lay_out(const VideoOptions& options, const SceneDrawing& scene, const Style& style) {
  const int count = std::max(1, static_cast<int>(scene.panels.size()));
  const double width = options.width;
  const double height = options.height;
  const double header = count > 1 ? style.length(kHeaderHeight) : 0.0;
  const bool plots = count > 1 || options.layers.shows(Layer::kInsets);

  Layout layout;
  layout.hud = {0.0, 0.0, width,
                options.layers.shows(Layer::kHud) ? style.length(kHudHeight) : 0.0};
  const double legend = options.layers.shows(Layer::kLegend) ? style.length(kLegendHeight) : 0.0;
  layout.legend = {0.0, height - legend, width, legend};
  const double plot = plots ? kPlotShare * height : 0.0;
  layout.plot = {0.0, layout.legend.top - plot, width, plot};

  const Viewport area{0.0, layout.hud.bottom(), width, layout.plot.top - layout.hud.bottom()};
  const double gap = count > 1 ? style.length(kGap) : 0.0;
  const Rectangle world = world_of(scene);
  const Vec2 size = world.max - world.min;
  const auto scale = [&](int columns) {
    const Grid g = grid(area, count, columns, gap);
    return std::min(g.width / size.x(), (g.height - header) / size.y());
  };
  int best = 1;
  for (int columns = 2; columns <= count; ++columns)
    if (scale(columns) > scale(best)) best = columns;
  const Grid g = grid(area, count, best, gap);
  for (int i = 0; i < count; ++i) {
    const double left = area.left + (i % best) * (g.width + gap);
    const double top = area.top + (i / best) * (g.height + gap);
    layout.headers.push_back({left, top, g.width, header});
    layout.panels.push_back({left, top + header, g.width, g.height - header});
  }
  return layout;
}

}  // namespace ghtrack::render
