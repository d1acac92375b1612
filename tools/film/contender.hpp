#pragma once

#include <string>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "tools/film/running_score.hpp"
#include "tools/pipeline/scene_tracker.hpp"
#include "tools/render/video.hpp"

namespace ghtrack::film {

/// The scene's tracker with one filter for every target.
TrackerConfig with_filter(TrackerConfig tracker, const FilterConfig& filter);

/// A tracker that follows the detections of a run beside the scene's own: one of several filters
/// that are compared, or one that somebody plays with.
class Contender {
 public:
  /// @throws std::invalid_argument if a filter cannot be designed for the scene's sensors
  Contender(const WorldScene& scene, const std::string& name, TrackerConfig tracker);

  const render::PanelDrawing& drawing() const { return drawing_; }

  /// Processes a scan that has arrived.
  void add(const Observation& observation);

  /// Compares what it says now with the truth of that instant.
  void score(const TruthSnapshot& truth);

  /// What it says now.
  render::PanelFrame frame() const;

 private:
  render::PanelDrawing drawing_;
  SceneTracker tracker_;
  RunningScore score_;
};

/// One for each filter under `compare` in the scene.
std::vector<Contender> contenders_of(const WorldScene& scene);

}  // namespace ghtrack::film
