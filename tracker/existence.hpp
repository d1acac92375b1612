#pragma once

#include <limits>
#include <vector>

#include "sensors/detection.hpp"
#include "tracker/tracker_config.hpp"

namespace ghtrack {

// How likely is it that a track has a target? Every scan is evidence: a detection near the
// prediction speaks for it, the more so the fewer false detections there are; none where one was to
// be expected speaks against it. Musicki & Evans, "Joint integrated probabilistic data
// association", IEEE Trans. AES 40(3), 2004; Williams, "Marginal multi-Bernoulli filters", IEEE
// Trans. AES 51(3), 2015.

/// Probability that a target is still there after `elapsed` seconds.
double survival(double elapsed, double lifetime);

/// Existence after no detection where one was to be expected with probability `detection`:
///   r (1 − p) / (1 − r p)
constexpr double after_miss(double existence, double detection) {
  return existence * (1.0 - detection) / (1.0 - existence * detection);
}

/// What one look of a sensor finds, as densities [1/m²]. Without a field of view there is no area
/// that false detections could lie in, and none is known for where there are none: a density is
/// then supposed that is low for the sensor's own error.
struct Evidence {
  double detection_probability = 0.9;
  double clutter = 0.0;     // false detections
  double births = 0.0;      // targets that appear between two looks
  double at_first = 0.0;    // targets that are there when it looks for the first time
  double lifetime = 100.0;  // mean time that a target stays [s]
  double area = std::numeric_limits<double>::infinity();  // of the view [m²]

  /// @param area  that false detections are spread over if the sensor's view has no shape [m²]
  Evidence(const ExistenceConfig& config, const SensorTraits& sensor,
           double area = std::numeric_limits<double>::infinity());

  /// Density of detections that belong to no track yet: of false ones and of unknown targets.
  double nobodys(double undetected) const { return clutter + detection_probability * undetected; }
  /// ln p of so many detections with this density if all are nobody's.
  double log_nobodys(double density, std::size_t detections) const;
};

/// Targets that are there and have never been detected, as a density for each sensor: a Poisson
/// process, thinned by each look and fed by what appears.
class Undetected {
 public:
  /// The density [1/m²] when a sensor looks.
  double before_look(const Evidence& evidence, int sensor, double time);
  /// Takes away what that look has detected.
  void after_look(const Evidence& evidence, int sensor);

 private:
  struct Seen {
    double density = 0.0;
    double time = -std::numeric_limits<double>::infinity();
  };
  std::vector<Seen> by_sensor_;
};

}  // namespace ghtrack
