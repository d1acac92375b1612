#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "tools/metrics/gospa.hpp"
#include "tools/render/video.hpp"
#include "tracker/replay.hpp"

namespace ghtrack::cli {

/// One of several filters that follow the same detections: `video --compare`.
class Contender {
 public:
  /// The scene's tracker with this filter for every target.
  /// @throws std::invalid_argument if the filter cannot be designed for the scene's sensors
  Contender(const WorldScene& scene, const std::string& name, const FilterConfig& filter);

  const render::PanelDrawing& drawing() const { return drawing_; }

  /// Processes a scan that has arrived.
  void add(const Observation& observation);

  /// Compares what it says now with the truth of that instant.
  void score(const TruthSnapshot& truth);

  /// What it says now, with the mean GOSPA and the RMSE of its confirmed tracks so far.
  render::PanelFrame frame() const;

 private:
  render::PanelDrawing drawing_;
  TrackerDesign design_;
  GospaOptions options_;
  ReplayState state_;
  double gospa_sum_ = 0.0;  // [m]
  std::int64_t scans_ = 0;
  double square_sum_ = 0.0;  // of the errors of tracks at their targets [m²]
  std::int64_t errors_ = 0;
};

/// The filters that a scene names under `compare`, by name.
/// @throws UsageError if there are fewer than two or more than six
std::vector<Contender> contenders_of(const WorldScene& scene);

}  // namespace ghtrack::cli
