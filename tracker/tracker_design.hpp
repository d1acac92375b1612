#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sensors/detection.hpp"
#include "tracker/existence.hpp"
#include "tracker/filters/filter.hpp"
#include "tracker/tracker_config.hpp"

namespace ghtrack {

/// A tracker for given sensors: its configuration, and a filter designed for each class and sensor.
/// Without a filter named "default", those of all classes run side by side where no class is told.
class TrackerDesign {
 public:
  /// @param sensors  the data sheets, by Scan::sensor
  /// @throws std::invalid_argument if a filter cannot be designed, such as for unstable gains, or
  ///         the association is `known`: who knows it decorates a tracker that does not
  /// @param areas  of each sensor whose view has no shape: what false detections are spread over
  ///               [m²]; none where it is not known
  TrackerDesign(TrackerConfig config, std::vector<SensorTraits> sensors,
                const std::vector<double>& areas = {});

  // Out of line: to copy all filters is much code.
  TrackerDesign(const TrackerDesign&);
  TrackerDesign(TrackerDesign&&) noexcept;
  TrackerDesign& operator=(const TrackerDesign&);
  TrackerDesign& operator=(TrackerDesign&&) noexcept;
  ~TrackerDesign();

  const TrackerConfig& config() const { return config_; }
  const SensorTraits& sensor(int index) const {
    return sensors_.at(static_cast<std::size_t>(index));
  }
  /// The sensor that tells most in a given time: gains are designed for it.
  const SensorTraits& best_sensor() const { return sensor(best_); }
  /// What a look of that sensor says of existence.
  const Evidence& evidence(int sensor) const {
    return evidence_.at(static_cast<std::size_t>(sensor));
  }

  /// The filter of a new track: waits for its first measurement.
  const Filter& filter_for(std::string_view label, int sensor) const;

 private:
  using FiltersByLabel = std::map<std::string, Filter, std::less<>>;

  TrackerConfig config_;
  std::vector<SensorTraits> sensors_;
  int best_ = 0;
  std::vector<Evidence> evidence_;       // of each sensor
  std::vector<FiltersByLabel> filters_;  // of each sensor
};

/// The filters that a track of this class may be followed with: one, or several side by side or
/// mixed.
std::vector<SingleFilterConfig> filters_of(const TrackerConfig& config, const std::string& label);

}  // namespace ghtrack
