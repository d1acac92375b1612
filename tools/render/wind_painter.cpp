#include "tools/render/wind_painter.hpp"

#include <algorithm>
#include <cmath>

#include "tools/render/ticks.hpp"

namespace ghtrack::render {

namespace {

constexpr double kSpacing = 90.0;  // [px] between arrows, at least
constexpr double kLongest = 54.0;  // [px] of the arrow for the strongest wind
constexpr double kLimit = 1.6;     // times that length: what gusts may reach

}  // namespace

double round_wind(const SceneDrawing& scene) {
  return 1.0 / round_step(1.0 / scene.strongest_wind);  // 1, 2, 5 · 10ⁿ that is not more
}

double wind_arrow_length(double speed, const SceneDrawing& scene, const Style& style) {
  return style.length(kLongest * std::min(kLimit, speed / scene.strongest_wind));
}

void draw_wind(Canvas& canvas, const Stage& stage, double time) {
  if (!stage.scene.wind || !(stage.scene.strongest_wind > 0.0)) return;
  const Rectangle world = stage.view.world();
  const double step = round_step(stage.style.length(kSpacing) / stage.view.scale());
  const double head = stage.style.length(7);
  for (double column = std::floor(world.min.x() / step); (column + 0.5) * step < world.max.x();
       ++column)
    for (double row = std::floor(world.min.y() / step); (row + 0.5) * step < world.max.y(); ++row) {
      const Vec2 place((column + 0.5) * step, (row + 0.5) * step);
      if (stage.scene.ground && place.y() < stage.scene.ground->height_at(place.x())) continue;
      const Vec2 wind = stage.scene.wind(place, time);
      const double speed = wind.norm();
      if (!(speed > 0.0) || !std::isfinite(speed)) continue;
      const double half = 0.5 * wind_arrow_length(speed, stage.scene, stage.style) / speed;
      const Pixel m = stage.view.to_pixel(place);
      canvas.arrow({m.x - half * wind.x(), m.y + half * wind.y()},
                   {m.x + half * wind.x(), m.y - half * wind.y()}, head, stage.style.theme().wind,
                   stage.style.length(1));
    }
}

}  // namespace ghtrack::render
