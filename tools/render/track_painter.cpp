#include "tools/render/track_painter.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>
#include <vector>

namespace ghtrack::render {

namespace {

constexpr double kGateSquared = 9.21034;  // 99 % of χ² with two degrees of freedom
constexpr int kFanSteps = 5;
constexpr double kFanStep = 0.2;  // [s]

class TrackPainter {
 public:
  TrackPainter(Canvas& canvas, const Stage& stage, const TrackMemory& memory, double ahead)
      : canvas_(canvas), stage_(stage), memory_(memory), ahead_(ahead) {}

  void trails() {
    for (const TrackMemory::Past& past : memory_.past()) trail(past.trail, past.color);
    for (const auto& [id, trace] : memory_.traces()) {
      if (trace.last.status == TrackStatus::kTentative) continue;
      trail(trace.trail, memory_.color_of(trace.last));
    }
  }

  void gate(const TrackEstimate& track) {
    if (!track.innovation_covariance.allFinite()) return;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(track.innovation_covariance);
    const auto half_axis = [&](int i) {
      const double reach =
          std::sqrt(kGateSquared * std::max(0.0, solver.eigenvalues()[i])) * stage_.view.scale();
      const Vec2 direction = solver.eigenvectors().col(i);
      return Pixel{reach * direction.x(), -reach * direction.y()};
    };
    const Pixel prior = stage_.view.to_pixel(track.prior_position);
    canvas_.outline(ellipse_outline(prior, half_axis(0), half_axis(1)),
                    {memory_.color_of(track), 0.5}, length(1.1));
  }

  /// The prior as a diamond, and an arrow from it to the detection.
  void residual(const TrackEstimate& track) {
    const Pixel prior = stage_.view.to_pixel(track.prior_position);
    const Color color = memory_.color_of(track);
    const double r = length(3.5);
    canvas_.polygon({{prior.x - r, prior.y},
                     {prior.x, prior.y - r},
                     {prior.x + r, prior.y},
                     {prior.x, prior.y + r}},
                    color);
    if (track.residual)
      canvas_.arrow(prior, stage_.view.to_pixel(track.prior_position + *track.residual), length(7),
                    color, length(1.5));
  }

  void fan(const TrackEstimate& track) {
    for (int i = 1; i <= kFanSteps; ++i)
      canvas_.disc(stage_.view.to_pixel(predicted_position(track, ahead_ + kFanStep * i)),
                   length(2.0), {memory_.color_of(track), 1.0 - 0.15 * i});
  }

  void estimate(const TrackEstimate& track) {
    const bool is_tentative = track.status == TrackStatus::kTentative;
    const Pixel at = stage_.view.to_pixel(predicted_position(track, ahead_));
    const double ring = length(is_tentative ? 6.0 : kEstimateRing);
    const double thickness = length(is_tentative ? 1.0 : 2.0);
    const Color color = memory_.color_of(track);
    if (!is_tentative)
      canvas_.ring(at, ring, {stage_.style.theme().world, 0.55}, thickness + length(2.0));
    if (track.status != TrackStatus::kCoasting) return canvas_.ring(at, ring, color, thickness);
    std::vector<Pixel> outline = ellipse_outline(at, {ring, 0.0}, {0.0, ring});
    outline.push_back(outline.front());
    canvas_.dashed(outline, color, length(5), length(4.4), thickness);
  }

  void events() {
    for (const TrackMemory::Event& event : memory_.events()) {
      const double age = memory_.event_age(event.time);
      const Pixel at = stage_.view.to_pixel(event.position);
      if (event.what == TrackMemory::Happening::kLost)
        canvas_.cross(at, length(kEstimateRing), {event.color, 1.0 - age}, length(2));
      else
        canvas_.ring(at, length(kEstimateRing + 3.0 + 13.0 * age),
                     {stage_.style.theme().detection, 1.0 - age}, length(3));
    }
  }

 private:
  double length(double pixels) const { return stage_.style.length(pixels); }

  void trail(const std::deque<std::pair<double, Vec2>>& trail, Color color) {
    std::vector<Pixel> points;
    std::vector<double> opacities;
    for (const auto& [time, position] : trail) {
      points.push_back(stage_.view.to_pixel(position));
      opacities.push_back(0.85 * (1.0 - memory_.trail_age(time)));
    }
    canvas_.fading(points, opacities, color, length(2));
  }

  Canvas& canvas_;
  const Stage& stage_;
  const TrackMemory& memory_;
  double ahead_;  // [s] from the estimates to the frame
};

}  // namespace

void draw_tracks(Canvas& canvas, const Stage& stage, const TrackMemory& memory,
                 const VideoFrame& frame, const PanelFrame& panel) {
  const double ahead = std::clamp(frame.time - panel.tracks.time, 0.0, 1.0);
  TrackPainter painter(canvas, stage, memory, ahead);
  if (stage.shows(Layer::kTrails)) painter.trails();
  for (const TrackEstimate& track : panel.tracks.tracks) {
    if (track.status == TrackStatus::kTentative) continue;
    if (stage.shows(Layer::kGates)) painter.gate(track);
    if (stage.shows(Layer::kResiduals)) painter.residual(track);
    if (stage.shows(Layer::kFans)) painter.fan(track);
  }
  for (const TrackEstimate& track : panel.tracks.tracks) {
    const bool is_tentative = track.status == TrackStatus::kTentative;
    if (stage.shows(is_tentative ? Layer::kTentative : Layer::kTracks)) painter.estimate(track);
  }
  if (stage.shows(Layer::kEvents)) painter.events();
}

void draw_smoothed(Canvas& canvas, const Stage& stage, const TrackMemory& memory,
                   const SmoothedPaths& paths, double time) {
  for (const auto& [id, path] : paths) {
    std::vector<Pixel> points;
    std::vector<double> opacities;
    for (const auto& [when, position] : path) {
      const double age = memory.trail_age(when);
      if (when > time || age >= 1.0) continue;
      points.push_back(stage.view.to_pixel(position));
      opacities.push_back(1.0 - age);
    }
    canvas.fading(points, opacities, stage.style.theme().text, stage.style.length(1.4));
  }
}

}  // namespace ghtrack::render
