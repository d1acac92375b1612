#include "tools/render/picture.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tools/render/backdrop.hpp"
#include "tools/render/hud.hpp"
#include "tools/render/text.hpp"
#include "tools/render/track_painter.hpp"
#include "tools/render/truth_painter.hpp"
#include "tools/render/wind_painter.hpp"

namespace ghtrack::render {

namespace {

constexpr double kDetectionSeconds = 1.0;  // of the video, in which a detection fades away
constexpr double kSmallUnit = 0.8;         // signs are smaller when panels share the picture

/// Whether the error of a detection is larger in one direction, as a radar's is.
bool is_elongated(const Eigen::Matrix2d& covariance) {
  const double mean = 0.5 * covariance.trace();
  return covariance.determinant() < 0.8 * mean * mean;
}

std::vector<Pixel> outline_of(const Viewport& box) {
  return {{box.left, box.top},
          {box.right(), box.top},
          {box.right(), box.bottom()},
          {box.left, box.bottom()}};
}

/// What a close-up shows, in the picture of all; labels lie over it.
void draw_frame_of(Canvas& canvas, const View& close_up, const Stage& stage) {
  const Rectangle& world = close_up.world();
  const Pixel from = stage.view.to_pixel({world.min.x(), world.max.y()});
  const Pixel to = stage.view.to_pixel({world.max.x(), world.min.y()});
  canvas.outline(outline_of({from.x, from.y, to.x - from.x, to.y - from.y}),
                 {stage.style.theme().muted_text, 0.8}, stage.style.length(1));
}

/// The 1-sigma ellipse of its error.
void draw_ellipse(Canvas& canvas, const Stage& stage, const Detection& detection, const Ink& ink) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(detection.covariance);
  const auto half_axis = [&](int i) {
    const double reach = std::sqrt(std::max(0.0, solver.eigenvalues()[i])) * stage.view.scale();
    const Vec2 direction = solver.eigenvectors().col(i);
    return Pixel{reach * direction.x(), -reach * direction.y()};
  };
  canvas.outline(
      ellipse_outline(stage.view.to_pixel(detection.position), half_axis(0), half_axis(1)), ink,
      stage.style.length(1));
}

Style style_of(const VideoOptions& options) {
  Style style = Style::of_picture(options.width, options.height);
  style.text = options.text;
  style.colors = options.theme == VideoTheme::kLight ? &kLight : &kDark;
  return style;
}

/// Slow motion shows as much of the past as real time does; time lapse shows more.
double trail_of(const VideoOptions& options, const SceneDrawing& scene) {
  if (options.trail >= scene.duration) return std::numeric_limits<double>::infinity();
  return options.trail / std::min(1.0, options.slow);
}

Style style_of_panels(Style style, const SceneDrawing& scene) {
  if (scene.panels.size() > 1) style.unit *= kSmallUnit;
  return style;
}

}  // namespace

Picture::Picture(const VideoOptions& options, const SceneDrawing& scene)
    : options_(options),
      scene_(scene),
      style_(style_of(options)),
      panel_style_(style_of_panels(style_, scene)),
      legend_(options_, scene_, style_, panel_style_, fonts_),
      camera_(options_, scene_),
      past_(trail_of(options, scene), scene.duration),
      errors_(0.0, scene.duration),
      insets_(options.slow) {
  options_.close_ups = place_close_ups(options_, scene_, style_, legend_.height());
  layout_ = lay_out(options_, scene_, style_, legend_.height());
  const bool compares = layout_.panels.size() > 1;
  for (std::size_t i = 0; i < layout_.panels.size(); ++i) {
    const TrackMemory::Manner manner{
        .color = compares ? std::optional(style_.theme().track(static_cast<int>(i))) : std::nullopt,
        .slow = options.slow,
        .trail = trail_of(options, scene),
        .theme = &style_.theme()};
    panels_.push_back(
        {camera_.view(options.from, layout_.panels[i]), TrackMemory(manner, scene_.objects), {}});
  }
}

