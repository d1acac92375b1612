#include "tools/render/layout.hpp"

#include <algorithm>
#include <array>

namespace ghtrack::render {

namespace {

constexpr double kHudHeight = 56.0;
constexpr double kHeaderHeight = 46.0;  // two lines
constexpr double kPanelGap = 4.0;
constexpr double kPlotShare = 0.2;  // of the picture's height
constexpr double kCloseUpMargin = 12.0;
constexpr double kNumbersBeside = 52.0;  // of the axes, which a close-up leaves room for
constexpr double kNumbersBelow = 30.0;
constexpr double kBesideShare = 0.32;  // of a panel's width, for close-ups beside it
constexpr double kMarks = 24.0;        // around an object: its track, its detections

/// Panels in columns and rows. Where a place is left over, it is for the plots; otherwise they get
/// a strip below.
struct Grid {
  int count, columns, rows;
  double gap;
  Viewport cell;  // the first
  bool has_place_left;

  Viewport place(int index) const {
    return {cell.left + (index % columns) * (cell.width + gap),
            cell.top + (index / columns) * (cell.height + gap), cell.width, cell.height};
  }
};

Grid grid(const Viewport& area, int count, int columns, double gap, double strip) {
  const int rows = (count + columns - 1) / columns;
  const bool has_place_left = rows * columns > count;
  const double height = has_place_left ? area.height : area.height - strip;
  return {count,
          columns,
          rows,
          gap,
          {area.left, area.top, (area.width - gap * (columns - 1)) / columns,
           (height - gap * (rows - 1)) / rows},
          has_place_left};
}

Viewport corner_of(const Viewport& panel, VideoCorner corner, double share, const Style& style) {
  const double margin = style.length(kCloseUpMargin);
  const double width = share * panel.width;
  const double height = std::min(0.75 * width, panel.height - margin - style.length(kNumbersBelow));
  const bool is_left = corner == VideoCorner::kTopLeft || corner == VideoCorner::kBottomLeft;
  const bool is_top = corner == VideoCorner::kTopLeft || corner == VideoCorner::kTopRight;
  return {is_left ? panel.left + style.length(kNumbersBeside) : panel.right() - margin - width,
          is_top ? panel.top + margin : panel.bottom() - style.length(kNumbersBelow) - height,
          width, height};
}

bool is_beside(const CloseUp& close_up) { return !close_up.corner; }

/// Close-ups that share a corner, or lie beside the panel, lie one above the other.
/// @param beside  what is left for those without a corner
std::vector<Viewport> places_of(const Viewport& panel, const Viewport& beside,
                                const std::vector<CloseUp>& close_ups, const Style& style) {
  const double gap = style.length(kPanelGap);
  const auto count =
      static_cast<double>(std::count_if(close_ups.begin(), close_ups.end(), is_beside));
  const double height = (beside.height - gap * (count - 1.0)) / std::max(count, 1.0);
  std::vector<Viewport> places;
  for (std::size_t i = 0; i < close_ups.size(); ++i) {
    const auto before = static_cast<double>(
        std::count_if(close_ups.begin(), close_ups.begin() + static_cast<std::ptrdiff_t>(i),
                      [&](const CloseUp& other) { return other.corner == close_ups[i].corner; }));
    if (is_beside(close_ups[i])) {
      places.push_back({beside.left, beside.top + before * (height + gap), beside.width, height});
      continue;
    }
    const VideoCorner corner = *close_ups[i].corner;
    Viewport place = corner_of(panel, corner, close_ups[i].share, style);
    const bool is_top = corner == VideoCorner::kTopLeft || corner == VideoCorner::kTopRight;
    const double step = before * (place.height + gap);
    place.top += is_top ? step : -step;
    places.push_back(place);
  }
  return places;
}

/// Whether nobody, and nothing that is drawn around somebody, is ever below a close-up.
bool hides_nobody(const Layout& layout, const SceneDrawing& scene, const Style& style) {
  double length = 0.0;  // [m]
  for (const ObjectInfo& object : scene.objects) {
    length = std::max({length, object.outline.length, object.outline.width});
  }
  for (std::size_t i = 0; i < layout.panels.size(); ++i) {
    const View view(world_of(scene), layout.panels[i]);
    const double reach = style.length(kMarks) + 0.5 * length * view.scale();
    for (const Viewport& area : layout.close_ups[i]) {
      for (const Vec2& place : scene.places) {
        const Pixel at = view.to_pixel(place);
        if (at.x > area.left - reach && at.x < area.right() + reach && at.y > area.top - reach &&
            at.y < area.bottom() + reach) {
          return false;
        }
      }
    }
  }
  return true;
}

}  // namespace

Layout lay_out(const VideoOptions& options, const SceneDrawing& scene, const Style& style,
               double legend_height) {
  const int count = std::max(1, static_cast<int>(scene.panels.size()));
  const double width = options.width;
  const double height = options.height;
  const double header = count > 1 ? style.room(kHeaderHeight) : 0.0;
  const double gap = count > 1 ? style.length(kPanelGap) : 0.0;
  const bool has_plots = count > 1 || options.layers.shows(Layer::kInsets);
  const double strip = has_plots ? kPlotShare * height : 0.0;

  Layout layout;
  layout.hud = {0.0, 0.0, width, options.layers.shows(Layer::kHud) ? style.room(kHudHeight) : 0.0};
  layout.legend = {0.0, height - legend_height, width, legend_height};

  const Viewport area{0.0, layout.hud.bottom(), width, layout.legend.top - layout.hud.bottom()};
  const Rectangle world = world_of(scene);
  const Vec2 size = world.max - world.min;
  Grid best = grid(area, count, 1, gap, strip);
  const auto scale = [&](const Grid& g) {
    return std::min(g.cell.width / size.x(), (g.cell.height - header) / size.y());
  };
  for (int columns = 2; columns <= count; ++columns) {
    const Grid other = grid(area, count, columns, gap, strip);
    if (scale(other) > scale(best)) best = other;
  }
  const bool has_beside =
      std::any_of(options.close_ups.begin(), options.close_ups.end(), is_beside);
  const double between = has_beside ? style.length(kPanelGap) : 0.0;
  for (int i = 0; i < count; ++i) {
    const Viewport place = best.place(i);
    const double top = place.top + header;
    const double below = place.height - header;
    const double rest = has_beside ? kBesideShare * place.width : 0.0;
    layout.headers.push_back({place.left, place.top, place.width, header});
    layout.panels.push_back({place.left, top, place.width - rest, below});
    layout.close_ups.push_back(places_of(
        layout.panels.back(), {place.right() - rest + between, top, rest - between, below},
        options.close_ups, style));
  }
  layout.plots = {0.0, layout.legend.top - strip, width, strip};
  if (best.has_place_left) {
    layout.plots = best.place(count);
    layout.plots.width = area.right() - layout.plots.left;
  }
  return layout;
}

std::vector<CloseUp> place_close_ups(const VideoOptions& options, const SceneDrawing& scene,
                                     const Style& style, double legend_height) {
  constexpr std::array kShares{1.0, 0.8, 0.65};
  constexpr std::array kCorners{VideoCorner::kTopRight, VideoCorner::kTopLeft,
                                VideoCorner::kBottomLeft, VideoCorner::kBottomRight};
  if (std::none_of(options.close_ups.begin(), options.close_ups.end(), is_beside)) {
    return options.close_ups;
  }
  VideoOptions tried = options;
  for (const double share : kShares) {
    for (const VideoCorner corner : kCorners) {
      for (std::size_t i = 0; i < options.close_ups.size(); ++i) {
        if (options.close_ups[i].corner) continue;
        tried.close_ups[i].corner = corner;
        tried.close_ups[i].share = share * options.close_ups[i].share;
      }
      if (hides_nobody(lay_out(tried, scene, style, legend_height), scene, style)) {
        return tried.close_ups;
      }
    }
  }
  return options.close_ups;
}

}  // namespace ghtrack::render
