#include "tools/render/picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "tools/render/backdrop.hpp"
#include "tools/render/text.hpp"
#include "tools/render/truth_painter.hpp"

namespace ghtrack::render {

namespace {

constexpr double kDetectionSeconds = 1.0;  // a detection fades away in that time
constexpr double kPanelUnit = 0.8;         // signs are smaller when panels share the picture

Color panel_color(std::size_t index) { return track_color(static_cast<int>(index) + 1); }

std::u32string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return drawable(text);
}

std::optional<Vec2> position_of(ObjectId id, const TruthSnapshot& truth) {
  for (const TruthState& object : truth.objects)
    if (object.id == id && object.position.allFinite()) return object.position;
  return std::nullopt;
}

bool has_field_of_view(const SceneDrawing& scene) {
  return std::any_of(scene.sensors.begin(), scene.sensors.end(),
                     [](const SensorDrawing& sensor) { return sensor.field_of_view.size() > 2; });
}

double end_of(const VideoOptions& options, const SceneDrawing& scene) {
  return std::max(options.from + 1e-3,
                  std::min(options.to.value_or(scene.duration), scene.duration));
}

}  // namespace

Picture::Picture(const VideoOptions& options, const SceneDrawing& scene)
    : options_(options),
      scene_(scene),
      style_(Style::of_picture(options.width, options.height)),
      panel_style_(style_),
      layout_(lay_out(options_, scene_, style_)),
      errors_(options.from, end_of(options, scene)) {
  const bool compares = layout_.panels.size() > 1;
  if (compares) panel_style_.unit *= kPanelUnit;
  for (const Viewport& panel : layout_.panels) {
    views_.emplace_back(world_of(scene_), panel);
    painters_.emplace_back(compares ? std::optional(panel_color(painters_.size())) : std::nullopt);
  }
  if (!options_.follow) {
    backdrop_.create(options_.height, options_.width, CV_8UC3);
    draw_backdrop_into(backdrop_, views_);
  }
}

void Picture::draw(const VideoFrame& frame, cv::Mat& image) {
  for (const WindSample& sample : frame.wind)
    if (sample.velocity.allFinite())
      strongest_wind_ = std::max(strongest_wind_, sample.velocity.norm());
  if (options_.follow) {
    if (const auto centre = position_of(*options_.follow, frame.truth)) {
      views_.clear();
      for (const Viewport& panel : layout_.panels) {
        const Vec2 half(0.5 * options_.follow_width,
                        0.5 * options_.follow_width * panel.height / panel.width);
        views_.emplace_back(Rectangle{*centre - half, *centre + half}, panel);
      }
    }
    image.create(options_.height, options_.width, CV_8UC3);
    draw_backdrop_into(image, views_);
  } else {
    backdrop_.copyTo(image);
  }

  Canvas canvas(image);
  std::vector<std::optional<double>> errors;
  for (std::size_t i = 0; i < painters_.size() && i < frame.panels.size(); ++i) {
    painters_[i].remember(frame, frame.panels[i]);
    draw_panel(canvas, views_[i], frame, i);
    if (painters_.size() > 1) draw_header(canvas, frame.panels[i], i);
    errors.push_back(frame.panels[i].rmse);
  }
  if (layout_.plot.height > 0.0) {
    errors_.add(frame.time, errors);
    errors_.draw(canvas, layout_.plot, style_, fonts_);
  }
  if (options_.layers.shows(Layer::kHud)) draw_hud(canvas, frame);
  if (options_.layers.shows(Layer::kLegend)) legend_.draw(canvas, layout_.legend, style_, fonts_);
}

void Picture::draw_backdrop_into(cv::Mat& image, const std::vector<View>& views) {
  Canvas canvas(image);
  canvas.fill(dark::kPage);
  for (std::size_t i = 0; i < views.size(); ++i) {
    Canvas panel = canvas.within(layout_.panels[i]);
    draw_backdrop(panel, views[i], scene_, options_.layers, panel_style_, fonts_);
  }
}

void Picture::draw_panel(Canvas& canvas, const View& view, const VideoFrame& frame,
                         std::size_t index) {
  Canvas part = canvas.within(layout_.panels[index]);
  if (options_.layers.shows(Layer::kWind) && strongest_wind_ > 0.0 && !frame.wind.empty()) {
    draw_wind(part, view, frame.wind, strongest_wind_, panel_style_);
    legend_.saw(Sign::kWind);
  }
  if (options_.layers.shows(Layer::kTruth)) {
    const ShapesShown shown = draw_truth(part, view, scene_, frame.truth, panel_style_);
    if (shown.box) legend_.saw(Sign::kTrain);
    if (shown.disc) legend_.saw(Sign::kBall);
    if (shown.balloon) legend_.saw(Sign::kBalloon);
    if (shown.drone) legend_.saw(Sign::kDrone);
  }
  if (options_.layers.shows(Layer::kNames))
    for (const TruthState& object : frame.truth.objects)
      for (const ObjectInfo& info : scene_.objects)
        if (info.id == object.id) {
          const Pixel at = view.to_pixel(object.position);
          part.text(fonts_.regular, drawable(info.name, 24), panel_style_.letters(12),
                    {at.x, at.y + panel_style_.length(26)}, dark::kMutedText,
                    Canvas::Align::kCentre);
        }
  if (options_.layers.shows(Layer::kFieldOfView) && has_field_of_view(scene_))
    legend_.saw(Sign::kFieldOfView);
  draw_detections(part, view, frame);
  painters_[index].draw(part, view, scene_, frame, frame.panels[index], options_.layers,
                        panel_style_, fonts_, legend_);
}

