#include "tools/render/legend.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "tools/render/scene_memory.hpp"
#include "tools/render/text.hpp"
#include "tools/render/wind_painter.hpp"

namespace ghtrack::render {

namespace {

constexpr double kIcon = 26.0;     // width of a sign
constexpr double kGap = 6.0;       // between a sign and its meaning
constexpr double kSpace = 18.0;    // between entries
constexpr double kMargin = 16.0;   // beside a row
constexpr double kRow = 26.0;      // height of a row
constexpr double kPadding = 12.0;  // above and below the rows together
constexpr double kLetters = 14.0;

/// Draws a sign in a box of 26 × 26 units around its middle.
void draw_sign(Canvas& canvas, Sign sign, Pixel m, const Style& style, double wind_arrow) {
  const double u = style.unit;
  const Color color = style.theme().track(1);
  const auto at = [&](double x, double y) { return Pixel{m.x + x * u, m.y + y * u}; };
  switch (sign) {
    case Sign::kTrain: {
      const std::vector<Pixel> corners{at(-12, -5), at(12, -5), at(12, 5), at(-12, 5)};
      canvas.polygon(corners, style.theme().truth);
      canvas.outline(corners, style.theme().truth_edge, style.length(1));
      break;
    }
    case Sign::kBall:
      canvas.disc(m, 6 * u, style.theme().truth);
      canvas.ring(m, 6 * u, style.theme().truth_edge, style.length(1));
      canvas.line(m, at(5.5, -2), style.theme().truth_edge, style.length(1.5));
      break;
    case Sign::kBalloon:
      canvas.line(at(0, 4), at(1, 12), style.theme().truth_edge, style.length(1));
      canvas.polygon(ellipse_outline(at(0, -2), {6 * u, 0}, {0, 7 * u}), style.theme().truth);
      canvas.outline(ellipse_outline(at(0, -2), {6 * u, 0}, {0, 7 * u}), style.theme().truth_edge,
                     style.length(1));
      break;
    case Sign::kDrone:
      canvas.polygon({at(-4, 0), at(4, 0), at(3, 5), at(-3, 5)}, style.theme().truth);
      canvas.line(at(-9, 0), at(9, 0), style.theme().truth_edge, style.length(2));
      for (const double side : {-9.0, 9.0})
        canvas.line(at(side - 4, -3), at(side + 4, -3), style.theme().truth_edge,
                    style.length(1.5));
      break;
    case Sign::kDetection:
    case Sign::kSecondDetection:
    case Sign::kThirdDetection:
      draw_detection(canvas, static_cast<int>(sign) - static_cast<int>(Sign::kDetection), m, 5 * u,
                     style.theme().detection, style.length(1.5));
      break;
    case Sign::kError:
      canvas.outline(ellipse_outline(m, {11 * u, -4 * u}, {1.5 * u, 4 * u}),
                     {style.theme().detection, 0.7}, style.length(1));
      break;
    case Sign::kPast:
      for (int i = 0; i < 3; ++i)
        canvas.cross(at(-8.0 + 8 * i, 3.0 - 3 * i), 2.2 * u,
                     {style.theme().detection, 0.3 + 0.15 * i}, style.length(1));
      break;
    case Sign::kPath:
      canvas.dashed({at(-12, 3), at(12, -3)}, {style.theme().truth_edge, 0.8}, 5 * u, 4 * u,
                    style.length(1.2));
      break;
    case Sign::kClutter:
      canvas.disc(m, 2.5 * u, style.theme().clutter);
      break;
    case Sign::kTrack:
      canvas.ring(m, 8 * u, color, style.length(2));
      break;
    case Sign::kTentative:
      canvas.ring(m, 6 * u, style.theme().tentative, style.length(1));
      break;
    case Sign::kCoasting: {
      std::vector<Pixel> ring = ellipse_outline(m, {8 * u, 0}, {0, 8 * u});
      ring.push_back(ring.front());
      canvas.dashed(ring, color, 4.5 * u, 4 * u, style.length(2));
      break;
    }
    case Sign::kTrail:
      for (int i = 0; i < 6; ++i)
        canvas.line(at(-12.0 + 4 * i, 4.0 - 1.4 * i), at(-8.0 + 4 * i, 2.6 - 1.4 * i),
                    mix(style.theme().page, color, 0.2 + 0.16 * i), style.length(2));
      break;
    case Sign::kSmoothed:
      canvas.line(at(-12, 4), at(12, -4), style.theme().text, style.length(1.4));
      break;
    case Sign::kResidual:
      canvas.polygon({at(-13, 4), at(-9, 0), at(-5, 4), at(-9, 8)}, color);
      canvas.arrow(at(-9, 4), at(8, -4), 7 * u, color, style.length(1.5));
      break;
    case Sign::kGate:
      canvas.outline(ellipse_outline(m, {12 * u, 0}, {0, 8 * u}), {color, 0.6}, style.length(1));
      break;
    case Sign::kFan:
      for (int i = 0; i < 4; ++i) canvas.disc(at(-10.0 + 6 * i, 0), 1.8 * u, color);
      break;
    case Sign::kLost:
      canvas.cross(m, 7 * u, color, style.length(2));
      break;
    case Sign::kSwitch:
      canvas.ring(m, 9 * u, style.theme().detection, style.length(3));
      break;
    case Sign::kLeader:
      canvas.disc(m, 5 * u, color);
      canvas.ring(m, 9 * u, color, style.length(2));
      break;
    case Sign::kFieldOfView:
      canvas.dashed({at(-12, 0), at(12, 0)}, style.theme().axis_text, 7 * u, 5 * u,
                    style.length(1.3));
      break;
    case Sign::kWind:
      canvas.arrow({m.x - 0.5 * wind_arrow, m.y}, {m.x + 0.5 * wind_arrow, m.y}, 7 * u,
                   style.theme().axis_text, style.length(1));
      break;
  }
}

/// The shapes of a scene's objects, each once.
std::vector<Sign> shapes_of(const SceneDrawing& scene) {
  std::vector<Sign> shapes;
  const auto occurs = [&](Outline::Shape shape) {
    return std::any_of(scene.objects.begin(), scene.objects.end(),
                       [shape](const ObjectInfo& object) { return object.outline.shape == shape; });
  };
  for (const auto& [shape, sign] : {std::pair{Outline::Shape::kBox, Sign::kTrain},
                                    {Outline::Shape::kDisc, Sign::kBall},
                                    {Outline::Shape::kBalloon, Sign::kBalloon},
                                    {Outline::Shape::kDrone, Sign::kDrone}})
    if (occurs(shape)) shapes.push_back(sign);
  return shapes;
}

}  // namespace

Legend::Legend(const VideoOptions& options, const SceneDrawing& scene, const Style& style,
               const Style& world_style, const Typefaces& fonts)
    : style_(style), fonts_(fonts) {
  const Layers& layers = options.layers;
  if (!layers.shows(Layer::kLegend)) return;
  const auto any_sensor = [&](auto holds) {
    return std::any_of(scene.sensors.begin(), scene.sensors.end(), holds);
  };
  const std::vector<Sign> shapes = shapes_of(scene);
  if (layers.shows(Layer::kTruth) && !shapes.empty()) add(shapes, U"truth");
  if (layers.shows(Layer::kFieldOfView) &&
      any_sensor([](const SensorDrawing& sensor) { return sensor.field_of_view.size() > 2; }))
    add({Sign::kFieldOfView}, U"field of view");
  if (layers.shows(Layer::kWind) && scene.strongest_wind > 0.0) {
    const double speed = round_wind(scene);
    wind_arrow_ = wind_arrow_length(speed, scene, world_style);
    add({Sign::kWind}, U"wind " + number_text("%g m/s", speed));
  }
  const bool shows_past = layers.shows(Layer::kTrails);
  if (shows_past && layers.shows(Layer::kTruth)) add({Sign::kPath}, U"true path");
  if (layers.shows(Layer::kDetections)) add_detections(scene);
  if (layers.shows(Layer::kDetections) &&
      any_sensor([](const SensorDrawing& sensor) { return sensor.has_ellipses; }))
    add({Sign::kError}, U"its error, 1σ");
  if (shows_past && layers.shows(Layer::kDetections)) add({Sign::kPast}, U"earlier");
  if (layers.shows(Layer::kClutter) &&
      any_sensor([](const SensorDrawing& sensor) { return sensor.has_clutter; }))
    add({Sign::kClutter}, U"clutter");
  if (layers.shows(Layer::kResiduals)) add({Sign::kResidual}, U"prior, residual");
  if (layers.shows(Layer::kGates)) add({Sign::kGate}, U"predicted innovation, 99 %");
  if (layers.shows(Layer::kTracks)) add({Sign::kTrack}, U"estimate");
  if (layers.shows(Layer::kTrails)) add({Sign::kTrail}, U"its trail");
  if (layers.shows(Layer::kSmoothed)) add({Sign::kSmoothed}, U"smoothed afterwards");
  if (layers.shows(Layer::kFans)) add({Sign::kFan}, U"next second");
  if (layers.shows(Layer::kTentative)) add({Sign::kTentative}, U"tentative");
  if (layers.shows(Layer::kTracks)) add({Sign::kCoasting}, U"coasting");
  if (layers.shows(Layer::kEvents)) {
    add({Sign::kLost}, U"lost");
    add({Sign::kSwitch}, U"ID switch");
  }
  if (scene.panels.size() > 1) add({Sign::kLeader}, U"least GOSPA so far");
  break_into_rows(options.width - 2.0 * style.length(kMargin));
}

/// One for all sensors, or each with its own mark.
void Legend::add_detections(const SceneDrawing& scene) {
  constexpr std::array kMarks = {Sign::kDetection, Sign::kSecondDetection, Sign::kThirdDetection};
  if (scene.sensors.size() < 2) return add({Sign::kDetection}, U"detection");
  for (std::size_t i = 0; i < scene.sensors.size() && i < kMarks.size(); ++i) {
    add({kMarks[i]}, drawable(scene.sensors[i].name, 24));
  }
}

void Legend::add(std::vector<Sign> signs, std::u32string meaning) {
  const double icons = static_cast<double>(signs.size()) * style_.length(kIcon);
  const double extra = std::max(0.0, wind_arrow_ - style_.length(kIcon));
  Entry entry{std::move(signs), std::move(meaning), 0.0};
  entry.width = icons + style_.length(kGap) +
                fonts_.regular.width(entry.meaning, style_.letters(kLetters)) +
                (entry.signs.front() == Sign::kWind ? extra : 0.0);
  entries_.push_back(std::move(entry));
}

/// Begins a new row wherever the next entry would be beyond `room` [px].
/// @return the number of rows
int Legend::fill_rows(double room) {
  int rows = 1;
  double used = 0.0;
  for (Entry& entry : entries_) {
    entry.begins_row = used > 0.0 && used + entry.width > room;
    if (entry.begins_row) {
      used = 0.0;
      ++rows;
    }
    used += entry.width + style_.length(kSpace);
  }
  return rows;
}

/// As few rows as possible, of about the same length.
void Legend::break_into_rows(double room) {
  const int rows = fill_rows(room);
  double shortest = room / rows;
  while (shortest < room && fill_rows(shortest) > rows) shortest += style_.length(4);
  fill_rows(std::min(shortest, room));
}

double Legend::height() const {
  if (entries_.empty()) return 0.0;
  const auto breaks = std::count_if(entries_.begin(), entries_.end(),
                                    [](const Entry& entry) { return entry.begins_row; });
  return style_.room(kRow * static_cast<double>(1 + breaks) + kPadding);
}

void Legend::draw(Canvas& canvas, const Viewport& area) const {
  const int letters = style_.letters(kLetters);
  const double left = area.left + style_.length(kMargin);
  Pixel at{left, area.top + style_.room(0.5 * (kPadding + kRow))};
  for (const Entry& entry : entries_) {
    if (entry.begins_row) at = {left, at.y + style_.room(kRow)};
    double x = at.x;
    for (const Sign sign : entry.signs) {
      const double icon =
          sign == Sign::kWind ? std::max(wind_arrow_, style_.length(kIcon)) : style_.length(kIcon);
      draw_sign(canvas, sign, {x + 0.5 * icon, at.y}, style_, wind_arrow_);
      x += icon;
    }
    canvas.text(fonts_.regular, entry.meaning, letters,
                {x + style_.length(kGap), at.y + 0.36 * letters}, style_.theme().muted_text);
    at.x += entry.width + style_.length(kSpace);
  }
}

}  // namespace ghtrack::render
