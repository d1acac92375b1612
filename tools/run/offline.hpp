#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "sensors/detection.hpp"
#include "sensors/field_of_view.hpp"
#include "tools/run/box_tracking.hpp"
#include "tracker/track.hpp"
#include "tracker/tracker.hpp"
#include "tracker/tracker_config.hpp"

namespace ghtrack {

/// How somebody else's detections are to be tracked: the file that `ghtrack track --config` reads.
struct OfflineConfig {
  static constexpr std::string_view about = "how the detections of a file are tracked";

  double noise = 1.0;   // 1-sigma error of a detection per axis [m, or pixel]
  double period = 0.0;  // time between scans [s]; 0: the median of the file
  std::vector<Eigen::Vector2d> field_of_view;
  std::optional<double> detection_probability;
  std::optional<double> clutter;  // expected false detections in one look at all of the view
  Coverage scan = Coverage::kWhole;
  TrackerConfig tracker;
  BoxTrackerConfig boxes;
  BoxOutputConfig box_output;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("noise", &OfflineConfig::noise,
            {.unit = "m",
             .meaning = "1-sigma error of a detection per axis",
             .above = 0.0,
             .maximum = 1e6});
    v.field("period", &OfflineConfig::period,
            {.unit = "s",
             .meaning = "time between scans; 0: the median of the file",
             .minimum = 0.0,
             .maximum = 1e6});
    v.field("field_of_view", &OfflineConfig::field_of_view,
            {.unit = "m",
             .meaning = "lower left and upper right corner; without it everything is seen",
             .minimum = -1e7,
             .maximum = 1e7,
             .max_items = 2});
    v.field("detection_probability", &OfflineConfig::detection_probability,
            {.unit = "1",
             .meaning = "chance that an object in view is detected in a scan",
             .above = 0.0,
             .maximum = 1.0});
    v.field("clutter", &OfflineConfig::clutter,
            {.unit = "1",
             .meaning = "expected false detections per scan, anywhere in the field of view",
             .minimum = 0.0,
             .maximum = 1e5});
    v.field("scan", &OfflineConfig::scan,
            {.meaning = "whether a scan shows the `whole` field of view, or `partial`: one object of "
                        "many, as a rotating radar or AIS does; 'period' is then the time between "
                        "two looks at the same object"});
    v.field("tracker", &OfflineConfig::tracker, {.meaning = "the tracker, as in a scene"});
    v.field("boxes", &OfflineConfig::boxes,
            {.meaning = "the tracker of boxes, instead of the above, for MOTChallenge files"});
    v.field("box_output", &OfflineConfig::box_output,
            {.meaning = "which boxes are written for the tracks of a MOTChallenge file"});
  }

  template <class Report>
  void check(Report&& report) const {
    check_field_of_view(field_of_view, report);
    if (tracker.association == Association::kKnown) {
      report("tracker.association", "'known' needs a simulation: a file does not say who is who");
    }
  }
};

/// Recorded scans, one after the other.
struct ScanSource {
  std::function<bool(Scan&)> next;  // the next scan by time; false after the last
  double period = 0.0;              // typical time between scans [s]; 0: unknown
  int sensors = 1;
};

/// What the configuration says of the sensor.
/// @param period  time between scans [s]
SensorTraits traits_of(const OfflineConfig& config, double period);

/// Tracks recorded scans. A detection whose covariance is zero, which is unknown, has the noise that
/// the configuration says. Instants without a detection are no rows of a file: where scans are
/// missing, empty ones take their place until no track is left that could miss anything, so that
/// the length of a gap costs nothing.
/// @param on_scan   gets the tracks after each scan, the empty ones included
/// @param times     where to add the time of the tracker's stages
/// @return the tracker's state at the end, with the counts of what was refused
TrackerState track_offline(const OfflineConfig& config, const ScanSource& scans,
                           const std::function<void(const TrackSnapshot&)>& on_scan,
                           StepTimes* times = nullptr);

/// The same of scans in memory, by time.
TrackerState track_offline(const OfflineConfig& config, std::span<const Scan> scans,
                           const std::function<void(const TrackSnapshot&)>& on_scan,
                           StepTimes* times = nullptr);

}  // namespace ghtrack
