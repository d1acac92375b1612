#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>
#include <vector>

#include "sensors/detection.hpp"
#include "sim/truth.hpp"

namespace ghtrack {

/// Measures positions directly, with independent noise on each axis.
struct PositionSensor {
  static constexpr std::string_view kind = "position";
  static constexpr std::string_view about =
      "measures positions with independent noise on each axis";

  double noise = 0.3;             // 1 sigma along x, and along y unless noise_y says otherwise [m]
  std::optional<double> noise_y;  // 1 sigma along y [m]
  Vec2 bias = Vec2::Zero();       // added to every position [m]
  std::vector<Vec2> field_of_view;  // lower left and upper right corner [m]; empty: everything

  Vec2 sigma() const { return {noise, noise_y.value_or(noise)}; }

  FieldOfView view(const Vec2&) const { return rectangle_between(field_of_view); }

  /// @param error  independent, standard: along x and y
  std::optional<Detection> measure(const Vec2& truth, const Vec2& site, const Vec2& error) const {
    return false_alarm(truth + bias + sigma().cwiseProduct(error), site);
  }

  Detection false_alarm(const Vec2& place, const Vec2&) const {
    return {.position = place, .covariance = sigma().cwiseAbs2().asDiagonal(), .label = {}};
  }

  double typical_sigma() const { return sigma().norm() / Vec2::Ones().norm(); }

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("noise", &PositionSensor::noise,
            {.unit = "m", .meaning = "1-sigma error per axis", .above = 0.0, .maximum = 1e6});
    v.field("noise_y", &PositionSensor::noise_y,
            {.unit = "m",
             .meaning = "1-sigma error along y if it differs",
             .above = 0.0,
             .maximum = 1e6});
    v.field("bias", &PositionSensor::bias,
            {.unit = "m",
             .meaning = "constant error added to every position",
             .minimum = -1e6,
             .maximum = 1e6});
    v.field("field_of_view", &PositionSensor::field_of_view,
            {.unit = "m",
             .meaning = "lower left and upper right corner; without it everything is seen",
             .minimum = -1e7,
             .maximum = 1e7,
             .max_items = 2});
  }

  template <class Report>
  void check(Report&& report) const {
    check_field_of_view(field_of_view, report);
  }
};

}  // namespace ghtrack
