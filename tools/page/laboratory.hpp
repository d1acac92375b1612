#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "tools/page/recording.hpp"
#include "tools/run/contender.hpp"

namespace ghtrack::page {

/// One track after one scan, as the page draws it. Numbers only, so that a browser can read a list
/// of them as it lies in memory.
struct TrackRow {
  double scan;  // index among all scans in the order in which they arrived
  double id;
  double status;  // TrackStatus
  double filter;  // index into Laboratory::words()
  double label;   // the same
  double x, y, vx, vy, ax, ay;
  double x_pred, y_pred;
  double rx, ry;  // NaN where no detection was used
  double sigma_x, sigma_y;
  double s_xx, s_xy, s_yy;  // covariance of the residual: the gate
  double p_xx, p_xy, p_yy;  // covariance of the error
  double existence;         // NaN where it is not weighed
  double nis;               // NaN without a residual
  double object;            // that it follows; -1: none
};

/// One detection.
struct DetectionRow {
  double scan;  // index among all scans in the order of time
  double x, y;
  double r_xx, r_xy, r_yy;  // covariance of its error
  double label;             // index into words()
  double origin;            // -1: clutter
};

/// One look of a sensor, or the arrival of one at a tracker.
struct ScanRow {
  double time;
  double sensor;
  double first;  // row of its first detection, or track
  double count;
};

/// What one tracker made of a run.
struct Answer {
  std::vector<ScanRow> scans;  // in the order of arrival, those that came in order
  std::vector<TrackRow> tracks;
};

/// Looks at a recorded truth with the sensors, follows it with the trackers and scores them, again
/// and again, as the settings are turned: what the page computes.
class Laboratory {
 public:
  /// @param scene  a RecordedScene in flow style
  /// @throws SceneError, std::invalid_argument if one of the two cannot be read
  Laboratory(std::string_view scene, std::span<const double> truth);

  /// Runs the sensors and trackers of a Setting in flow style over the whole truth.
  /// @throws SceneError if the text is wrong, std::invalid_argument if a filter cannot be designed
  void run(std::string_view setting);

  const std::vector<ScanRow>& scans() const { return scans_; }  // in the order of time
  const std::vector<DetectionRow>& detections() const { return detections_; }
  /// Of the tracker and, if there is one, the other.
  const std::vector<Answer>& answers() const { return answers_; }
  /// Names of filters and classes that rows refer to.
  const std::vector<std::string>& words() const { return words_; }

  /// metrics.json of one of the trackers in the latest setting. Runs all of it again, because some
  /// of the metrics cost more than the tracking.
  std::string metrics(std::size_t contender) const;

  /// A filter in flow style as JSON.
  /// @throws SceneError if the text is none
  static std::string filter_json(std::string_view filter);

  /// What closed forms say of a filter, in flow style, at the coarsest noise and the quickest scan
  /// of the latest setting, as JSON: gains, stability, damping, noise reduction, lag.
  std::string theory(std::string_view filter) const;

 private:
  class Notes;
  std::size_t word(std::string_view text);

  WorldScene scene_;
  std::shared_ptr<const TruthRecording> truth_;
  std::vector<Contender> contenders_;
  std::vector<ScanRow> scans_;
  std::vector<DetectionRow> detections_;
  std::vector<Answer> answers_;
  std::vector<std::string> words_;
};

/// Runs the filters of a SeriesScene in flow style over its measurements. What they made of them,
/// as JSON.
/// @throws SceneError if the text is wrong
std::string run_series(std::string_view scene);

}  // namespace ghtrack::page
