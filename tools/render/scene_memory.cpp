#include "tools/render/scene_memory.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ghtrack::render {

namespace {

constexpr double kMostOfPath = 400.0;     // of a path: no picture resolves more
constexpr std::size_t kMostMarks = 1500;  // more would be a carpet

}  // namespace

SceneMemory::SceneMemory(double trail, double duration)
    : trail_(trail), step_(std::min(trail, duration) / kMostOfPath) {}

double SceneMemory::age(double time) const {
  return std::isfinite(trail_) ? std::clamp((now_ - time) / std::max(trail_, 1e-9), 0.0, 1.0) : 0.0;
}

void SceneMemory::remember(const VideoFrame& frame) {
  now_ = frame.time;
  for (const TruthSnapshot& truth : frame.passed) remember(truth);
  remember(frame.truth);
  for (const Observation& observation : frame.arrived) {
    for (std::size_t i = 0; i < observation.scan.detections.size(); ++i) {
      if (i < observation.origins.size() && observation.origins[i] == kClutterOrigin) continue;
      marks_.push_back({observation.scan.time, observation.scan.detections[i].position,
                        observation.scan.sensor});
    }
  }
  while (!marks_.empty() && (marks_.size() > kMostMarks || age(marks_.front().time) >= 1.0)) {
    marks_.pop_front();
  }
  for (auto& [id, path] : paths_) {
    while (!path.empty() && age(path.front().first) >= 1.0) path.pop_front();
  }
}

void SceneMemory::remember(const TruthSnapshot& truth) {
  for (const TruthState& object : truth.objects) {
    auto& path = paths_[object.id];
    if (!path.empty() && path.back().first < known_) path.clear();  // it was not there
    const bool is_due = path.size() < 2 || truth.time - path[path.size() - 2].first >= step_;
    if (!is_due) path.pop_back();  // the latest point is always there
    path.emplace_back(truth.time, object.position);
  }
  known_ = truth.time;
}

void SceneMemory::draw(Canvas& canvas, const Stage& stage) const {
  const Style& style = stage.style;
  if (!stage.shows(Layer::kTrails)) return;
  if (stage.shows(Layer::kDetections)) {
    for (const Mark& mark : marks_) {
      const double opacity = 0.15 + 0.5 * (1.0 - age(mark.time));
      draw_detection(canvas, mark.sensor, stage.view.to_pixel(mark.position), style.length(2.2),
                     {style.theme().detection, opacity}, style.length(1.0));
    }
  }
  if (!stage.shows(Layer::kTruth)) return;
  for (const auto& [id, path] : paths_) {
    if (path.size() < 2) continue;
    std::vector<Pixel> line;
    for (const auto& [time, position] : path) line.push_back(stage.view.to_pixel(position));
    canvas.dashed(line, {style.theme().truth_edge, 0.7}, style.length(5), style.length(4),
                  style.length(1.2));
  }
}

void draw_detection(Canvas& canvas, int sensor, const Pixel& at, double size, const Ink& ink,
                    double thickness) {
  const double r = 1.25 * size;
  switch (sensor % 3) {
    case 1:
      canvas.outline({{at.x - r, at.y}, {at.x, at.y - r}, {at.x + r, at.y}, {at.x, at.y + r}}, ink,
                     thickness);
      break;
    case 2:
      canvas.line({at.x - r, at.y}, {at.x + r, at.y}, ink, thickness);
      canvas.line({at.x, at.y - r}, {at.x, at.y + r}, ink, thickness);
      break;
    default:
      canvas.cross(at, size, ink, thickness);
  }
}

}  // namespace ghtrack::render