void Picture::draw_detections(Canvas& canvas, const View& view, const VideoFrame& frame) {
  const bool detections = options_.layers.shows(Layer::kDetections);
  const bool clutter = options_.layers.shows(Layer::kClutter);
  for (const Observation& observation : frame.observations) {
    const double age = (frame.time - observation.scan.time) / kDetectionSeconds;
    if (!(age < 1.0)) continue;
    const double fade = std::clamp(age, 0.0, 1.0);
    for (std::size_t i = 0; i < observation.scan.detections.size(); ++i) {
      const Pixel at = view.to_pixel(observation.scan.detections[i].position);
      const bool is_clutter =
          i < observation.origins.size() && observation.origins[i] == kClutterOrigin;
      if (is_clutter && clutter) {
        canvas.disc(at, panel_style_.length(2.5), {dark::kClutter, 1.0 - fade});
        legend_.saw(Sign::kClutter);
      }
      if (!is_clutter && detections) {
        canvas.cross(at, panel_style_.length(5), {dark::kDetection, 1.0 - fade},
                     panel_style_.length(1.5));
        legend_.saw(Sign::kDetection);
      }
    }
  }
}

void Picture::draw_header(Canvas& canvas, const PanelFrame& panel, std::size_t index) {
  const Viewport& area = layout_.headers[index];
  const int letters = style_.letters(15);
  const double baseline = area.top + 0.5 * area.height + 0.36 * letters;
  double x = area.left + style_.length(12);
  const Color color = panel_color(index);
  canvas.disc({x + style_.length(5), area.top + 0.5 * area.height}, style_.length(5), color);
  x += style_.length(18);
  const int space = static_cast<int>(area.width);
  const std::u32string name =
      fonts_.bold.fitted(drawable(scene_.panels[index].name), letters, space / 2);
  canvas.text(fonts_.bold, name, letters, {x, baseline}, dark::kText);
  x += fonts_.bold.width(name, letters) + style_.length(12);
  double right = area.right() - style_.length(12);
  std::u32string scores;
  if (panel.rmse) scores += U"RMSE " + number("%.2f m", *panel.rmse);
  if (panel.gospa) scores += U"  GOSPA " + number("%.2f m", *panel.gospa);
  if (!scores.empty()) {
    canvas.text(fonts_.regular, scores, letters, {right, baseline}, dark::kText,
                Canvas::Align::kRight);
    right -= fonts_.regular.width(scores, letters) + style_.length(12);
  }
  const int small = style_.letters(13);
  const int rest = static_cast<int>(right - x);
  if (rest > 4 * small)
    canvas.text(fonts_.regular,
                fonts_.regular.fitted(drawable(scene_.panels[index].gains), small, rest), small,
                {x, baseline}, dark::kMutedText);
}

void Picture::draw_hud(Canvas& canvas, const VideoFrame& frame) {
  const Viewport& area = layout_.hud;
  const double margin = style_.length(16);
  const double first = area.top + style_.length(25);
  const double second = area.top + style_.length(45);
  const int title_letters = style_.letters(19);
  const int letters = style_.letters(14);

  const std::u32string time = number("%.2f s", frame.time);
  canvas.text(fonts_.bold, time, title_letters, {area.right() - margin, first}, dark::kText,
              Canvas::Align::kRight);
  const int title_space =
      static_cast<int>(area.width - 4.0 * margin - fonts_.bold.width(U"0000.00 s", title_letters));
  canvas.text(fonts_.bold, fonts_.bold.fitted(drawable(scene_.title), title_letters, title_space),
              title_letters, {margin, first}, dark::kText);

  std::u32string counts = U"scan " + drawable(std::to_string(frame.scans));
  if (frame.panels.size() == 1) {
    const PanelFrame& panel = frame.panels.front();
    const auto count = [&](TrackStatus status) {
      return std::to_string(
          std::count_if(panel.tracks.tracks.begin(), panel.tracks.tracks.end(),
                        [status](const TrackEstimate& track) { return track.status == status; }));
    };
    counts += U"    objects " + drawable(std::to_string(frame.truth.objects.size())) +
              U"    confirmed " + drawable(count(TrackStatus::kConfirmed)) + U"    coasting " +
              drawable(count(TrackStatus::kCoasting)) + U"    tentative " +
              drawable(count(TrackStatus::kTentative));
    if (panel.gospa) counts += U"    GOSPA " + number("%.2f m", *panel.gospa);
    if (panel.rmse) counts += U"    RMSE " + number("%.2f m", *panel.rmse);
  }
  canvas.text(fonts_.regular, counts, letters, {area.right() - margin, second}, dark::kMutedText,
              Canvas::Align::kRight);

  std::u32string facts = U"seed " + drawable(std::to_string(scene_.seed));
  for (const SensorDrawing& sensor : scene_.sensors)
    facts += U"    " + drawable(sensor.name, 24) + U" " + number("%.3g Hz", sensor.rate);
  if (options_.slow > 1.0) facts += U"    " + number("%.3g× slow motion", options_.slow);
  if (options_.slow < 1.0) facts += U"    " + number("%.3g× faster", 1.0 / options_.slow);
  const int space =
      static_cast<int>(area.width - 4.0 * margin) - fonts_.regular.width(counts, letters);
  canvas.text(fonts_.regular, fonts_.regular.fitted(facts, letters, std::max(0, space)), letters,
              {margin, second}, dark::kMutedText);
}

}  // namespace ghtrack::render