Stage Picture::stage_of(const View& view, std::span<const Viewport> covered) const {
  return {view, scene_, options_.layers, panel_style_, fonts_, covered};
}

void Picture::remember(const VideoFrame& frame) {
  take_note_of(frame);
  for (std::size_t i = 0; i < panels_.size() && i < frame.panels.size(); ++i) {
    const View view = camera_.view(frame.time, layout_.panels[i]);
    write_labels(nullptr, stage_of(view, layout_.close_ups[i]), frame, i);
  }
}

void Picture::take_note_of(const VideoFrame& frame) {
  camera_.remember(frame.truth);
  past_.remember(frame);
  for (std::size_t i = 0; i < panels_.size() && i < frame.panels.size(); ++i) {
    panels_[i].memory.remember(frame, frame.panels[i]);
    for (const ScanReport& report : frame.panels[i].arrived) errors_.add(i, report);
  }
  if (panels_.size() == 1 && options_.layers.shows(Layer::kInsets) && !frame.panels.empty())
    insets_.remember(frame, frame.panels.front(), panels_.front().memory);
}

/// Around what is drawn above the panel.
void Picture::write_labels(Canvas* canvas, const Stage& stage, const VideoFrame& frame,
                           std::size_t panel) {
  std::vector<Viewport> keep_out;
  for (std::size_t k = 0; k < options_.close_ups.size(); ++k) {
    if (close_up_view(frame.truth, k, panel)) keep_out.push_back(layout_.close_ups[panel][k]);
  }
  panels_[panel].labels.draw(canvas, stage, panels_[panel].memory, frame, keep_out);
}

void Picture::draw(const VideoFrame& frame, cv::Mat& image) {
  take_note_of(frame);
  std::vector<View> views;
  for (const Viewport& panel : layout_.panels) views.push_back(camera_.view(frame.time, panel));
  if (still_parts_.empty() || views != still_views_) draw_still_parts(std::move(views));
  still_parts_.copyTo(image);

  Canvas canvas(image);
  std::optional<double> best;  // of the panels that have a score
  for (const PanelFrame& panel : frame.panels) {
    if (panel.gospa && (!best || *panel.gospa < *best)) best = panel.gospa;
  }
  for (std::size_t i = 0; i < panels_.size() && i < frame.panels.size(); ++i) {
    const Stage stage = stage_of(still_views_[i], layout_.close_ups[i]);
    Canvas part = canvas.within(layout_.panels[i]);
    draw_world(part, stage, frame, i);
    std::vector<std::optional<View>> near_by;
    for (std::size_t k = 0; k < options_.close_ups.size(); ++k) {
      near_by.push_back(close_up_view(frame.truth, k, i));
      if (near_by.back()) draw_frame_of(part, *near_by.back(), stage);
    }
    write_labels(&part, stage, frame, i);
    if (panels_.size() > 1)
      draw_header(canvas, layout_.headers[i], scene_.panels[i], frame.panels[i],
                  style_.theme().track(static_cast<int>(i)), frame.panels[i].gospa == best, style_,
                  fonts_);
    for (std::size_t k = 0; k < near_by.size(); ++k) {
      if (near_by[k]) draw_close_up(canvas, *near_by[k], frame, k, i);
    }
  }
  if (panels_.size() > 1)
    errors_.draw(canvas, layout_.plots, style_, fonts_);
  else if (options_.layers.shows(Layer::kInsets))
    insets_.draw(canvas, layout_.plots, style_, fonts_);
  if (options_.layers.shows(Layer::kHud))
    draw_hud(canvas, layout_.hud, options_, scene_, frame, style_, fonts_);
}

void Picture::draw_still_parts(std::vector<View> views) {
  still_views_ = std::move(views);
  still_parts_.create(options_.height, options_.width, CV_8UC3);
  Canvas canvas(still_parts_);
  canvas.fill(style_.theme().page);
  for (std::size_t i = 0; i < still_views_.size(); ++i) {
    Canvas panel = canvas.within(still_views_[i].viewport());
    draw_backdrop(panel, stage_of(still_views_[i], layout_.close_ups[i]), AxisNumbers::kShown);
  }
  legend_.draw(canvas, layout_.legend);
}

