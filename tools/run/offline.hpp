#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sensors/detection.hpp"
#include "sensors/field_of_view.hpp"
#include "tools/run/box_tracking.hpp"
#include "tracker/track.hpp"
#include "tracker/tracker.hpp"
#include "tracker/tracker_config.hpp"

namespace ghtrack {

/// What is said of a sensor whose detections are in a file. What is absent is learned from them.
struct OfflineSensor {
  std::optional<double> noise;    // 1-sigma error of a detection per axis [m, or pixel]
  std::optional<double> noise_y;  // the same along y
  double period = 0.0;            // time between scans [s]; 0: the median of the file
  std::vector<Eigen::Vector2d> field_of_view;
  std::optional<double> detection_probability;
  std::optional<double> clutter;  // expected false detections in one look at all of the view
  std::optional<double> area;     // of the view [m²]
  std::optional<Coverage> scan;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("noise", &OfflineSensor::noise,
            {.unit = "m",
             .meaning = "1-sigma error of a detection per axis",
             .above = 0.0,
             .maximum = 1e30});
    v.field("noise_y", &OfflineSensor::noise_y,
            {.unit = "m",
             .meaning = "the same along y, if it is another one",
             .above = 0.0,
             .maximum = 1e30});
    v.field("period", &OfflineSensor::period,
            {.unit = "s",
             .meaning = "time between scans; 0: the median of the file",
             .minimum = 0.0,
             .maximum = 1e12});
    v.field("field_of_view", &OfflineSensor::field_of_view,
            {.unit = "m",
             .meaning = "lower left and upper right corner; without it everything is seen",
             .minimum = -1e12,
             .maximum = 1e12,
             .max_items = 2});
    v.field("detection_probability", &OfflineSensor::detection_probability,
            {.unit = "1",
             .meaning = "chance that an object in view is detected in a scan",
             .above = 0.0,
             .maximum = 1.0});
    v.field("clutter", &OfflineSensor::clutter,
            {.unit = "1",
             .meaning = "expected false detections per scan, anywhere in the field of view",
             .minimum = 0.0,
             .maximum = 1e5});
    v.field("area", &OfflineSensor::area,
            {.unit = "m²",
             .meaning = "where there is no field of view: the area that false detections are "
                        "spread over; by default that of all detections",
             .above = 0.0,
             .maximum = 1e60});
    v.field(
        "scan", &OfflineSensor::scan,
        {.meaning = "whether a scan shows the `whole` field of view, or `partial`: one object of "
                    "many, as a rotating radar or AIS does; 'period' is then the time between "
                    "two looks at the same object; by default as the times suggest"});
  }

  template <class Report>
  void check(Report&& report) const {
    check_field_of_view(field_of_view, report);
    if (noise_y && !noise) report("noise_y", "needs 'noise', which is then that along x");
  }
};

/// How somebody else's detections are to be tracked: the file that `ghtrack track --config` reads.
struct OfflineConfig : OfflineSensor {
  static constexpr std::string_view about = "how the detections of a file are tracked";

  std::map<std::string, OfflineSensor> sensors;  // by name
  TrackerConfig tracker;
  BoxTrackerConfig boxes;
  BoxOutputConfig box_output;

  template <class Visitor>
  static void describe(Visitor& v) {
    OfflineSensor::describe(v);
    v.field("sensors", &OfflineConfig::sensors,
            {.meaning = "the same for single sensors, by their names in the column `sensor`; what "
                        "is not said there is as above"});
    v.field("tracker", &OfflineConfig::tracker, {.meaning = "the tracker, as in a scene"});
    v.field("boxes", &OfflineConfig::boxes,
            {.meaning = "the tracker of boxes, instead of the above, for MOTChallenge files"});
    v.field("box_output", &OfflineConfig::box_output,
            {.meaning = "which boxes are written for the tracks of a MOTChallenge file"});
  }

  template <class Report>
  void check(Report&& report) const {
    OfflineSensor::check(report);
    if (tracker.association == Association::kKnown) {
      report("tracker.association", "'known' needs a simulation: a file does not say who is who");
    }
  }

  /// What is said of a sensor, or of all.
  OfflineSensor sensor(const std::string& name) const;
};

/// Recorded scans, one after the other.
struct ScanSource {
  std::function<bool(Scan&)> next;                  // the next scan by time; false after the last
  double period = 0.0;                              // typical time between scans [s]; 0: unknown
  std::vector<std::string> sensors{std::string()};  // names, by index
};

/// The noise that a sensor's detections are taken to have on each axis [m]; 1 if nothing is said.
Eigen::Vector2d noise_of(const OfflineSensor& sensor);

/// That false detections are spread over where the view has no shape [m²]; infinite if nothing is
/// said.
double area_of(const OfflineSensor& sensor);

/// What is said of the sensor, or usual.
/// @param period  time between scans [s], unless it is said
SensorTraits traits_of(const OfflineSensor& sensor, double period);

/// Puts empty scans where scans are missing: instants without a detection are no rows of a file.
/// A sensor of whole scans that is silent for more than one and a half of its periods saw nothing.
class MissingScans {
 public:
  explicit MissingScans(std::vector<SensorTraits> sensors);

  /// Calls `process` for the scans that are missing before `scan`, by time, as long as it returns
  /// true; a gap costs no more than some scans.
  void fill(const Scan& scan, const std::function<bool(const Scan&)>& process);

 private:
  struct Sensor {
    SensorTraits traits;
    std::optional<double> last;  // time of the latest scan [s]
    int missing = 0;             // scans since then
  };
  std::vector<Sensor> sensors_;
};

/// Gets the tracks after a scan, and the scan as the tracker took it: with errors that its file may
/// not say.
using OnTracked = std::function<void(const TrackSnapshot&, const Scan&)>;

/// Tracks recorded scans. A detection whose covariance is zero, which is unknown, has the noise
/// that the configuration says. Instants without a detection are no rows of a file: where scans are
/// missing, empty ones take their place until no track is left that could miss anything, so that
/// the length of a gap costs nothing.
/// @param on_scan   is told of each scan, the empty ones included
/// @param times     where to add the time of the tracker's stages
/// @return the tracker's state at the end, with the counts of what was refused
TrackerState track_offline(const OfflineConfig& config, const ScanSource& scans,
                           const OnTracked& on_scan, StepTimes* times = nullptr);

/// The same of scans in memory, by time.
TrackerState track_offline(const OfflineConfig& config, std::span<const Scan> scans,
                           const OnTracked& on_scan, StepTimes* times = nullptr);

}  // namespace ghtrack
