#include "tools/render/track_painter.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tools/render/text.hpp"
#include "tools/render/truth_painter.hpp"

namespace ghtrack::render {

namespace {

constexpr double kTrailSeconds = 3.0;
constexpr double kEventSeconds = 1.2;
constexpr double kLabelSeconds = 0.25;    // a speed can be read that long
constexpr double kGateSquared = 9.21034;  // 99 % of χ² with two degrees of freedom
constexpr double kFanSeconds = 1.0;
constexpr double kRing = 10.0;       // radius of the estimate's ring [px]
constexpr double kLabelGain = 0.25;  // of a new position on the place of its label

}  // namespace

Vec2 predicted_position(const TrackEstimate& track, double ahead) {
  return track.position + ahead * track.velocity + 0.5 * ahead * ahead * track.acceleration;
}

Color TrackPainter::color_of(const TrackEstimate& track) const {
  if (track.status == TrackStatus::kTentative) return dark::kTentative;
  if (color_) return *color_;
  const auto trace = traces_.find(track.id);
  const bool has_own = trace != traces_.end() && trace->second.color;
  return has_own ? kTrackColors[*trace->second.color] : track_color(track.id);
}

/// Tracks that are alive together look different as long as there are colours.
std::size_t TrackPainter::least_used_color() const {
  std::array<int, kTrackColors.size()> uses{};
  for (const auto& [id, trace] : traces_) {
    if (trace.color) ++uses[*trace.color];
  }
  return static_cast<std::size_t>(std::min_element(uses.begin(), uses.end()) - uses.begin());
}

std::u32string TrackPainter::label_text(const TrackEstimate& track) const {
  char numbers[48];
  const double speed = track.velocity.norm();
  std::snprintf(numbers, sizeof numbers, " %.*f m/s", speed < 99.95 ? 1 : 0, speed);
  std::u32string text = U"#";
  text += drawable(std::to_string(track.id));
  const std::u32string label = drawable(track.label, 16);
  if (!label.empty()) text += U" " + label;
  if (color_) return text;  // among several panels space is short
  return std::isfinite(speed) && speed < 1e6 ? text + U" " + drawable(numbers) : text;
}

void TrackPainter::draw_gate(Canvas& canvas, const View& view, const TrackEstimate& track,
                             const Style& style) const {
  if (!track.innovation_covariance.allFinite()) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(track.innovation_covariance);
  const auto half_axis = [&](int i) {
    const double length =
        std::sqrt(kGateSquared * std::max(0.0, solver.eigenvalues()[i])) * view.scale();
    const Vec2 direction = solver.eigenvectors().col(i);
    return Pixel{length * direction.x(), -length * direction.y()};
  };
  canvas.outline(ellipse_outline(view.to_pixel(track.prior_position), half_axis(0), half_axis(1)),
                 {color_of(track), 0.5}, style.length(1.1));
}

void TrackPainter::draw_residual(Canvas& canvas, const View& view, const TrackEstimate& track,
                                 const Style& style) const {
  const Pixel prior = view.to_pixel(track.prior_position);
  const Color color = color_of(track);
  const double r = style.length(3.5);
  if (track.residual)
    canvas.line(prior, view.to_pixel(track.prior_position + *track.residual), color,
                style.length(1.5));
  canvas.polygon({{prior.x - r, prior.y},
                  {prior.x, prior.y - r},
                  {prior.x + r, prior.y},
                  {prior.x, prior.y + r}},
                 color);
}

void TrackPainter::draw_estimate(Canvas& canvas, Pixel at, const TrackEstimate& track,
                                 const Style& style) const {
  const double ring = style.length(track.status == TrackStatus::kTentative ? 6.0 : kRing);
  const double thickness = style.length(track.status == TrackStatus::kTentative ? 1.0 : 2.0);
  if (track.status == TrackStatus::kCoasting) {
    std::vector<Pixel> outline = ellipse_outline(at, {ring, 0.0}, {0.0, ring});
    outline.push_back(outline.front());
    canvas.dashed(outline, color_of(track), style.length(5), style.length(4.4), thickness);
  } else {
    canvas.ring(at, ring, color_of(track), thickness);
  }
}

void TrackPainter::remember(const VideoFrame& frame, const PanelFrame& panel) {
  if (panel.tracks.time > snapshot_time_ || panel.tracks.sensor != snapshot_sensor_) {
    snapshot_time_ = panel.tracks.time;
    snapshot_sensor_ = panel.tracks.sensor;
    for (auto& [id, trace] : traces_) trace.seen = false;
    for (const TrackEstimate& track : panel.tracks.tracks) {
      const auto [entry, is_new] = traces_.try_emplace(track.id);
      Trace& trace = entry->second;
      if (is_new) trace.label_position = track.position;
      trace.seen = true;
      trace.last = track;
      if (!trace.color && track.status != TrackStatus::kTentative) trace.color = least_used_color();
      trace.trail.emplace_back(panel.tracks.time, track.position);
    }
    note_switches(frame, panel);
    for (const auto& [id, trace] : traces_)
      if (!trace.seen && trace.last.status != TrackStatus::kTentative)
        events_.push_back({Sign::kLost, snapshot_time_, trace.last.position, color_of(trace.last)});
    std::erase_if(traces_, [](const auto& entry) { return !entry.second.seen; });
  }

  const double since = std::max(0.0, frame.time - frame_time_.value_or(frame.time));
  frame_time_ = frame.time;
  for (auto& [id, trace] : traces_) {
    while (!trace.trail.empty() && trace.trail.front().first < frame.time - kTrailSeconds)
      trace.trail.pop_front();
    const Vec2 now =
        predicted_position(trace.last, std::clamp(frame.time - snapshot_time_, 0.0, 1.0));
    trace.label_position += since * trace.last.velocity;
    trace.label_position += kLabelGain * (now - trace.label_position);
    if (!trace.label_position.allFinite()) trace.label_position = now;
    if (trace.label.empty() || frame.time - trace.label_time >= kLabelSeconds) {
      trace.label = label_text(trace.last);
      trace.label_time = frame.time;
    }
  }
  std::erase_if(events_,
                [&](const Event& event) { return frame.time - event.time > kEventSeconds; });
}

/// An object whose detection fed one confirmed track before and feeds another one now.
void TrackPainter::note_switches(const VideoFrame& frame, const PanelFrame& panel) {
  for (const Observation& observation : frame.observations) {
    if (observation.scan.time != panel.tracks.time ||
        observation.scan.sensor != panel.tracks.sensor)
      continue;
    for (const TrackEstimate& track : panel.tracks.tracks) {
      if (track.status != TrackStatus::kConfirmed || !track.detection ||
          *track.detection >= observation.origins.size())
        continue;
      const ObjectId object = observation.origins[*track.detection];
      if (object == kClutterOrigin) continue;
      const auto [entry, is_new] = track_of_object_.try_emplace(object, track.id);
      if (!is_new && entry->second != track.id)
        events_.push_back({Sign::kSwitch, panel.tracks.time, track.position, color_of(track)});
      entry->second = track.id;
    }
  }
}

void TrackPainter::draw(Canvas& canvas, const View& view, const SceneDrawing& scene,
                        const VideoFrame& frame, const PanelFrame& panel, Layers layers,
                        const Style& style, const Typefaces& fonts, Legend& legend) {
  const double ahead = std::clamp(frame.time - panel.tracks.time, 0.0, 1.0);
  if (layers.shows(Layer::kTrails)) {
    draw_trails(canvas, view, frame.time, style);
    if (!traces_.empty()) legend.saw(Sign::kTrail);
  }
  for (const TrackEstimate& track : panel.tracks.tracks) {
    if (track.status == TrackStatus::kTentative) continue;
    if (layers.shows(Layer::kGates)) {
      draw_gate(canvas, view, track, style);
      legend.saw(Sign::kGate);
    }
    if (layers.shows(Layer::kResiduals)) {
      draw_residual(canvas, view, track, style);
      legend.saw(Sign::kResidual);
    }
    if (layers.shows(Layer::kFans)) {
      for (int i = 1; i <= 5; ++i)
        canvas.disc(view.to_pixel(predicted_position(track, ahead + 0.2 * i * kFanSeconds)),
                    style.length(2.0), {color_of(track), 1.0 - 0.15 * i});
      legend.saw(Sign::kFan);
    }
  }
  if (layers.shows(Layer::kTracks)) {
    for (const TrackEstimate& track : panel.tracks.tracks) {
      draw_estimate(canvas, view.to_pixel(predicted_position(track, ahead)), track, style);
      legend.saw(track.status == TrackStatus::kTentative  ? Sign::kTentative
                 : track.status == TrackStatus::kCoasting ? Sign::kCoasting
                                                          : Sign::kTrack);
    }
    draw_events(canvas, view, frame.time, style, legend);
  }
  if (layers.shows(Layer::kLabels)) draw_labels(canvas, view, scene, frame, style, fonts);
}

void TrackPainter::draw_trails(Canvas& canvas, const View& view, double now,
                               const Style& style) const {
  for (const auto& [id, trace] : traces_) {
    if (trace.last.status == TrackStatus::kTentative) continue;
    std::vector<Pixel> points;
    std::vector<double> opacities;
    for (const auto& [time, position] : trace.trail) {
      points.push_back(view.to_pixel(position));
      opacities.push_back(0.75 * std::clamp(1.0 - (now - time) / kTrailSeconds, 0.0, 1.0));
    }
    canvas.fading(points, opacities, color_of(trace.last), style.length(2));
  }
}

void TrackPainter::draw_events(Canvas& canvas, const View& view, double now, const Style& style,
                               Legend& legend) const {
  for (const Event& event : events_) {
    const double age = std::clamp((now - event.time) / kEventSeconds, 0.0, 1.0);
    const Pixel at = view.to_pixel(event.position);
    if (event.sign == Sign::kLost)
      canvas.cross(at, style.length(kRing), {event.color, 1.0 - age}, style.length(2));
    else
      canvas.ring(at, style.length(kRing + 16.0 * age), mix(dark::kDetection, dark::kWorld, age),
                  style.length(3));
    legend.saw(event.sign);
  }
}

void TrackPainter::draw_labels(Canvas& canvas, const View& view, const SceneDrawing& scene,
                               const VideoFrame& frame, const Style& style,
                               const Typefaces& fonts) {
  const int letters = style.letters(15);
  const double height = 1.3 * letters;
  const Viewport& area = view.viewport();
  std::vector<LabelRequest> requests;
  std::vector<const Trace*> named;
  std::vector<Viewport> obstacles;
  for (const auto& [id, trace] : traces_) {
    if (trace.last.status == TrackStatus::kTentative) continue;
    const Pixel anchor = view.to_pixel(trace.label_position);
    const double reach = style.length(kRing + 2.0);
    const bool visible = anchor.x > area.left && anchor.x < area.right() && anchor.y > area.top &&
                         anchor.y < area.bottom();
    if (!visible) continue;
    requests.push_back(
        {id, anchor, reach, fonts.regular.width(trace.label, letters) + style.length(8), height});
    named.push_back(&trace);
    obstacles.push_back({anchor.x - reach, anchor.y - reach, 2.0 * reach, 2.0 * reach});
  }
  for (const Viewport& body : drawn_bodies(view, scene, frame.truth, style))
    obstacles.push_back(body);
  const Viewport inside{area.left + style.length(4), area.top + style.length(4),
                        area.width - style.length(8), area.height - style.length(30)};
  const auto places = labels_.place(requests, obstacles, inside);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    const Viewport& place = *places[i];
    const Color color = color_of(named[i]->last);
    const Pixel anchor = requests[i].anchor;
    const Pixel nearest{std::clamp(anchor.x, place.left, place.right()),
                        std::clamp(anchor.y, place.top, place.bottom())};
    const double distance = std::hypot(nearest.x - anchor.x, nearest.y - anchor.y);
    if (distance > requests[i].reach + height) {
      const double share = requests[i].reach / distance;
      canvas.line(
          {anchor.x + share * (nearest.x - anchor.x), anchor.y + share * (nearest.y - anchor.y)},
          nearest, {color, 0.6}, style.length(1.2));
    }
    canvas.rimmed_text(fonts.regular, named[i]->label, letters,
                       {place.left + style.length(4), place.bottom() - 0.32 * letters},
                       mix(color, dark::kDetection, 0.25), dark::kWorld);
  }
}

}  // namespace ghtrack::render