void Picture::draw_world(Canvas& canvas, const Stage& stage, const VideoFrame& frame,
                         std::size_t panel) {
  if (stage.shows(Layer::kWind)) draw_wind(canvas, stage, frame.time);
  past_.draw(canvas, stage);
  if (stage.shows(Layer::kTruth)) draw_truth(canvas, stage, frame.truth);
  draw_detections(canvas, stage, frame);
  if (stage.shows(Layer::kSmoothed) && panel < scene_.smoothed.size())
    draw_smoothed(canvas, stage, panels_[panel].memory, scene_.smoothed[panel], frame.time);
  draw_tracks(canvas, stage, panels_[panel].memory, frame, frame.panels[panel]);
  if (stage.shows(Layer::kGrid)) draw_scale_bar(canvas, stage);
}

void Picture::draw_detections(Canvas& canvas, const Stage& stage, const VideoFrame& frame) const {
  const bool shows_detections = stage.shows(Layer::kDetections);
  const bool shows_clutter = stage.shows(Layer::kClutter);
  for (const Observation& observation : frame.observations) {
    const double age = (frame.time - observation.scan.time) * options_.slow / kDetectionSeconds;
    if (!(age < 1.0)) continue;
    const double opacity = 1.0 - std::clamp(age, 0.0, 1.0);
    for (std::size_t i = 0; i < observation.scan.detections.size(); ++i) {
      const Pixel at = stage.view.to_pixel(observation.scan.detections[i].position);
      const bool is_clutter =
          i < observation.origins.size() && observation.origins[i] == kClutterOrigin;
      if (is_clutter && shows_clutter)
        canvas.disc(at, stage.style.length(2.5), {style_.theme().clutter, opacity});
      if (is_clutter || !shows_detections) continue;
      const Detection& detection = observation.scan.detections[i];
      draw_detection(canvas, observation.scan.sensor, at, stage.style.length(5),
                     {style_.theme().detection, opacity}, stage.style.length(1.5));
      if (is_elongated(detection.covariance)) {
        draw_ellipse(canvas, stage, detection, {style_.theme().detection, 0.7 * opacity});
      }
    }
  }
}

std::optional<View> Picture::close_up_view(const TruthSnapshot& truth, std::size_t close_up,
                                           std::size_t panel) const {
  const CloseUp& wanted = options_.close_ups[close_up];
  const Viewport& area = layout_.close_ups[panel][close_up];
  for (const TruthState& object : truth.objects) {
    if (object.id != wanted.target || !object.position.allFinite()) continue;
    const Vec2 half = 0.5 * wanted.width * Vec2(1.0, area.height / area.width);
    return View({object.position - half, object.position + half}, area);
  }
  return std::nullopt;
}

void Picture::draw_close_up(Canvas& canvas, const View& view, const VideoFrame& frame,
                            std::size_t close_up, std::size_t panel) {
  const Stage stage = stage_of(view, {});
  Canvas part = canvas.within(view.viewport());
  draw_backdrop(part, stage, AxisNumbers::kHidden);
  draw_world(part, stage, frame, panel);
  canvas.outline(outline_of(view.viewport()), style_.theme().muted_text, style_.length(1.5));
  for (const ObjectInfo& object : scene_.objects) {
    if (object.id != options_.close_ups[close_up].target) continue;
    const std::u32string caption = drawable(object.name, 24) + U", near by";
    const int letters = style_.letters(13);
    const Viewport plate{view.viewport().left, view.viewport().top,
                         fonts_.regular.width(caption, letters) + style_.length(16),
                         style_.length(24)};
    part.rectangle(plate, style_.theme().page);
    part.text(fonts_.regular, caption, letters,
              {plate.left + style_.length(8), plate.top + style_.length(17)}, style_.theme().text);
  }
}

}  // namespace ghtrack::render
