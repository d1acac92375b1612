#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

#include "sensors/detection.hpp"
#include "sim/truth.hpp"

namespace ghtrack {

/// What a radar measures: distance and bearing from its site.
struct PolarMeasurement {
  double range = 0.0;              // [m]
  Vec2 direction = Vec2::UnitX();  // unit vector along the bearing
};

/// Standard deviations of range [m] and bearing [rad].
struct PolarNoise {
  double range = 0.0;
  double bearing = 0.0;
};

/// A polar measurement as a position relative to the site, without the bias of the plain
/// conversion: a wrong bearing always shortens the component along the true one, on average by the
/// factor λ = E[cos ε] = e^(−σ_θ²/2). With u the measured direction:
///   position         λ⁻¹ r u
///   variance along u   r² (λ⁻² − 3/2 + λ⁴/2) + σ_r² (1 + λ⁴)/2
///   variance across u  (r² + σ_r²) (1 − λ⁴)/2
/// This is the covariance of the error given the measurement (Mo, Song, Zhou, Sun & Bar-Shalom
/// 1998, "Unbiased converted measurements for tracking", written along and across the measured
/// bearing).
Detection to_cartesian(const PolarMeasurement& measured, const PolarNoise& noise);

/// Measures range and bearing from a site and reports positions.
struct Radar {
  static constexpr std::string_view kind = "radar";
  static constexpr std::string_view about =
      "measures range and bearing from its site and reports them as unbiased positions, each with "
      "its own covariance";

  double sigma_range = 1.0;
  double sigma_bearing_deg = 0.2;
  double bias_range = 0.0;
  double bias_bearing_deg = 0.0;
  double max_range = 1000.0;
  std::optional<Vec2> sector_deg;  // bearings between which it sees, counter-clockwise

  PolarNoise noise() const;
  FieldOfView view(const Vec2& site) const;

  /// @param error  independent, standard: of range and of bearing
  std::optional<Detection> measure(const Vec2& truth, const Vec2& site, const Vec2& error) const;
  Detection false_alarm(const Vec2& place, const Vec2& site) const;

  /// At half the greatest range [m].
  double typical_sigma() const;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("sigma_range", &Radar::sigma_range,
            {.unit = "m", .meaning = "1-sigma error of the range", .above = 0.0, .maximum = 1e5});
    v.field(
        "sigma_bearing_deg", &Radar::sigma_bearing_deg,
        {.unit = "deg", .meaning = "1-sigma error of the bearing", .above = 0.0, .maximum = 45.0});
    v.field(
        "bias_range", &Radar::bias_range,
        {.unit = "m", .meaning = "constant error of every range", .minimum = -1e5, .maximum = 1e5});
    v.field("bias_bearing_deg", &Radar::bias_bearing_deg,
            {.unit = "deg",
             .meaning = "constant error of every bearing",
             .minimum = -180.0,
             .maximum = 180.0});
    v.field("max_range", &Radar::max_range,
            {.unit = "m", .meaning = "sees no farther", .above = 0.0, .maximum = 1e6});
    v.field("sector_deg", &Radar::sector_deg,
            {.unit = "deg",
             .meaning = "first and last bearing that it sees, counter-clockwise from x; without it "
                        "all around",
             .minimum = -360.0,
             .maximum = 360.0});
  }

  template <class Report>
  void check(Report&& report) const {
    if (!sector_deg) return;
    const double width = sector_deg->y() - sector_deg->x();
    if (!(width > 0.0 && width <= 360.0)) {
      report("sector_deg", "the last bearing must be above the first, by at most 360");
    }
  }
};

}  // namespace ghtrack
